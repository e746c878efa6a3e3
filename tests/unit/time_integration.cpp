/** Steppers: order, agreement, energy, and the verdict on the steady state. */
#include "../peers/equation7.hpp"
#include "support/cases.hpp"
#include "time/gsl.hpp"
#include "time/period_map.hpp"
#include "time/settle.hpp"
#include "time/shooting.hpp"
#include "time/side_by_side.hpp"
#include "time/steady_state.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

/** x_r after one second at 7 Hz, from the static start. */
double after_one_second(const Parameters& parameters, const StepSettings& settings)
{
  State state = static_start(parameters);
  const auto stepper = flow(parameters, hertz(7), settings);
  for (long k = 0; k < 7L * settings.intervals_per_period; ++k)
    stepper->advance(k, state);
  return state.position.rotor.x;
}

/** A free rotor beside one ball that stands still, and a stator that is held. */
Parameters on_one_ball()
{
  Parameters machine = set_1();
  machine.unbalance = machine.gravity = 0;
  machine.rotor.natural_frequency = machine.rotor.damping_ratio = 0;
  machine.stator.mass = 1e15;
  machine.stator.rigid = true;
  machine.bearing.balls = 1;
  machine.bearing.cage_speed_ratio = 1e-9;
  return machine;
}

}  // namespace

TEST_CASE("Fixed steps have order 4 where Eq. 7 is smooth")
{
  const auto [method, step] = GENERATE(table<std::string, double>(
      {{"rk4", 4e-3},
       {"splitting", 1e-3}}));  // a step of splitting is four times as long
  Parameters parameters = set_1();
  parameters.bearing.clearance = 1;
  const auto value = [&, name = method](double longest) {
    return after_one_second(parameters,
                            {.method = name, .intervals_per_period = 4, .step = longest});
  };
  const double exact = value(2e-5);
  const double coarse = std::abs(value(step) - exact),
               fine = std::abs(value(step / 2) - exact);
  INFO(method << ": " << coarse << ", " << fine);
  CHECK(coarse / fine > 13);
  CHECK(coarse / fine < 19);
}

/** Bodies of which nothing takes energy but the rule of integration: the rotor vibrates
    on one ball under its load, ten steps of rk4 in a vibration. */
TEST_CASE("The splitting takes nothing of the contact's vibration, where rk4 does")
{
  Parameters machine = on_one_ball();
  machine.rotor.load.y = -50;
  machine.bearing.cage_phase = -std::numbers::pi / 2;  // below the rotor
  const auto energy = [&](const State& at) {
    const double deep = -at.position.relative().y - machine.bearing.clearance;
    REQUIRE(deep > 0);
    const double v = at.velocity.rotor.y;
    return machine.rotor.mass * v * v / 2 - machine.rotor.load.y * at.position.rotor.y +
           machine.bearing.contact_stiffness * std::pow(deep, 2.5) / 2.5;
  };
  const auto pressed = [&](double load) {
    const double deep = std::pow(load / machine.bearing.contact_stiffness, 2.0 / 3);
    return State{.position = {{}, {0, -machine.bearing.clearance - deep}},
                 .velocity = {}};
  };
  const State rest = pressed(50), start = pressed(40);
  const auto lost = [&](const char* method) {
    State state = start;
    const auto stepper = flow(
        machine, hertz(10),
        {.method = method, .intervals_per_period = 1, .step = 4 * default_step(machine)});
    for (long k = 0; k < 20; ++k) stepper->advance(k, state);
    return (energy(start) - energy(state)) / (energy(start) - energy(rest));
  };
  CHECK(std::abs(lost("splitting")) < 0.02);
  CHECK(lost("rk4") > 0.5);
}

/** m v dv/dΔ = -K_H Δ^{3/2} (1 + λ v) between both ends of an impact, Δ = 0: v/λ - ln(1 + λ v)/λ² is the same. */
TEST_CASE("A ball with contact damping throws the rotor back as its energy says")
{
  Parameters machine = on_one_ball();
  machine.bearing.clearance = 0;
  const double lambda = machine.bearing.damping = 2;
  const double omega = hertz(10);
  const auto conserved = [&](double v) {
    return v / lambda - std::log1p(lambda * v) / (lambda * lambda);
  };
  for (const char* method : {"rk4", "rk8pd"}) {
    const auto stepper = flow(
        machine, omega,
        {.method = method, .intervals_per_period = 64, .step = 1e-6, .tolerance = 1e-12});
    const double towards = 0.1;
    State state{.position = {}, .velocity = {.stator = {}, .rotor = {towards, 0}}};
    for (long k = 0; k < 16; ++k) stepper->advance(k, state);
    const double back = state.velocity.rotor.x;
    INFO(method << ": " << back);
    CHECK(state.position.relative().x < 0);
    CHECK(back < -0.5 * towards);
    CHECK(conserved(back) == Approx(conserved(towards)).epsilon(1e-6));
  }
}

TEST_CASE("All steppers agree on a second of motion with contact")
{
  const Parameters parameters = set_1();
  const double exact = after_one_second(
      parameters, {.method = "rk8pd", .intervals_per_period = 16, .tolerance = 1e-13});
  for (const std::string& method : time_methods()) {
    INFO(method);
    const double value = after_one_second(
        parameters,
        {.method = method, .intervals_per_period = 16, .step = 2e-5, .tolerance = 1e-9});
    CHECK(value == Approx(exact).epsilon(1e-4));
  }
}

TEST_CASE("A base period of three turns is the same machine")
{
  const Parameters once = set_1(), thrice = over_turns(once, 3);
  const double omega = angular(17.0);
  State a = static_start(once), b = a;
  const auto turn = flow(once, omega, {.intervals_per_period = 1});
  const auto turns = flow(thrice, omega / 3, {.intervals_per_period = 1});
  for (int k = 0; k < 3; ++k) turn->advance(k, a);
  turns->advance(0, b);
  CHECK(apart(once, a, b) < 1e-6);
  CHECK(vector_of(a).norm() > 0);

  /** What is periodic in T solves the balance of three turns, in every third harmonic. */
  const int m = 6;
  const PeriodicMotion one = motion::find_periodic({once, omega, m});
  REQUIRE(one.found());
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(2, 2 * 3 * m + 1);
  x.col(0) = one.x.head<2>();
  for (int h = 1; h <= m; ++h)
    x.middleCols(6 * h - 1, 2) = one.x.segment<4>(4 * h - 2).reshaped(2, 2);
  Balance balance(bearing_problem(thrice, 3 * one.samples), 3 * m);
  const Eigen::VectorXd start = x.reshaped();
  CHECK(balance.residual(start, omega / 3).norm() <
        1e-8 * balance.problem().residual_scale);
  Balance other(bearing_problem(over_turns(once, 2), 3 * one.samples), 3 * m);
  CHECK(other.residual(start, omega / 3).norm() > 1e-3 * other.problem().residual_scale);
}

TEST_CASE(
    "The steady state ends where its spread settles, or not at all, and counts its work")
{
  SteadySettings settings;
  settings.stepper = {.method = "rk4", .intervals_per_period = 32};
  settings.longest = 6;
  Parameters machine = set_1();
  const auto at = [&](double frequency) {
    return steady_state(machine, hertz(frequency), settings);
  };
  const SteadyState steady = at(30);
  CHECK(steady.periodic);
  CHECK(steady.spread <= settings.settled);
  CHECK(steady.seconds < settings.longest);
  CHECK(steady.states.size() == 32);
  CHECK(steady.evaluations > 0);
  machine.bearing.cage_speed_ratio = 0.4321;  // not in step with the rotor
  CHECK_FALSE(at(6).periodic);
}

/** The reference is a stepper on its own. Would catch a run that waits for another one, one that is looked at an instant
    late, and a cage that is not at home. */
TEST_CASE("Runs to a steady state are the motions that a stepper makes alone")
{
  Parameters odd = set_1();
  odd.bearing.cage_speed_ratio = 0.4;  // at home every five turns
  SteadySettings settings;
  settings.stepper = {.method = "rk4", .intervals_per_period = 32};
  settings.longest = 3;
  settings.window = 0.5;
  settings.average = 0.4;
  settings.shown_periods = 2;
  std::vector<SteadyRun> runs;
  for (const double frequency : {45.0, 45.1, 13.4, 13.5, 6.0, 6.1, 30.0, 30.1})
    runs.push_back({odd, hertz(frequency), static_start(odd), settings});
  runs.back().settings.stepper.method = "rk8";
  std::vector<bool> has_ended(runs.size());
  steady_states(runs, [&](std::size_t k, const SteadyState& steady) {
    const auto& [machine, omega, start, own] = runs[k];
    has_ended[k] = true;
    CHECK(steady.first_period % 5 == 0);
    const auto stepper = flow(machine, omega, own.stepper);
    State state = start;
    std::vector<State> path;
    const long shown =
        std::max(2L, steady.periodic ? 0 : std::lround(0.4 * omega / hertz(1)));
    for (long period = 0; period < steady.first_period + shown; ++period) {
      if (period == steady.first_period) path.assign(1, state);
      advance_together(
          std::vector<Passage>{{stepper.get(), 32 * period, &state, 32, &path}});
    }
    path.pop_back();  // the end of the last period
    REQUIRE(steady.states.size() == path.size());
    for (std::size_t i = 0; i < path.size(); ++i)
      REQUIRE(vector_of(steady.states[i]) == vector_of(path[i]));
    CHECK(steady.evaluations == stepper->evaluations());
  });
  CHECK(has_ended == std::vector<bool>(runs.size(), true));
}

TEST_CASE(
    "Where the bearing alone carries a body, time integration starts in equilibrium")
{
  /** The acceleration at the start is that of the unbalance and no more. One ball under the whole weight, which is not
      where the balls stand, would leave some. */
  Parameters parameters = set_1();
  parameters.rotor.natural_frequency = 0;
  parameters.unbalance = 0;
  const auto is_at_rest = [&] {
    const RotorStator system(parameters, hertz(10));
    const State rest = static_start(parameters);
    const Bodies a =
        system.acceleration(rest.position, rest.velocity, Angles{{1, 0}, {1, 0}});
    for (double value : displacements(a)) CHECK(std::abs(value) < 1e-8);
  };
  for (int balls : {3, 7, 9, 16})
    for (Vec2 load : {Vec2{0, 0}, Vec2{500, -300}, Vec2{-2000, 900}}) {
      parameters.bearing.balls = balls;
      parameters.rotor.load = load;
      is_at_rest();
    }
  std::swap(parameters.stator, parameters.rotor);
  is_at_rest();
}

TEST_CASE("Stiff steppers and other programs are given Eq. 7 and its slopes, in contact")
{
  const Parameters parameters = set_1();
  CountedEquation7 equation(parameters, hertz(45));
  const RotorStator& system = equation.system;
  const double t = 3e-3, h = 1e-8;
  State state = quasi_static_state(parameters, hertz(45));
  state.position.rotor.x += 7e-6;
  const Angles angles = system.bearing().angles(system.omega() * t);
  REQUIRE(system.bearing().reaction(angles.cage, state.position.relative()).stiffness.xx >
          0);
  const Vector8 y = vector_of(state), sizes = state_scales(parameters);
  const auto slope = [&](const Vector8& at, double time) {
    Vector8 rates;
    equation.derivative(time, at.data(), rates.data());
    return rates;
  };
  CHECK(slope(y, t) ==
        vector_of({state.velocity,
                   system.acceleration(state.position, state.velocity, angles)}));

  Eigen::Matrix<double, 8, 8, Eigen::RowMajor> stiff;
  Matrix8 others;
  Vector8 in_time;
  equation_7_slopes(parameters, system, t, y.data(), stiff.data(), in_time.data());
  equation.jacobian(t, y.data(), others.data());
  for (int j = 0; j < 8; ++j) {
    const Vector8 step = 1e-5 * sizes[j] * Vector8::Unit(j);
    const Vector8 difference = (slope(y + step, t) - slope(y - step, t)) / (2 * step[j]);
    CHECK((difference - stiff.col(j)).norm() < 1e-6 * difference.norm());
    CHECK((difference - others.col(j)).norm() < 1e-6 * difference.norm());
  }
  const Vector8 difference = (slope(y, t + h) - slope(y, t - h)) / (2 * h);
  CHECK((difference - in_time).norm() < 1e-6 * in_time.norm());
}
