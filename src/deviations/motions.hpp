/**
# Evidence on the motions (§3.3)

Amplitudes, cage, time integration, figures. */
#pragma once

#include "deviations/evidence.hpp"

namespace rotor_stator::deviations {

EvidenceList amplitude_definitions(const DeviationScene& scene);  // D-10
EvidenceList cage_and_period(const DeviationScene& scene);        // D-11
EvidenceList runge_kutta_settings(const DeviationScene& scene);   // D-16
EvidenceList speeds_of_panels(const DeviationScene& scene);       // D-17
EvidenceList kind_of_figures(const DeviationScene& scene);        // D-19
EvidenceList passages_over_2t(const DeviationScene& scene);       // D-20

}  // namespace rotor_stator::deviations
