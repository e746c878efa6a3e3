#include "time/rk8.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "time/fixed_step.hpp"
#include "time/flow.hpp"

namespace rotor_stator {

using dop853::stages;

namespace {

using Quad = Lanes<4>;

/** Four displacements of the motion, x_s to y_r, and below them those of eight
    disturbances: each displacement is two rows. Or their speeds. */
template <int rows>
using Rows = std::array<Quad, rows>;

constexpr int alone = 1, with_derivative = 1 + 4 * 2;

IN_PLACE Quad quad(double stator, double rotor)
{
  return Quad{stator, stator, rotor, rotor};
}

/** The largest square of four errors over their sizes, and those of four others. */
IN_PLACE double largest_square(Quad a, Quad per_size_a, Quad b, Quad per_size_b)
{
  const Quad x = a * per_size_a, y = b * per_size_b;
  const Quad xx = x * x, yy = y * y;
  double most = 0;
  for (int l = 0; l < 4; ++l) {
    most = most > xx[l] ? most : xx[l];
    most = most > yy[l] ? most : yy[l];
  }
  return most;
}

}  // namespace

/** The estimate of a step in which a ball begins or ceases to touch is too small. With
    this factor a tolerance gives about the error that GSL's rk8pd has with it (30 periods
    of three machines), for as many evaluations. */
static constexpr double caution = 5;

/** All that the stages of a step need. */
template <int rows>
struct Rk8::Step {
  const Rk8* flow;
  BallRing balls;
  ContactLaw<double> law;
  Quad k, c, per_m, rest;  ///< of x_s, y_s, x_r and y_r
  double unbalance;
  Quad per_size_q, per_size_v;

  double h;
  Angles begin;

  Rows<rows> q, v;  ///< before the step
  Rows<rows> q_next, v_next;
  Rows<rows> speeds[stages], accelerations[stages];
  double error;  ///< estimated, over the sizes

  /** Which machine: with an undamaged bearing, one with contact damping too, or any. */
  enum class Kind { plain, damped, any };

  IN_PLACE Quad accelerate(Quad q_now, Quad v_now, Direction turned_rotor,
                           Vec2 force) const
  {
    const Quad load{force.x, force.y, unbalance * turned_rotor.cos - force.x,
                    unbalance * turned_rotor.sin - force.y};
    return (load - c * v_now - k * q_now) * per_m + rest;
  }

  /** The variational equations, four disturbances at once. */
  IN_PLACE void accelerate_disturbances(const BearingReaction& at,
                                        const Rows<rows>& q_now, const Rows<rows>& v_now,
                                        Rows<rows>& a) const
  {
    const Slopes2 &s = at.stiffness, &d = at.damping;
    for (int half = 1; half <= 2; ++half) {
      const Quad u_x = q_now[half + 4] - q_now[half];
      const Quad u_y = q_now[half + 6] - q_now[half + 2];
      Quad f_x = s.xx * u_x + s.xy * u_y, f_y = s.yx * u_x + s.yy * u_y;
      if (flow->is_damped_) {
        const Quad w_x = v_now[half + 4] - v_now[half];
        const Quad w_y = v_now[half + 6] - v_now[half + 2];
        f_x = f_x + (d.xx * w_x + d.xy * w_y);
        f_y = f_y + (d.yx * w_x + d.yy * w_y);
      }
      const Quad forces[] = {f_x, f_y, -f_x, -f_y};
      for (int i = 0; i < 4; ++i) {
        const int row = half + 2 * i;
        a[row] = (forces[i] - c[i] * v_now[row] - k[i] * q_now[row]) * per_m[i];
      }
    }
  }

  /** Takes off what the elements to the ground do, in a machine that has some. */
  void hold(const Rows<rows>& q_now, const Rows<rows>& v_now, Rows<rows>& a) const
  {
    for (const Ground& one : flow->system_.grounds()) {
      const int x = one.is_rotor ? 2 : 0, y = x + 1;
      const BearingReaction now =
          one.element.reaction({q_now[0][x], q_now[0][y]}, {v_now[0][x], v_now[0][y]});
      a[0][x] -= one.per_mass * now.force.x;
      a[0][y] -= one.per_mass * now.force.y;
      const Slopes2 &s = now.stiffness, &d = now.damping;
      for (int half = 1; half <= 2 && rows == with_derivative; ++half) {
        const int at_x = half + 2 * x, at_y = half + 2 * y;
        const Quad q_x = q_now[at_x], q_y = q_now[at_y];
        const Quad v_x = v_now[at_x], v_y = v_now[at_y];
        a[at_x] -= one.per_mass * (s.xx * q_x + s.xy * q_y + d.xx * v_x + d.xy * v_y);
        a[at_y] -= one.per_mass * (s.yx * q_x + s.yy * q_y + d.yx * v_x + d.yy * v_y);
      }
    }
  }

  template <Kind kind>
  IN_PLACE void accelerate(int stage, const Rows<rows>& q_now, const Rows<rows>& v_now,
                           Rows<rows>& a) const
  {
    const BallBearing& bearing = flow->system_.bearing();
    Angles at{turned(begin.rotor, flow->rotor_.at(stage)),
              turned(begin.cage, flow->cage_.at(stage))};
    const Vec2 u{q_now[0][2] - q_now[0][0], q_now[0][3] - q_now[0][1]};
    const Vec2 w{v_now[0][2] - v_now[0][0], v_now[0][3] - v_now[0][1]};
    if constexpr (kind == Kind::any) at.spin = turned(begin.spin, flow->spin_.at(stage));
    if constexpr (rows == with_derivative) {
      const BearingReaction now = bearing.reaction(at, u, w);
      a[0] = accelerate(q_now[0], v_now[0], at.rotor, now.force);
      accelerate_disturbances(now, q_now, v_now, a);
    } else if constexpr (kind == Kind::any) {
      a[0] = accelerate(q_now[0], v_now[0], at.rotor, bearing.force(at, u, w));
    } else {
      constexpr bool damped = kind == Kind::damped;
      a[0] = accelerate(q_now[0], v_now[0], at.rotor,
                        bearing_force<damped>(balls, law, at.cage, u, w));
    }
    if constexpr (kind == Kind::any) hold(q_now, v_now, a);
  }

  /** The slopes before `stage`, by their weights. */
  template <int stage>
  IN_PLACE void sum(int row, Quad& of_speeds, Quad& of_accelerations) const
  {
    of_speeds = dop853::weights[stage][0] * speeds[0][row];
    of_accelerations = dop853::weights[stage][0] * accelerations[0][row];
#pragma GCC unroll 12
    for (int j = 1; j < stage; ++j) {
      const double weight = dop853::weights[stage][j];
      if (weight == 0) continue;
      of_speeds += weight * speeds[j][row];
      of_accelerations += weight * accelerations[j][row];
    }
  }

  template <Kind kind, int stage = 0>
  IN_PLACE void take_stages()
  {
    for (int row = 0; row < rows; ++row) {
      if constexpr (stage == 0) {
        q_next[row] = q[row];
        v_next[row] = v[row];
      } else {
        Quad of_speeds, of_accelerations;
        sum<stage>(row, of_speeds, of_accelerations);
        q_next[row] = q[row] + h * of_speeds;
        v_next[row] = v[row] + h * of_accelerations;
      }
    }
    if constexpr (stage < stages) {
      speeds[stage] = v_next;
      accelerate<kind>(stage, q_next, v_next, accelerations[stage]);
      take_stages<kind, stage + 1>();
    }
  }

  /** One step, and the estimate of the book's II.10: |E_5|² over the root of |E_5|² +
      |E_3|²/100, in the norm of the largest component. */
  template <Kind kind>
  IN_PLACE void take()
  {
    take_stages<kind>();
    Quad q_5{}, v_5{}, q_3{}, v_3{};
#pragma GCC unroll 12
    for (int j = 0; j < stages; ++j) {
      if (dop853::error_3[j] == 0) continue;
      q_5 += dop853::error_5[j] * speeds[j][0];
      v_5 += dop853::error_5[j] * accelerations[j][0];
      q_3 += dop853::error_3[j] * speeds[j][0];
      v_3 += dop853::error_3[j] * accelerations[j][0];
    }
    const double fifth = largest_square(q_5, per_size_q, v_5, per_size_v);
    const double third = largest_square(q_3, per_size_q, v_3, per_size_v);
    error = fifth == 0 ? 0 : caution * h * fifth / std::sqrt(fifth + 0.01 * third);
  }
};

Rk8::Rk8(const Parameters& parameters, double omega, int intervals, double tolerance,
         OperationBudget budget)
    : system_(parameters, omega), turns_(Turns::of(parameters)), intervals_(intervals),
      first_share_(
          std::min(1.0, default_step(parameters) * intervals / system_.period())),
      longest_share_(6 * default_step(parameters) * intervals / system_.period()),
      tolerance_(tolerance), per_size_(state_scales(parameters).cwiseInverse()),
      is_general_(!has_intact_hertz_alone(parameters)),
      is_damped_(parameters.bearing.is_damped()), budget_(std::move(budget)),
      wanted_(first_share_)
{
}

/** By the series of sine and cosine where the angles are small: faster than eleven calls
    of each. */
void Rk8::Turning::set(double turns_in_step)
{
  const double angle = 2 * std::numbers::pi * turns_in_step;
  if (std::abs(angle) > 1) {
    for (int i = 0; i < stages; ++i) {
      cos[i] = std::cos(dop853::nodes[i] * angle);
      sin[i] = std::sin(dop853::nodes[i] * angle);
    }
    return;
  }
  constexpr auto per_factorial = [] {
    std::array<double, 19> per{1};
    for (int n = 1; n < 19; ++n) per[n] = per[n - 1] / n;
    return per;
  }();
  for (int i = 0; i < stages; ++i) {
    const double x = dop853::nodes[i] * angle, y = -x * x;
    double even = per_factorial[18], odd = per_factorial[17];
#pragma GCC unroll 8
    for (int n = 16; n > 0; n -= 2) {
      even = even * y + per_factorial[n];
      odd = odd * y + per_factorial[n - 1];
    }
    cos[i] = even * y + 1;
    sin[i] = x * odd;
  }
}

template <int rows>
Rk8::Step<rows> Rk8::first_step(const State& state) const
{
  const Equation7<double>& e = system_.equation();
  Step<rows> step{};
  step.flow = this;
  step.balls = system_.bearing().ring();
  step.law = system_.bearing().law();
  step.k = quad(e.k_s, e.k_r);
  step.c = quad(e.c_s, e.c_r);
  step.per_m = quad(e.per_m_s, e.per_m_r);
  step.rest = std::bit_cast<Quad>(e.rest);
  step.unbalance = e.unbalance;
  step.q[0] = std::bit_cast<Quad>(state.position);
  step.v[0] = std::bit_cast<Quad>(state.velocity);
  for (int i = 0; i < 4; ++i) {
    step.per_size_q[i] = per_size_[i];
    step.per_size_v[i] = per_size_[4 + i];
  }
  return step;
}

template <int rows>
void Rk8::set_length(Step<rows>& step, double share)
{
  step.h = share * system_.period() / intervals_;
  if (share == length_) return;
  length_ = share;
  const double of_period = share / intervals_;
  rotor_.set(turns_.rotor * of_period);
  cage_.set(turns_.cage * of_period);
  if (turns_.spin > 0) spin_.set(turns_.spin * of_period);
}

template <int rows>
double Rk8::attempt(Step<rows>& step)
{
  using Kind = typename Step<rows>::Kind;
  budget_.spend(stages * (rows == alone ? price : price_with_derivative));
  evaluations_ += stages;
  in_registers(
      widest_registers(), [&]() __attribute__((always_inline)) {
        if (is_general_)
          step.template take<Kind::any>();
        else if (is_damped_ && rows == alone)
          step.template take<rows == alone ? Kind::damped : Kind::plain>();
        else
          step.template take<Kind::plain>();
      });
  return step.error;
}

void Rk8::stop(long interval, double passed) const
{
  throw NoSolution(
      format("time integration stopped at t = %.9g s",
             (static_cast<double>(interval) + passed) * system_.period() / intervals_));
}

/** How much longer the next step may be than one with this error over the tolerance:
    errors grow with the power 8. */
static double change_of_length(double error)
{
  constexpr double safety = 0.9, least = 0.2, most = 6;
  if (error == 0) return most;
  const double change = safety / std::sqrt(std::sqrt(std::sqrt(error)));
  return std::isfinite(change) ? std::clamp(change, least, most) : least;
}

template <int rows>
void Rk8::integrate(long interval, Step<rows>& step)
{
  constexpr double shorter = 0.8, longer = 1.25;  ///< changes that are worth one
  constexpr double shortest = 1e-13;
  constexpr int fresh = 128;  ///< steps after which the directions are computed anew
  if (interval != next_) wanted_ = first_share_;
  next_ = interval + 1;
  const long part = ((interval % intervals_) + intervals_) % intervals_;
  const auto periods = static_cast<double>((interval - part) / intervals_);

  double passed = 0;
  long left = 0;  ///< steps of this length up to the end
  const auto divide_what_is_left = [&] {
    const double share = rows == alone ? wanted_ : std::min(wanted_, longest_share_);
    const long parts = std::max(1L, std::lround(std::ceil((1 - passed) / share - 1e-6)));
    if (parts == left) return;
    left = parts;
    set_length(step, (1 - passed) / static_cast<double>(parts));
  };
  divide_what_is_left();
  bool is_rejected = false;
  for (int steps = 0; left > 0;) {
    if (steps % fresh == 0)
      step.begin = turns_.at(periods, (static_cast<double>(part) + passed) / intervals_);
    const double error = attempt(step) / tolerance_;
    double better = length_ * change_of_length(error);
    if (!(error <= 1)) {
      ++rejected_;
      is_rejected = true;
      wanted_ = better;
      if (!(better > shortest)) stop(interval, passed);
      divide_what_is_left();
      continue;
    }
    constexpr int last = stages - 1;  // at the end of the step
    step.q = step.q_next;
    step.v = step.v_next;
    step.begin.rotor = turned(step.begin.rotor, rotor_.at(last));
    step.begin.cage = turned(step.begin.cage, cage_.at(last));
    if (turns_.spin > 0) step.begin.spin = turned(step.begin.spin, spin_.at(last));
    ++steps;
    --left;
    passed += length_;
    if (is_rejected) better = std::min(better, length_);
    is_rejected = false;
    if (better > shorter * wanted_ && better < longer * wanted_) continue;
    wanted_ = better;
    if (left > 0) divide_what_is_left();
  }
  for (int i = 0; i < 4; ++i)
    if (!std::isfinite(step.q[0][i]) || !std::isfinite(step.v[0][i])) stop(interval, 1);
}

static State state_of(const Quad& q, const Quad& v)
{
  return {std::bit_cast<Bodies>(q), std::bit_cast<Bodies>(v)};
}

void Rk8::advance(long interval, State& state)
{
  auto step = first_step<alone>(state);
  integrate(interval, step);
  state = state_of(step.q[0], step.v[0]);
}

void Rk8::advance(long interval, State& state, Matrix8& derivative)
{
  auto step = first_step<with_derivative>(state);
  const auto each = [&](auto exchange) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 8; ++j) {
        const int row = 1 + 2 * i + j / 4, lane = j % 4;
        exchange(step.q[row], lane, derivative(i, j));
        exchange(step.v[row], lane, derivative(4 + i, j));
      }
  };
  each([](Quad& row, int lane, double value) { row[lane] = value; });
  integrate(interval, step);
  each([](const Quad& row, int lane, double& value) { value = row[lane]; });
  state = state_of(step.q[0], step.v[0]);
}

double Rk8::step(double share, State& state)
{
  auto one = first_step<alone>(state);
  one.begin = turns_.at(0, 0);
  set_length(one, share);
  const double error = attempt(one);
  state = state_of(one.q_next[0], one.v_next[0]);
  return error;
}

}  // namespace rotor_stator
