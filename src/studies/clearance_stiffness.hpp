/**
# Clearance against contact stiffness (claim C11)

Every point of the grid is one machine, swept up in speed by harmonic balance. Speeds
without a solution are counted. */
#pragma once

#include "continuation/sweep.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "model/parameters.hpp"

namespace rotor_stator::studies {

struct GridScene {
  Parameters base;
  std::vector<Parameters> machines = {};  ///< clearance varies fastest
  int harmonics;
  std::vector<double> frequencies;  ///< [Hz]
};

GridScene read_grid_scene(SceneFile& file);

/** What the sweep of one machine comes to. */
struct GridPoint {
  double clearance;            ///< δ [m]
  double contact_stiffness;    ///< K_H [N/m^{3/2}]
  CurvePoint peak = {-1, -1};  ///< of x_r [Hz, m]; -1 when no speed has a solution
  double f_loss_first = -1;    ///< speeds losing contact [Hz]; -1 when none does
  double f_loss_last = -1;
  double largest_force = 0;  ///< on one ball, over all speeds [N]
  int missed = 0;            ///< speeds without a solution
};

GridPoint summary(const Parameters& machine, const std::vector<PeriodicMotion>& sweep);

Table grid_table(const GridScene& scene,
                 const std::vector<std::vector<GridPoint>>& points);

}  // namespace rotor_stator::studies
