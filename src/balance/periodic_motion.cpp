#include "balance/periodic_motion.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "io/errors.hpp"

namespace rotor_stator {

Harmonics::Harmonics(int m)
{
  std::vector<Harmonic> list;
  for (int k = 0; k <= m; ++k) list.push_back({static_cast<double>(k), 0});
  list_ = std::make_shared<const std::vector<Harmonic>>(std::move(list));
}

Harmonics::Harmonics(std::vector<Harmonic> list)
    : list_(std::make_shared<const std::vector<Harmonic>>(std::move(list)))
{
}

Images Harmonics::images(const TorusLine& line, int samples) const
{
  Images images;
  for (const auto& [k_1, k_2] : list()) {
    const auto h = std::lround(line.turns * (k_1 + line.z * k_2)) % samples;
    const long least = 2 * h > samples ? h - samples : 2 * h < -samples ? h + samples : h;
    images.push_back(static_cast<int>(least));
  }
  return images;
}

std::string NewtonReport::reason() const
{
  constexpr const char* ends[] = {"converged", "iterations exhausted",
                                  "no step decreases the residual", "no finite step",
                                  "only a motion of a shorter period"};
  const bool is_finite = std::isfinite(delta_1) && std::isfinite(delta_2);
  return format("%s after %d iterations (", ends[static_cast<int>(end)], iterations) +
         (is_finite ? format("residual %.1e, step %.1e)", delta_1, delta_2)
                    : "residual or step not finite)");
}

Eigen::VectorXd project(const Eigen::VectorXd& x, int dofs, const Harmonics& from,
                        const Harmonics& to)
{
  std::map<Harmonic, Eigen::Index> place;
  for (Harmonic one : from.list()) place.emplace(one, std::ssize(place));
  const auto part = [dofs](auto& coefficients, Eigen::Index h) {
    return coefficients.segment(h == 0 ? 0 : (2 * h - 1) * dofs,
                                h == 0 ? dofs : 2 * dofs);
  };
  Eigen::VectorXd y = Eigen::VectorXd::Zero(to.coefficients() * dofs);
  for (Eigen::Index h = 0; Harmonic one : to.list()) {
    const auto at = place.find(one);
    if (at != place.end()) part(y, h) = part(x, at->second);
    ++h;
  }
  return y;
}

Eigen::VectorXd resize_harmonics(Eigen::VectorXd x, int dofs, int harmonics)
{
  x.conservativeResizeLike(Eigen::VectorXd::Zero(dofs * (2 * harmonics + 1)));
  return x;
}

}  // namespace rotor_stator
