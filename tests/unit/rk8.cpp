/** Runge-Kutta of order 8: its order, its steps, and the derivatives of period maps. */
#include "time/rk8.hpp"
#include "support/cases.hpp"
#include "time/fixed_step.hpp"
#include "time/flow.hpp"
#include "time/period_map.hpp"
#include "time/turns.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

double distance(const Parameters& parameters, const State& a, const State& b)
{
  return (vector_of(a) - vector_of(b))
      .cwiseQuotient(state_scales(parameters))
      .cwiseAbs()
      .maxCoeff();
}

/** The rotor hangs on one ball that it never leaves: smooth, and not linear. */
Parameters on_one_ball()
{
  Parameters machine = set_1();
  machine.bearing.balls = 1;
  machine.bearing.cage_speed_ratio = 1e-9;
  machine.rotor.load = {2000, 0};
  return machine;
}

/** Set 1 with contact damping, and a spall in one of its surfaces or none. */
Parameters damaged(double damping, std::optional<Defect::Surface> surface = {})
{
  Parameters machine = set_1();
  machine.bearing.damping = damping;
  if (!surface) return machine;
  machine.bearing.defect = {
      .surface = *surface, .depth = 2e-6, .width = 0.3, .place = -1.5};
  if (surface == Defect::Surface::ball) machine.bearing.defect.spin = 2.3;
  return machine;
}

/** After twenty turns from rest. */
State settled(const Parameters& machine, double omega)
{
  State state = static_start(machine);
  const auto before = flow(machine, omega, {.method = "rk4", .intervals_per_period = 1});
  for (long k = -20; k < 0; ++k) before->advance(k, state);
  return state;
}

}  // namespace

TEST_CASE("A damaged ball spins before t = 0 as it does after")
{
  const Parameters machine = damaged(0, Defect::Surface::ball);
  for (double periods : {-7.0, 3.0}) {
    const double angle = 2 * std::numbers::pi * machine.bearing.defect.spin;
    const Direction spin = Turns::of(machine).at(periods, 0.25).spin;
    CHECK(spin.cos == Approx(std::cos(angle * (periods + 0.25))).margin(1e-13));
    CHECK(spin.sin == Approx(std::sin(angle * (periods + 0.25))).margin(1e-13));
  }
}

/** Catches a wrong instant of a stage (order 1) and a wrong weight of an estimate, which
    would not shrink with the power 8. */
TEST_CASE("A step of rk8 has an error of order 9, and an estimate of it of order 8")
{
  const Parameters machine = on_one_ball();
  const double omega = hertz(7);
  State start = static_start(machine);
  start.position.rotor.x += 0.1 * scales(machine).penetration;
  struct Errors {
    double true_one, estimate;
  };
  const auto errors = [&](int parts) {
    State state = start, exact = start;
    const double estimate = Rk8(machine, omega, 1, 1).step(1. / parts, state);
    Rk8(machine, omega, parts, 1e-15).advance(0, exact);
    CHECK(exact.position.relative().x > machine.bearing.clearance);
    return Errors{distance(machine, state, exact), estimate};
  };
  const int parts = static_cast<int>(1 / (7 * default_step(machine) * 8));
  const Errors coarse = errors(parts), fine = errors(2 * parts);
  INFO("errors " << coarse.true_one << ", " << fine.true_one << ", estimates "
                 << coarse.estimate << ", " << fine.estimate);
  CHECK(std::log2(coarse.true_one / fine.true_one) == Approx(9).margin(0.7));
  CHECK(std::log2(coarse.estimate / fine.estimate) == Approx(8).margin(0.7));
  CHECK(coarse.estimate > coarse.true_one);
  CHECK(fine.estimate > fine.true_one);
}

/** The other stepper shares no coefficient, no error estimate and no choice of steps with
    this one. */
TEST_CASE("rk8 goes where GSL's rk8pd goes, and its disturbances where those of rk4 go")
{
  Parameters out_of_step = damaged(2);
  out_of_step.bearing.cage_speed_ratio = 0.4173;
  struct Case {
    Parameters machine;
    double frequency = 45;
    double near = 2e-10, near_derivative = 6e-6;  // where balls begin and cease to touch
  };
  const auto [machine, frequency, near, near_derivative] =
      GENERATE_COPY(values<Case>({{on_one_ball(), 7, 1e-12, 3e-7},
                                  {set_1()},
                                  {set_1(), 30},
                                  {out_of_step},
                                  {damaged(2, Defect::Surface::outer_race)},
                                  {damaged(0, Defect::Surface::ball)}}));
  const double omega = hertz(frequency);
  const State start = settled(machine, omega);
  State ours = start, theirs = start;
  const StepSettings exact{
      .method = "rk8pd", .intervals_per_period = 4, .tolerance = 1e-14};
  const auto gsl = flow(machine, omega, exact);
  Rk8 rk8(machine, omega, 4, 1e-14);
  for (long k = -3; k < 3; ++k) {
    rk8.advance(k, ours);
    gsl->advance(k, theirs);
  }
  CHECK(distance(machine, ours, theirs) < near);
  CHECK(distance(machine, ours, start) > 1e-3);

  const Vector8 sizes = state_scales(machine);
  const PeriodMap map = period_map(machine, omega, start,
                                   {.intervals_per_period = 1, .tolerance = 1e-14}),
                  other = period_map(
                      machine, omega, start,
                      {.method = "rk4", .intervals_per_period = 1, .step = 2e-7});
  theirs = start;
  flow(machine, omega, {.method = "rk8pd", .intervals_per_period = 1, .tolerance = 1e-14})
      ->advance(0, theirs);
  CHECK(distance(machine, map.end, theirs) < near);
  const Matrix8 apart = sizes.cwiseInverse().asDiagonal() *
                        (map.derivative - other.derivative) * sizes.asDiagonal();
  CHECK(apart.cwiseAbs().maxCoeff() < near_derivative);
}

TEST_CASE("A period map is its method's, and its derivative that of its differences")
{
  struct Case {
    const char* method;
    Parameters machine;
    double shift, most;  // rk4 has some 100 steps in a turn
  };
  const auto [method, machine, shift, most] =
      GENERATE(values<Case>({{"rk8", set_1(), 2e-6, 1e-5},
                             {"rk8", damaged(5), 2e-6, 1e-5},
                             {"rk8", damaged(5, Defect::Surface::outer_race), 2e-6, 1e-5},
                             {"rk8", damaged(5, Defect::Surface::inner_race), 2e-6, 1e-5},
                             {"rk4", set_1(), 1e-7, 1e-4},
                             {"rk4", damaged(5), 1e-7, 1e-4}}));
  INFO(method << ", damping " << machine.bearing.damping);
  const double omega = hertz(45);
  const StepSettings settings{.method = method,
                              .intervals_per_period = 1,
                              .step = std::string(method) == "rk4" ? 1e-4 : 0,
                              .tolerance = 1e-14};
  const State start = settled(machine, omega);
  const Vector8 y = vector_of(start), sizes = state_scales(machine);
  const auto end = [&](const Vector8& at) -> Vector8 {
    State state = state_of(at);
    flow(machine, omega, settings)->advance(0, state);
    return vector_of(state);
  };
  const PeriodMap map = period_map(machine, omega, start, settings);
  CHECK(distance(machine, map.end, state_of(end(y))) < 1e-10);
  const Matrix8 scaled =
      sizes.cwiseInverse().asDiagonal() * map.derivative * sizes.asDiagonal();
  for (int j = 0; j < 8; ++j) {
    const Vector8 step = shift * sizes[j] * Vector8::Unit(j);
    const Vector8 difference = (end(y + step) - end(y - step)) / (2 * shift);
    const Vector8 error = difference.cwiseQuotient(sizes) - scaled.col(j);
    CHECK(error.norm() < most * std::max(1.0, scaled.norm()));
  }
}

TEST_CASE("The work of rk8 is counted and paid for, also of rejected steps")
{
  OperationBudget budget(1e9);
  Rk8 rk8(set_1(), hertz(20), 16, 1e-10, budget);
  State state = static_start(set_1());
  for (long k = 0; k < 64; ++k) rk8.advance(k, state);
  CHECK(rk8.evaluations() % dop853::stages == 0);
  CHECK(rk8.rejected_steps() > 0);
  CHECK(rk8.evaluations() > dop853::stages * (rk8.rejected_steps() + 64));
  const auto paid = static_cast<double>(rk8.evaluations()) * Rk8::price;
  CHECK(budget.spent() == Approx(paid));
  Matrix8 derivative = Matrix8::Identity();
  const long before = rk8.evaluations();
  rk8.advance(64, state, derivative);
  const auto more = static_cast<double>(rk8.evaluations() - before);
  CHECK(budget.spent() == Approx(paid + more * Rk8::price_with_derivative));

  Rk8 poor(set_1(), hertz(20), 1, 1e-10, OperationBudget(500));
  CHECK_THROWS_AS(poor.advance(0, state), NoSolution);

  state.velocity.rotor.x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(rk8.advance(0, state), NoSolution);
}

TEST_CASE("A motion by rk8 depends on its start and its instant alone")
{
  Parameters machine = set_1();
  machine.bearing.cage_speed_ratio = 0.5;
  const State start = static_start(machine);
  Rk8 rk8(machine, hertz(25), 8, 1e-11);
  State first = start, again = start, earlier = start;
  rk8.advance(0, first);
  rk8.advance(0, again);
  CHECK(displacements(first.position) == displacements(again.position));
  CHECK(displacements(first.velocity) == displacements(again.velocity));
  rk8.advance(-16, earlier);  // two turns before, where everything stands as at 0
  CHECK(distance(machine, first, earlier) < 1e-12);
  CHECK(distance(machine, first, start) > 1e-6);
}

TEST_CASE("rk8 has the same bits with registers of each width")
{
  Parameters machine = set_1();
  for (double damping : {0., 1.}) {
    machine.bearing.damping = damping;
    const auto run = [&](Registers width) {
      use_registers(width);
      Rk8 rk8(machine, hertz(22), 16, 1e-11);
      State state = static_start(machine);
      Matrix8 derivative = Matrix8::Identity();
      for (long k = -2; k < 2; ++k) rk8.advance(k, state);
      for (long k = 2; k < 4; ++k) rk8.advance(k, state, derivative);
      use_registers(Registers::avx512);
      using Bits = std::array<std::uint64_t, 72>;
      std::array<double, 72> values;
      Eigen::Map<Vector8>(values.data()) = vector_of(state);
      Eigen::Map<Matrix8>(values.data() + 8) = derivative;
      return std::bit_cast<Bits>(values);
    };
    const auto plain = run(Registers::plain);
    CHECK(run(Registers::avx2) == plain);
    CHECK(run(Registers::avx512) == plain);
  }
}
