/**
# Evidence on the balance (§3.1)

The blocks of Eq. 11, Newton's step and its criteria; what Γ takes to harmonics, and what too few
samples fold onto them. */
#pragma once

#include "deviations/evidence.hpp"

namespace rotor_stator::deviations {

EvidenceList printed_newton_step(const DeviationScene& scene);     // D-06
EvidenceList printed_block(const DeviationScene& scene);           // D-12
EvidenceList criteria_without_scale(const DeviationScene& scene);  // D-22
EvidenceList names_of_gamma(const DeviationScene& scene);          // D-04
EvidenceList samples_as_printed(const DeviationScene& scene);      // D-05
EvidenceList default_sample_count(const DeviationScene& scene);    // D-14
EvidenceList parentheses_of_gamma(const DeviationScene& scene);    // D-21

}  // namespace rotor_stator::deviations
