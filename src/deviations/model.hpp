/**
# Evidence on the model (§2 and Table 1)

Contact, readings, masses. */
#pragma once

#include "deviations/evidence.hpp"

namespace rotor_stator::deviations {

EvidenceList sign_of_approach(const DeviationScene& scene);   // D-01
EvidenceList radius_of_hertz(const DeviationScene& scene);    // D-07
EvidenceList unit_of_stiffness(const DeviationScene& scene);  // D-08
EvidenceList two_readings(const DeviationScene& scene);       // D-09
EvidenceList unprinted_masses(const DeviationScene& scene);   // D-13

}  // namespace rotor_stator::deviations
