#include "time/rk4.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

int steps_in_interval(double period, int intervals, double longest_step)
{
  constexpr double most_steps_per_period = 3e7;
  const double steps = std::ceil(period / intervals / longest_step - 1e-9);
  if (!(steps * intervals <= most_steps_per_period))
    throw NoSolution(
        format("rk4 would need steps of %.3g s in a period of %.3g s, more than %.3g",
               longest_step, period, most_steps_per_period));
  return std::max(1, static_cast<int>(steps));
}

Rk4::Rk4(const Parameters& parameters, double omega, int intervals, double longest_step,
         OperationBudget budget)
    : system_(parameters, omega), turns_(Turns::of(parameters)), intervals_(intervals),
      steps_(steps_in_interval(system_.period(), intervals, longest_step)),
      h_(system_.period() / (static_cast<double>(intervals) * steps_)),
      is_general_(!parameters.bearing.has_kernel()),
      is_damped_(parameters.bearing.damping > 0), budget_(std::move(budget))
{
  half_ = turns_.by(0.5 / (static_cast<double>(intervals) * steps_));
}

/** So many steps after the start of an interval. */
Angles Rk4::angles(long first, long done) const
{
  const long interval = first + done / steps_, steps = done % steps_;
  const long part = ((interval % intervals_) + intervals_) % intervals_;
  return turns_.at(static_cast<double>((interval - part) / intervals_),
                   (static_cast<double>(part) * steps_ + static_cast<double>(steps)) /
                       (static_cast<double>(intervals_) * steps_));
}

void Rk4::pay(long intervals)
{
  const long evaluations = 4L * steps_ * intervals;
  budget_.spend(static_cast<double>(evaluations));
  evaluations_ += evaluations;
}

/**
## Motions side by side

A row holds one number of each motion. Lanes without a motion repeat the last one. */
template <class Number>
struct Rk4::Row {
  BallRing balls;
  Contacts<Number> contacts;
  Equation7<Number> equation;
  DirectionOf<Number> half_rotor, half_cage, rotor, cage;
  BodiesOf<Number> q, v;
  Number h;

  void put(int l, const Rk4& flow, const State& state)
  {
    const Equation7<double>& e = flow.system_.equation();
    const Contacts<double> c = flow.system_.bearing().contacts();
    const auto each = [l]<class To, class From>(To& row, const From& value) {
      constexpr auto count = sizeof(From) / sizeof(double);
      auto to = std::bit_cast<std::array<Number, count>>(row);
      const auto from = std::bit_cast<std::array<double, count>>(value);
      for (std::size_t i = 0; i < count; ++i) put_lane(to[i], l, from[i]);
      row = std::bit_cast<To>(to);
    };
    each(equation, e);
    each(contacts, c);
    each(half_rotor, flow.half_.rotor);
    each(half_cage, flow.half_.cage);
    each(q, state.position);
    each(v, state.velocity);
    put_lane(h, l, flow.h_);
  }
  void turn_to(int l, const Angles& at)
  {
    put_lane(rotor.cos, l, at.rotor.cos);
    put_lane(rotor.sin, l, at.rotor.sin);
    put_lane(cage.cos, l, at.cage.cos);
    put_lane(cage.sin, l, at.cage.sin);
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
    const Vec2Of<Number> force = bearing_force<is_damped>(
        balls, contacts, cage, q_now.relative(), v_now.relative());
    return equation.acceleration(q_now, v_now, rotor, force);
  }
  IN_PLACE void turn_half_a_step()
  {
    rotor = turned(rotor, half_rotor);
    cage = turned(cage, half_cage);
  }

  template <bool is_damped>
  IN_PLACE void advance(long steps)
  {
    const Number half = 0.5 * h, sixth = h / 6;
    for (long k = 0; k < steps; ++k) {
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
  }
};

namespace {

/** One function for each kind of registers: what it calls is a part of it. */
template <bool is_damped, class Row>
void advance_plain(Row& row, long steps)
{
  row.template advance<is_damped>(steps);
}

#ifdef HAS_WIDE_REGISTERS
template <bool is_damped, class Row>
__attribute__((target("avx2"))) void advance_avx2(Row& row, long steps)
{
  row.template advance<is_damped>(steps);
}

template <bool is_damped, class Row>
__attribute__((target("avx512f"))) void advance_avx512(Row& row, long steps)
{
  row.template advance<is_damped>(steps);
}
#endif

Registers registers_of_processor()
{
#ifdef HAS_WIDE_REGISTERS
  if (__builtin_cpu_supports("avx512f")) return Registers::avx512;
  if (__builtin_cpu_supports("avx2")) return Registers::avx2;
#endif
  return Registers::plain;
}

Registers& registers_in_use()
{
  static Registers in_use = registers_of_processor();
  return in_use;
}

template <bool is_damped, class Row>
void advance_by(Row& row, long steps)
{
#ifdef HAS_WIDE_REGISTERS
  constexpr auto width = sizeof(row.h) / sizeof(double);
  if constexpr (width > 4) return advance_avx512<is_damped>(row, steps);
  if (registers_in_use() >= Registers::avx2) return advance_avx2<is_damped>(row, steps);
#endif
  advance_plain<is_damped>(row, steps);
}

}  // namespace

Registers widest_registers()
{
  return registers_in_use();
}

void use_registers(Registers widest)
{
  registers_in_use() = std::min(widest, registers_of_processor());
}

static Rk4& flow_of(const Passage& one)
{
  return static_cast<Rk4&>(*one.flow);
}

/** Lanes that have arrived go on unseen until the last one has. */
template <class Number>
void Rk4::advance_lanes(std::span<const Passage> passages)
{
  constexpr int width = lanes_in<Number>;
  const auto last = passages.size() - 1;
  Row<Number> row{};
  row.balls = flow_of(passages[0]).system_.bearing().ring();
  std::array<long, width> done{};
  bool is_damped = false;
  for (int l = 0; l < width; ++l) {
    const Passage& one = passages[std::min<std::size_t>(l, last)];
    row.put(l, flow_of(one), *one.state);
    is_damped = is_damped || flow_of(one).is_damped_;
  }
  for (bool is_under_way = true; is_under_way;) {
    long steps = fresh;
    for (int l = 0; l < width; ++l) {
      const Passage& one = passages[std::min<std::size_t>(l, last)];
      const Rk4& flow = flow_of(one);
      const long left = flow.steps_ * one.count - done[l];
      if (left <= 0) continue;
      if (done[l] % fresh == 0) row.turn_to(l, flow.angles(one.first, done[l]));
      steps = std::min({steps, left, fresh - done[l] % fresh});
      if (one.path) steps = std::min(steps, flow.steps_ - done[l] % flow.steps_);
    }
    is_damped ? advance_by<true>(row, steps) : advance_by<false>(row, steps);
    is_under_way = false;
    for (int l = 0; l < width; ++l) {
      const Passage& one = passages[std::min<std::size_t>(l, last)];
      const Rk4& flow = flow_of(one);
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

void Rk4::advance(long interval, State& state)
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

std::size_t Rk4::widest_row()
{
  switch (registers_in_use()) {
    case Registers::avx512: return 8;
    case Registers::avx2: return 4;
    case Registers::plain: break;
  }
  return 2;
}

void Rk4::advance_row(std::span<const Passage> passages)
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
