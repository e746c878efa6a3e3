#include "time/fixed_step.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/errors.hpp"

namespace rotor_stator {

static int steps_in_interval(double period, int intervals, double longest_step)
{
  constexpr double most_steps_per_period = 3e7;
  const double steps = std::ceil(period / intervals / longest_step - 1e-9);
  if (!(steps * intervals <= most_steps_per_period))
    throw NoSolution(
        format("time integration would need steps of %.3g s in a period of %.3g s, more "
               "than %.3g",
               longest_step, period, most_steps_per_period));
  return std::max(1, static_cast<int>(steps));
}

namespace {

/** S_6 of Blanes and Moan: the shares of a step of the first four drifts, which the later
    three mirror, and of the kicks between them. */
constexpr double d_1 = 0.0792036964311957, d_2 = 0.353172906049774,
                 d_3 = -0.0420650803577195, k_1 = 0.209515106613362,
                 k_2 = -0.143851773179818, k_3 = 0.5 - k_1 - k_2;
constexpr std::array<double, 4> drifts{d_1, d_2, d_3, 1 - 2 * (d_1 + d_2 + d_3)};
constexpr std::array<double, 6> kicks{k_1, k_2, k_3, k_3, k_2, k_1};

/** Central differences: a kick between two half drifts. */
constexpr std::array<double, 1> half_drift{0.5}, whole_kick{1};

}  // namespace

FixedStep::FixedStep(const Parameters& parameters, double omega, int intervals,
                     double longest_step, Rule rule, OperationBudget budget)
    : system_(parameters, omega), turns_(Turns::of(parameters)), intervals_(intervals),
      steps_(steps_in_interval(system_.period(), intervals, longest_step)),
      h_(system_.period() / (static_cast<double>(intervals) * steps_)),
      work_(rule == Rule::splitting          ? Work::splitting
            : rule == Rule::central          ? Work::central
            : parameters.bearing.damping > 0 ? Work::rk4_damped
                                             : Work::rk4),
      is_general_(!has_intact_hertz_alone(parameters)), budget_(std::move(budget))
{
  half_ = turns_.by(0.5 / (static_cast<double>(intervals) * steps_));
  const auto shares =
      rule == Rule::central ? std::span<const double>(half_drift) : std::span(drifts);
  for (std::size_t k = 0; is_split() && k < shares.size(); ++k)
    drifts_[k] = drift_of(shares[k]);
}

FixedStep::Drift<double> FixedStep::drift_of(double share) const
{
  const Equation7<double>& e = system_.equation();
  const double time = share * h_, rate_s = e.c_s * e.per_m_s, rate_r = e.c_r * e.per_m_r;
  const auto shift = [time](double rate) {
    return rate > 0 ? -std::expm1(-rate * time) / rate : time;
  };
  const Angles turns = turns_.by(time / system_.period());
  return {shift(rate_s), std::exp(-rate_s * time),
          shift(rate_r), std::exp(-rate_r * time),
          turns.rotor,   turns.cage};
}

/** So many steps after the start of an interval. */
Angles FixedStep::angles(long first, long done) const
{
  const long interval = first + done / steps_, steps = done % steps_;
  const long part = ((interval % intervals_) + intervals_) % intervals_;
  return turns_.at(static_cast<double>((interval - part) / intervals_),
                   (static_cast<double>(part) * steps_ + static_cast<double>(steps)) /
                       (static_cast<double>(intervals_) * steps_));
}

void FixedStep::pay(long intervals)
{
  const auto of_step = work_ == Work::splitting ? kicks.size()
                       : work_ == Work::central ? whole_kick.size()
                                                : 4;
  const long evaluations = static_cast<long>(of_step) * steps_ * intervals;
  budget_.spend(static_cast<double>(evaluations));
  evaluations_ += evaluations;
}

/**
## Motions side by side

A row holds one number of each motion. Lanes without a motion repeat the last one. */

namespace {

/** Writes the numbers of `value` into lane `l` of their rows. */
template <class Number, class To, class From>
void put_numbers(To& row, int l, const From& value)
{
  constexpr std::size_t size = sizeof(double), count = sizeof(From) / size;
  static_assert(sizeof(To) == count * sizeof(Number));
  const auto from = std::bit_cast<std::array<double, count>>(value);
  auto* const to = reinterpret_cast<std::byte*>(&row) + l * size;
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(to + i * sizeof(Number), &from[i], size);
}

}  // namespace

template <class Number>
struct FixedStep::Row {
  BallRing balls;
  ContactLaw<Number> law;
  Equation7<Number> equation;
  DirectionOf<Number> half_rotor, half_cage, rotor, cage;
  BodiesOf<Number> q, v;
  Number h;
  std::array<Drift<Number>, drifts.size()> drift;  ///< where `is_split`

  void put(int l, const FixedStep& flow, const State& state)
  {
    put_numbers<Number>(law, l, flow.system_.bearing().law());
    put_numbers<Number>(half_rotor, l, flow.half_.rotor);
    put_numbers<Number>(half_cage, l, flow.half_.cage);
    put_numbers<Number>(q, l, state.position);
    put_numbers<Number>(v, l, state.velocity);
    put_numbers<Number>(h, l, flow.h_);
    Equation7<double> e = flow.system_.equation();
    if (flow.is_split()) {
      for (std::size_t k = 0; k < drift.size(); ++k)
        put_numbers<Number>(drift[k], l, flow.drifts_[k]);
      e.c_s = e.c_r = 0;
    }
    put_numbers<Number>(equation, l, e);
  }
  void turn_to(int l, const Angles& at)
  {
    put_numbers<Number>(rotor, l, at.rotor);
    put_numbers<Number>(cage, l, at.cage);
  }
  void get(int l, State& state) const
  {
    const auto bodies = [l](const BodiesOf<Number>& row) -> Bodies {
      return {{lane(row.stator.x, l), lane(row.stator.y, l)},
              {lane(row.rotor.x, l), lane(row.rotor.y, l)}};
    };
    state.position = bodies(q);
    state.velocity = bodies(v);
  }

  template <bool is_damped>
  IN_PLACE BodiesOf<Number> acceleration(const BodiesOf<Number>& q_now,
                                         const BodiesOf<Number>& v_now) const
  {
    const Vec2Of<Number> force =
        bearing_force<is_damped>(balls, law, cage, q_now.relative(), v_now.relative());
    return equation.acceleration(q_now, v_now, rotor, force);
  }
  IN_PLACE void turn_half_a_step()
  {
    rotor = turned(rotor, half_rotor);
    cage = turned(cage, half_cage);
  }

  template <bool is_damped>
  IN_PLACE void step_of_rk4()
  {
    const Number half = 0.5 * h, sixth = h / 6;
    const auto a_1 = acceleration<is_damped>(q, v);
    turn_half_a_step();
    const auto v_2 = v + half * a_1;
    const auto a_2 = acceleration<is_damped>(q + half * v, v_2);
    const auto v_3 = v + half * a_2;
    const auto a_3 = acceleration<is_damped>(q + half * v_2, v_3);
    turn_half_a_step();
    const auto v_4 = v + h * a_3;
    const auto a_4 = acceleration<is_damped>(q + h * v_3, v_4);
    q = q + sixth * (v + 2.0 * v_2 + 2.0 * v_3 + v_4);
    v = v + sixth * (a_1 + 2.0 * a_2 + 2.0 * a_3 + a_4);
  }

  IN_PLACE void drift_by(const Drift<Number>& d)
  {
    q = {q.stator + d.shift_s * v.stator, q.rotor + d.shift_r * v.rotor};
    v = {d.slowing_s * v.stator, d.slowing_r * v.rotor};
    rotor = turned(rotor, d.rotor);
    cage = turned(cage, d.cage);
  }
  template <const auto& shares>  // of the kicks
  IN_PLACE void split_step()
  {
    constexpr int count = shares.size();
    for (int k = 0; k < count; ++k) {
      drift_by(drift[std::min(k, count - k)]);
      v = v + shares[k] * h * acceleration<false>(q, v);
    }
    drift_by(drift[0]);
  }

  /** In registers as wide as the row, or those of the next width. */
  template <Work work>
  void advance(long steps)
  {
    const Registers registers = lanes_in<Number> > 4
                                    ? Registers::avx512
                                    : std::min(widest_registers(), Registers::avx2);
    in_registers(
        registers, [&]() __attribute__((always_inline)) {
          for (long k = 0; k < steps; ++k)
            if constexpr (work == Work::splitting)
              split_step<kicks>();
            else if constexpr (work == Work::central)
              split_step<whole_kick>();
            else
              step_of_rk4<work == Work::rk4_damped>();
        });
  }
};

static FixedStep& flow_of(const Passage& one)
{
  return static_cast<FixedStep&>(*one.flow);
}

/** Lanes that have arrived go on unseen until the last one has. */
template <class Number>
void FixedStep::advance_lanes(std::span<const Passage> passages)
{
  constexpr int width = lanes_in<Number>;
  const auto last = passages.size() - 1;
  const Work work = flow_of(passages[0]).work_;
  Row<Number> row{};
  row.balls = flow_of(passages[0]).system_.bearing().ring();
  std::array<long, width> done{};
  for (int l = 0; l < width; ++l) {
    const Passage& one = passages[std::min<std::size_t>(l, last)];
    row.put(l, flow_of(one), *one.state);
  }
  for (bool is_under_way = true; is_under_way;) {
    long steps = fresh;
    for (int l = 0; l < width; ++l) {
      const Passage& one = passages[std::min<std::size_t>(l, last)];
      const FixedStep& flow = flow_of(one);
      const long left = flow.steps_ * one.count - done[l];
      if (left <= 0) continue;
      if (done[l] % fresh == 0) row.turn_to(l, flow.angles(one.first, done[l]));
      steps = std::min({steps, left, fresh - done[l] % fresh});
      if (one.path) steps = std::min(steps, flow.steps_ - done[l] % flow.steps_);
    }
    switch (work) {
      case Work::rk4: row.template advance<Work::rk4>(steps); break;
      case Work::rk4_damped: row.template advance<Work::rk4_damped>(steps); break;
      case Work::splitting: row.template advance<Work::splitting>(steps); break;
      case Work::central: row.template advance<Work::central>(steps); break;
    }
    is_under_way = false;
    for (int l = 0; l < width; ++l) {
      const Passage& one = passages[std::min<std::size_t>(l, last)];
      const FixedStep& flow = flow_of(one);
      const long left = flow.steps_ * one.count - done[l];
      done[l] += steps;
      is_under_way = is_under_way || left > steps;
      if (left < steps || l > static_cast<int>(last)) continue;
      const bool is_path = one.path && done[l] % flow.steps_ == 0;
      if (left == steps || is_path) row.get(l, *one.state);
      if (is_path) one.path->push_back(*one.state);
    }
  }
}

void FixedStep::advance(long interval, State& state)
{
  pay(1);
  const Passage alone{this, interval, &state};
  if (!is_general_) return advance_row({&alone, 1});
  const auto acceleration = [&](const Bodies& q, const Bodies& v, const Angles& at) {
    return system_.acceleration(q, v, at);
  };
  each_step(interval, [&](const Angles* at) {
    nystrom_step(h_, at, state.position, state.velocity, acceleration);
  });
}

void FixedStep::advance_row(std::span<const Passage> passages)
{
#ifdef HAS_WIDE_REGISTERS
  if (passages.size() > 4) return advance_lanes<Lanes<8>>(passages);
#endif
  if (passages.size() > 2)
    advance_lanes<Lanes<4>>(passages);
  else if (passages.size() > 1)
    advance_lanes<Lanes<2>>(passages);
  else if (!passages.empty())
    advance_lanes<double>(passages);
}

}  // namespace rotor_stator
