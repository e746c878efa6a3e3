/**
# Evidence on continuation (§3.2)

Predictor, arc length, tolerance, step, cost. */
#pragma once

#include "deviations/evidence.hpp"

namespace rotor_stator::deviations {

EvidenceList printed_predictor(const DeviationScene& scene);   // D-02
EvidenceList arc_length_scaling(const DeviationScene& scene);  // D-03
EvidenceList tolerance_and_step(const DeviationScene& scene);  // D-15
EvidenceList unit_of_cpu(const DeviationScene& scene);         // D-18

}  // namespace rotor_stator::deviations
