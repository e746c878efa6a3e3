#include "continuation/trail.hpp"

#include <algorithm>

namespace rotor_stator
{

namespace
{

/** The last step, and whether an earlier point is on it. */
struct Step {
  const BranchPoint &from, &to;
  const ArcLengthSettings& settings;
  Eigen::VectorXd start = scaled(from, settings);
  Eigen::VectorXd chord = scaled(to, settings) - start;

  /** The share of the chord where the point `y` lies beside it, if near enough. */
  std::optional<double> beside(const Eigen::VectorXd& y) const
  {
    constexpr double near = 0.1;
    const double share = (y - start).dot(chord) / chord.squaredNorm();
    if (share <= 0 || share > 1) return {};
    const double aside = (y - between(from, to, share, settings)).norm();
    if (aside > near * chord.norm()) return {};
    return share;
  }

  /** Speeds of the step, with room for its bend. */
  bool may_hold(double omega) const
  {
    const double room = 0.1 * chord.norm() * settings.speed_scale;
    return omega >= std::min(from.omega, to.omega) - room &&
           omega <= std::max(from.omega, to.omega) + room;
  }
};

}  // namespace

std::optional<Passed> passed_again(ExtendedBalance& extended,
                                   const std::vector<BranchPoint>& points,
                                   const BranchPoint& next,
                                   const ArcLengthSettings& settings)
{
  const Step step{points.back(), next, settings};
  const double reach = 2 * step.chord.norm();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const BranchPoint& earlier = points[k];
    if (points.back().arc - earlier.arc < reach) break;
    if (!step.may_hold(earlier.omega)) continue;
    const Eigen::VectorXd y = scaled(earlier, settings);
    const auto share = step.beside(y);
    if (!share) continue;
    /** Across the earlier point's tangent, from where the step's cubic passes it. */
    Eigen::VectorXd predicted = between(step.from, step.to, *share, settings);
    predicted += earlier.tangent * earlier.tangent.dot(y - predicted);
    Eigen::VectorXd corrected;
    if (!extended.correct(earlier.tangent, predicted, corrected).newton.converged())
      continue;
    if ((corrected - y).norm() > extended.last_correction()) continue;
    return Passed{k, earlier.tangent.dot(step.chord) > 0};
  }
  return {};
}

}  // namespace rotor_stator
