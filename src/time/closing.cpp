#include "time/closing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** What the states y of a motion lead to. */
struct Mapped {
  Eigen::VectorXd open;                 ///< ends of the segments less the next states
  std::vector<Eigen::MatrixXd> slopes;  ///< Φ of each segment
  Eighths passed;                       ///< from the first state on
};

/** Newton in the scaled states, those of all segments below each other. */
class Iteration {
public:
  Iteration(const Parameters& parameters, double omega, const Eighths& start,
            const ClosingSettings& settings)
      : parameters_(parameters), omega_(omega), settings_(settings),
        sizes_(state_scales(parameters)), n_(sizes_.size())
  {
    constexpr Eigen::Index most_equations = 2000;
    const bool is_plain = settings.alone || eighths * n_ > most_equations;
    first_ = settings.alone.value_or(0);
    segments_ = is_plain ? 1 : eighths;
    y_.resize(segments_ * n_);
    for (Eigen::Index i = 0; i < segments_; ++i)
      part(y_, i) = vector_of(start[static_cast<std::size_t>((first_ + i) % eighths)])
                        .cwiseQuotient(sizes_);
  }

  Closing run(Eighths& motion)
  {
    try {
      Mapped at = map(y_);
      while (!corrected(at)) {
      }
      for (std::size_t i = 0; i < eighths; ++i) {
        const auto place = (static_cast<std::size_t>(first_) + i) % eighths;
        motion[place] = segments_ == eighths
                            ? unscaled(part(y_, static_cast<Eigen::Index>(i)))
                            : at.passed[i];
      }
      motion[static_cast<std::size_t>(first_)] = unscaled(part(y_, 0));
      report_.derivative = Eigen::MatrixXd::Identity(n_, n_);
      for (const auto& slope : at.slopes) report_.derivative = slope * report_.derivative;
      report_.derivative =
          sizes_.asDiagonal() * report_.derivative * sizes_.cwiseInverse().asDiagonal();
    } catch (const NoSolution& none) {
      report_.reason = none.what();
    }
    return report_;
  }

private:
  Eigen::VectorBlock<Eigen::VectorXd> part(Eigen::VectorXd& y, Eigen::Index i) const
  {
    return y.segment(i * n_, n_);
  }

  State unscaled(const Eigen::VectorXd& y) const
  {
    return state_of(y.cwiseProduct(sizes_));
  }

  double norm(const Eigen::VectorXd& y) const
  {
    return y.norm() / std::sqrt(static_cast<double>(y.size()));
  }

  Mapped map(Eigen::VectorXd& y)
  {
    if (++maps_ > settings_.most_maps)
      throw NoSolution(format("not closed after %d periods", settings_.most_maps));
    Mapped mapped{.open = Eigen::VectorXd(y.size()), .slopes = {}, .passed = {}};
    const int each = eighths / segments_;
    for (int i = 0; i < segments_; ++i) {
      State state = unscaled(part(y, i));
      Eigen::MatrixXd& slope =
          mapped.slopes.emplace_back(Eigen::MatrixXd::Identity(n_, n_));
      for (int k = first_ + i * each; k < first_ + (i + 1) * each; ++k) {
        mapped.passed.push_back(state);
        const PeriodMap next =
            period_map(parameters_, omega_, state, settings_.local_error, "rk8",
                       settings_.budget, {k, eighths});
        report_.evaluations += next.evaluations;
        slope = sizes_.cwiseInverse().asDiagonal() * next.derivative *
                sizes_.asDiagonal() * slope;
        state = next.end;
      }
      part(mapped.open, i) =
          vector_of(state).cwiseQuotient(sizes_) - part(y, (i + 1) % segments_);
    }
    if (!mapped.open.allFinite()) throw NoSolution("time integration diverged");
    return mapped;
  }

  /** One correction; true when it was the last. */
  bool corrected(Mapped& at)
  {
    const Eigen::Index all = y_.size();
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(all, all);
    for (Eigen::Index i = 0; i < segments_; ++i) {
      jacobian.block(i * n_, i * n_, n_, n_) += at.slopes[static_cast<std::size_t>(i)];
      jacobian.block(i * n_, (i + 1) % segments_ * n_, n_, n_).diagonal().array() -= 1;
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(jacobian);
    const Eigen::VectorXd step = lu.solve(-at.open);
    const double size = norm(step);
    if (!std::isfinite(size))
      throw NoSolution("the derivative of the period map is singular");
    const bool is_first = report_.first.size() == 0;
    if (is_first) report_.first = step;
    if (size <= settings_.closed) {
      y_ += step;
      report_.closed = true;
      if (is_first) report_.contraction = 0;
      return true;
    }
    constexpr double shortest = 1e-3;
    for (double length = std::min(1.0, 4 * length_); length > shortest; length /= 2) {
      Eigen::VectorXd y = y_ + length * step;
      Mapped next;
      try {
        next = map(y);
      } catch (const NoSolution&) {
        if (maps_ > settings_.most_maps || settings_.budget.used_up()) throw;
        continue;
      }
      const double left = norm(lu.solve(next.open)) / size;
      if (!(left <= 1 - length / 2)) continue;
      if (is_first && length == 1) report_.contraction = left;
      length_ = length;
      y_ = y;
      at = std::move(next);
      return false;
    }
    throw NoSolution(
        format("no correction closes the motion better (last one %.1e)", size));
  }

  const Parameters& parameters_;
  double omega_;
  const ClosingSettings& settings_;
  Eigen::VectorXd sizes_;
  Eigen::Index n_;
  int first_ = 0, segments_ = 1, maps_ = 0;
  Eigen::VectorXd y_;
  double length_ = 1;
  Closing report_;
};

}  // namespace

Closing close(const Parameters& parameters, double omega, Eighths& motion,
              const ClosingSettings& settings)
{
  return Iteration(parameters, omega, motion, settings).run(motion);
}

}  // namespace rotor_stator
