#include "balance/periodic_motion.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

Harmonics::Harmonics(int m)
{
  std::vector<Harmonic> list;
  for (int k = 0; k <= m; ++k) list.push_back({k, 0});
  list_ = std::make_shared<const std::vector<Harmonic>>(std::move(list));
}

std::string NewtonReport::reason() const
{
  constexpr const char* ends[] = {"converged", "iterations exhausted",
                                  "no step decreases the residual", "singular Jacobian"};
  const std::string numbers =
      std::isfinite(delta_1) && std::isfinite(delta_2)
          ? format(" after %d iterations (residual %.1e, step %.1e)", iterations, delta_1,
                   delta_2)
          : format(" after %d iterations (residual or step not finite)", iterations);
  return ends[static_cast<int>(end)] + numbers;
}

Eigen::VectorXd resize_harmonics(const Eigen::VectorXd& x, int dofs, int harmonics)
{
  Eigen::VectorXd resized = Eigen::VectorXd::Zero(dofs * (2 * harmonics + 1));
  const auto common = std::min(x.size(), resized.size());
  resized.head(common) = x.head(common);
  return resized;
}

}  // namespace rotor_stator
