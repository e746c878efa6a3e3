#include "time/shooting.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** What the states y of a motion lead to. */
struct Mapped {
  Eigen::VectorXd open;                 ///< ends of the segments less the next states
  std::vector<Eigen::MatrixXd> slopes;  ///< Φ of each segment; none without derivatives
  std::vector<State> passed;            ///< at the phases, from the first state on
};

/** Newton in the scaled states, those of all segments below each other. */
class Iteration {
public:
  Iteration(const Parameters& parameters, double omega, const std::vector<State>& start,
            const ShootingSettings& settings)
      : parameters_(parameters), omega_(omega), settings_(settings),
        sizes_(state_scales(parameters)), n_(sizes_.size()),
        phases_(static_cast<int>(start.size())), first_(settings.alone.value_or(0))
  {
    constexpr Eigen::Index most_equations = 2000;
    const bool is_plain = settings.alone || phases_ * n_ > most_equations;
    segments_ = is_plain ? 1 : phases_;
    y_.resize(segments_ * n_);
    for (int i = 0; i < segments_; ++i)
      part(y_, i) = vector_of(start[place(i)]).cwiseQuotient(sizes_);
    start_ = y_;
  }

  Shooting run(std::vector<State>& motion, Eigen::MatrixXd* kept)
  {
    try {
      if (kept && kept->size() > 0) {
        jacobian_ = *kept;
        factors_.compute(jacobian_);
        is_fresh_ = false;
        at_ = map(y_, false);
      } else {
        linearise();
      }
      while (!report_.converged) correct();
      for (int i = 0; i < phases_; ++i)
        motion[place(i)] = segments_ > i ? unscaled(part(y_, i)) : at_.passed[i];
      multiply_slopes();
    } catch (const NoSolution& none) {
      report_.reason = none.what();
    }
    if (kept && jacobian_.size() > 0) *kept = jacobian_;
    return report_;
  }

private:
  Eigen::VectorBlock<Eigen::VectorXd> part(Eigen::VectorXd& y, int i) const
  {
    return y.segment(i * n_, n_);
  }
  std::size_t place(int i) const
  {
    return static_cast<std::size_t>((first_ + i) % phases_);
  }
  State unscaled(const Eigen::VectorXd& y) const
  {
    return state_of(y.cwiseProduct(sizes_));
  }
  double norm(const Eigen::VectorXd& y) const
  {
    return y.norm() / std::sqrt(static_cast<double>(y.size()));
  }

  Mapped map(Eigen::VectorXd& y, bool with_slopes)
  {
    if (++report_.maps > settings_.most_maps)
      throw NoSolution(format("not closed after %d periods", settings_.most_maps));
    const StepSettings steps{.method = settings_.method,
                             .intervals_per_period = phases_,
                             .step = settings_.step,
                             .tolerance = settings_.tolerance,
                             .budget = settings_.budget};
    Mapped mapped{.open = Eigen::VectorXd(y.size()), .slopes = {}, .passed = {}};
    const int each = phases_ / segments_;
    for (int i = 0; i < segments_; ++i) {
      State state = unscaled(part(y, i));
      Eigen::MatrixXd slope = Eigen::MatrixXd::Identity(n_, n_);
      for (int k = first_ + i * each; k < first_ + (i + 1) * each; ++k) {
        mapped.passed.push_back(state);
        const PeriodMap next =
            period_map(parameters_, omega_, state, steps, k, with_slopes);
        report_.evaluations += next.evaluations;
        if (with_slopes) slope = scaled(next.derivative) * slope;
        state = next.end;
      }
      if (with_slopes) mapped.slopes.push_back(slope);
      part(mapped.open, i) =
          vector_of(state).cwiseQuotient(sizes_) - part(y, (i + 1) % segments_);
    }
    if (!mapped.open.allFinite()) throw NoSolution("time integration diverged");
    return mapped;
  }

  Eigen::MatrixXd scaled(const Eigen::MatrixXd& derivative) const
  {
    return sizes_.cwiseInverse().asDiagonal() * derivative * sizes_.asDiagonal();
  }

  void linearise() { factor(map(y_, true)); }

  void factor(Mapped at)
  {
    at_ = std::move(at);
    jacobian_ = Eigen::MatrixXd::Zero(y_.size(), y_.size());
    for (int i = 0; i < segments_; ++i) {
      jacobian_.block(i * n_, i * n_, n_, n_) += at_.slopes[static_cast<std::size_t>(i)];
      jacobian_.block(i * n_, (i + 1) % segments_ * n_, n_, n_).diagonal().array() -= 1;
    }
    factors_.compute(jacobian_);
    is_fresh_ = true;
  }

  void correct()
  {
    const Eigen::VectorXd step = factors_.solve(-at_.open);
    const double size = report_.correction = norm(step);
    if (!std::isfinite(size))
      throw NoSolution("the derivative of the period map is singular");
    const bool is_first = report_.first.size() == 0;
    if (is_first) report_.first = step;
    if (size <= settings_.closed) {
      y_ += step;
      report_.converged = true;
      if (is_first) report_.contraction = 0;
      return;
    }
    constexpr double shortest = 1e-3;
    for (double length = std::min(1.0, 4 * length_); length > shortest; length /= 2) {
      Eigen::VectorXd y = y_ + length * step;
      Mapped next;
      try {
        next = map(y, !settings_.quasi_newton);
      } catch (const NoSolution&) {
        if (report_.maps > settings_.most_maps || settings_.budget.used_up()) throw;
        continue;
      }
      const double left = norm(factors_.solve(next.open)) / size;
      if (!(left <= (settings_.quasi_newton ? 1 : 1 - length / 2))) continue;
      if (is_first && length == 1) report_.contraction = left;
      length_ = length;
      y_ = y;
      if ((y_ - start_).cwiseAbs().maxCoeff() > settings_.farthest)
        throw NoSolution("what closes is farther away than asked for");
      return learn(std::move(next), length * step, length, left);
    }
    if (is_fresh_)
      throw NoSolution(
          format("no correction closes the motion better (last one %.1e)", size));
    linearise();
  }

  /** Φ of the next states, or Broyden's, where the last correction served well. */
  void learn(Mapped next, const Eigen::VectorXd& step, double length, double left)
  {
    constexpr double well = 0.3;
    if (!settings_.quasi_newton) return factor(std::move(next));
    if (left > well) return linearise();
    jacobian_ +=
        (next.open - (1 - length) * at_.open) * step.transpose() / step.squaredNorm();
    factors_.compute(jacobian_);
    is_fresh_ = false;
    at_ = std::move(next);
  }

  void multiply_slopes()
  {
    if (at_.slopes.empty()) return;
    Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(n_, n_);
    for (const auto& slope : at_.slopes) whole = slope * whole;
    report_.derivative = sizes_.asDiagonal() * whole * sizes_.cwiseInverse().asDiagonal();
  }

  const Parameters& parameters_;
  double omega_;
  const ShootingSettings& settings_;
  Eigen::VectorXd sizes_;
  Eigen::Index n_;
  int phases_, first_, segments_ = 1;
  Eigen::VectorXd y_, start_;
  Mapped at_;
  Eigen::MatrixXd jacobian_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  bool is_fresh_ = true;  ///< the factors are those of y
  double length_ = 1;
  Shooting report_;
};

}  // namespace

Shooting shoot(const Parameters& parameters, double omega, Eighths& motion,
               const ShootingSettings& settings)
{
  return Iteration(parameters, omega, motion, settings).run(motion, nullptr);
}

Shooting shoot(const Parameters& parameters, double omega, State& state,
               const ShootingSettings& settings, Eigen::MatrixXd* jacobian)
{
  Eighths motion{state};
  const Shooting report =
      Iteration(parameters, omega, motion, settings).run(motion, jacobian);
  state = motion.front();
  return report;
}

State quasi_static_state(const Parameters& parameters, double omega)
{
  /** F = rest + Re(whirl (1, -i) e^{iφ}); the stator answers with its receptance, the
      rotor stands off by u, which follows the force. */
  const Vec2 at_0 = rigid_joint_force(parameters, omega, 0);
  const Vec2 rest = static_joint_force(parameters);
  const std::complex<double> whirl(at_0.x - rest.x, at_0.y - rest.y);
  const auto response =
      whirl / dynamic_stiffness(parameters.stator, parameters.turns * omega).value;
  const Vec2 sag = static_start(parameters).position.stator;
  const auto stator = [&](double phase) -> Vec2 {
    const auto turned = response * std::polar(1.0, parameters.turns * phase);
    return {sag.x + turned.real(), sag.y + turned.imag()};
  };
  const auto relative = [&](double phase) {
    return quasi_static_contact(parameters.bearing,
                                rigid_joint_force(parameters, omega, phase));
  };
  constexpr double little = 1e-4;
  const auto speed = [&](const auto& path) -> Vec2 {
    const Vec2 a = path(-little), b = path(little);
    return {omega * (b.x - a.x) / (2 * little), omega * (b.y - a.y) / (2 * little)};
  };
  const Vec2 s = stator(0), u = relative(0), v_s = speed(stator), v_u = speed(relative);
  return {.position = {.stator = s, .rotor = {s.x + u.x, s.y + u.y}},
          .velocity = {.stator = v_s, .rotor = {v_s.x + v_u.x, v_s.y + v_u.y}}};
}

}  // namespace rotor_stator
