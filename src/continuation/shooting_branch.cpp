#include "continuation/shooting_branch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "model/rotor_stator.hpp"
#include "time/flow.hpp"

namespace rotor_stator {

namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/** P(s; ω) - s and what a corrector needs of it, all over the sizes. */
class ScaledMap {
public:
  ScaledMap(const Parameters& parameters, const ShootingBranchSettings& settings)
      : parameters_(parameters), scales_(state_scales(parameters)),
        speed_(joint_resonance(parameters)),
        step_(settings.step > 0 ? settings.step : default_step(parameters)),
        budget_(settings.budget)
  {
  }

  Vector9 scaled(const State& state, double omega) const
  {
    Vector9 y;
    y << vector_of(state).cwiseQuotient(scales_), omega / speed_;
    return y;
  }
  State state(const Vector9& y) const
  {
    return state_of(Vector8(y.head<8>().cwiseProduct(scales_)));
  }
  double omega(const Vector9& y) const { return y[8] * speed_; }

  struct Linear {
    Vector8 residual;
    Eigen::Matrix<double, 8, 9> slope;  ///< of the residual by y
  };

  /** Of rk4's default step, at the speed of y. */
  double steps_per_period(const Vector9& y) const
  {
    return std::ceil(2 * std::numbers::pi / omega(y) / step_);
  }

  Linear at(const Vector9& y, double steps)
  {
    constexpr double difference = 1e-6;
    const double w = omega(y);
    const double longest = 2 * std::numbers::pi / w / (steps - 0.5);
    Rk4PeriodMap here(parameters_, w, longest);
    Rk4PeriodMap above(parameters_, w * (1 + difference), longest);
    Rk4PeriodMap below(parameters_, w * (1 - difference), longest);
    const State from = state(y);
    const PeriodMap map = here.map(from);
    const Vector8 by_speed = (vector_of(above.end(from)) - vector_of(below.end(from))) /
                             (2 * difference * w) * speed_;
    constexpr double price = 3;  // of an evaluation with eight disturbances
    const auto states = static_cast<double>(above.evaluations() + below.evaluations());
    budget_.spend(price * static_cast<double>(here.evaluations()) + states);
    evaluations_ += here.evaluations() + above.evaluations() + below.evaluations();
    Linear linear{
        .residual = (vector_of(map.end) - vector_of(from)).cwiseQuotient(scales_),
        .slope = {}};
    linear.slope << scales_.cwiseInverse().asDiagonal() * map.derivative *
                            scales_.asDiagonal() -
                        Matrix8::Identity(),
        by_speed.cwiseQuotient(scales_);
    return linear;
  }

  long evaluations() const { return evaluations_; }

private:
  const Parameters& parameters_;
  Vector8 scales_;
  double speed_, step_;
  OperationBudget budget_;
  long evaluations_ = 0;
};

/** A corrected point and its tangent. */
struct Corrected {
  bool converged = false;
  Vector9 y, tangent;
  int iterations = 0;
};

struct Corrector {
  ScaledMap& map;
  double residual;
  static constexpr int most = 8;

  /** On the plane through `y` across `normal`. */
  Corrected operator()(const Vector9& start, const Vector9& normal) const
  {
    Corrected at;
    at.y = start;
    /** The same number in all maps: with another one the solution is another one, by rk4's error. */
    const double steps = map.steps_per_period(start);
    for (; at.iterations <= most; ++at.iterations) {
      const ScaledMap::Linear linear = map.at(at.y, steps);
      Matrix9 bordered;
      bordered << linear.slope, normal.transpose();
      const Eigen::PartialPivLU<Matrix9> lu(bordered);
      if (linear.residual.norm() <= residual) {
        at.tangent = lu.solve(Vector9::Unit(8)).normalized();
        at.converged = at.tangent.allFinite();
        return at;
      }
      Vector9 right;
      right << -linear.residual, normal.dot(start - at.y);
      const Vector9 step = lu.solve(right);
      if (!step.allFinite() || step.norm() > 0.5 || at.y[8] + step[8] <= 0) return at;
      at.y += step;
    }
    return at;
  }
};

}  // namespace

ShootingBranch follow_by_shooting(const Parameters& parameters, double from, double to,
                                  const State& state,
                                  const ShootingBranchSettings& settings)
{
  constexpr double widest_turn = 0.8;  // cosine between tangents
  ScaledMap map(parameters, settings);
  const Corrector correct{map, settings.periodicity_residual};
  const double direction = to > from ? 1 : -1;
  const Vector9 across_speed = direction * Vector9::Unit(8);
  Corrected last = correct(map.scaled(state, from), across_speed);
  if (!last.converged)
    throw NoSolution(format("shooting closed no motion at %g Hz, where the branch begins",
                            from * 0.5 / std::numbers::pi));
  ShootingBranch branch;
  const auto add = [&](const Corrected& point, double arc) {
    branch.points.push_back(
        {map.omega(point.y), map.state(point.y), arc, point.iterations});
  };
  add(last, 0);
  const auto left = [&](const Vector9& y, double edge) {
    return (map.omega(y) - edge) * direction > 0;
  };
  double arc = settings.first_arc;
  while (branch.end.empty()) {
    try {
      Corrected next = correct(last.y + arc * last.tangent, last.tangent);
      if (!next.converged || next.tangent.dot(last.tangent) < widest_turn) {
        arc /= 2;
        if (arc < settings.least_arc)
          branch.end = "the corrector closed no motion with the least step";
        continue;
      }
      const bool back = (map.omega(next.y) - from) * direction < 0;
      if (left(next.y, to) || back) {
        Vector9 edge = next.y;
        const double share = ((back ? from : to) - map.omega(last.y)) /
                             (map.omega(next.y) - map.omega(last.y));
        edge = last.y + share * (next.y - last.y);
        next = correct(edge, back ? Vector9(-across_speed) : across_speed);
        branch.covered = next.converged && !back;
        branch.end =
            back ? "it came back to where the range begins" : "the end of the range";
        if (!next.converged) break;
      }
      branch.folds += next.tangent[8] * last.tangent[8] < 0;
      add(next, branch.points.back().arc + (next.y - last.y).norm());
      if (next.iterations <= 3) arc = std::min(1.5 * arc, settings.most_arc);
      last = next;
    } catch (const NoSolution& error) {
      branch.end = error.what();
    }
  }
  branch.evaluations = map.evaluations();
  return branch;
}

}  // namespace rotor_stator
