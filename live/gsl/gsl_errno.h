#pragma once
#include "gsl_odeiv2.h"
