/**
# Scene: clearance against contact stiffness (claim C11)

Every point of the grid is one machine, swept up in speed by harmonic balance. Speeds
without a solution are counted. */
#pragma once

#include "io/scene.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::studies
{

struct ParametricStudy {
  Parameters base;
  int harmonics;
  std::vector<double> frequencies;          ///< [Hz]
  std::vector<double> clearances;           ///< [m]
  std::vector<double> contact_stiffnesses;  ///< [N/m^{3/2}]

  std::size_t points() const { return clearances.size() * contact_stiffnesses.size(); }

  /** The machine of point `index`: clearance varies fastest. */
  Parameters machine(std::size_t index) const;
};

ParametricStudy read_parametric_study(const std::string& file);

/** What one sweep comes to. */
struct StudyPoint {
  double f_peak, amp_peak;           ///< of x_r [Hz, m]; -1 when no speed has a solution
  double f_loss_first, f_loss_last;  ///< speeds losing contact [Hz]; -1 when none does
  double largest_force;              ///< on one ball, over all speeds [N]
  int missed;                        ///< speeds without a solution
};

StudyPoint sweep_machine(const Parameters& parameters, const ParametricStudy& study);

/** The grid of clearance and contact stiffness. */
Table study_table(const std::string& scene_file, const std::string& journal);

}  // namespace rotor_stator::studies
