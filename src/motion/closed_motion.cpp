#include "motion/closed_motion.hpp"

#include <algorithm>
#include <utility>

#include "io/errors.hpp"
#include "motion/subharmonic.hpp"
#include "time/settle.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::motion {

namespace {

struct Closing {
  const Search& search;
  int turns, points;
  Parameters longer = over_turns(search.parameters, turns);
  double omega = search.omega / turns;

  Shooting shot(State& state, double local_error) const
  {
    return shoot(longer, omega, state,
                 {.tolerance = local_error,
                  .closed = std::max(1e-9, 10 * local_error),
                  .budget = search.budget});
  }

  Motion record(const State& state, double local_error) const
  {
    return one_period(longer, omega, state,
                      {.intervals_per_period = points * turns,
                       .tolerance = local_error,
                       .budget = search.budget});
  }

  using Starts = std::vector<std::pair<std::string, std::function<std::vector<State>()>>>;

  Starts starts() const
  {
    const Parameters& parameters = search.parameters;
    if (turns > 1)
      return {{format("a motion of period %d T", turns),
               [&] { return subharmonic_states(search, turns); }}};
    return {{"quasi-static contact",
             [&] {
               return std::vector{!parameters.machine->takes_explicit_steps()
                                      ? static_start(parameters)
                                      : quasi_static_state(parameters, search.omega)};
             }},
            {"few harmonics",
             [&] {
               const PeriodicMotion solution = find_near_contact(search);
               return solution.found() ? std::vector{state_of(parameters, solution)}
                                       : std::vector<State>{};
             }},
            {"time integration", [&] {
               const Instant rest{static_start(parameters), 0};
               return std::vector{
                   settle(parameters, search.omega, BasePeriod{}, rest, {}, search.budget)
                       .at.state};
             }}};
  }
};

}  // namespace

ClosedMotion closed_motion(const Search& search, int turns, int points,
                           double local_error)
{
  const Parameters& parameters = search.parameters;
  require_rotation_period(parameters, "shooting");
  const Closing closing{search, turns, points};
  std::string why = "no start";
  for (const auto& [name, states] : closing.starts())
    for (State state : states()) {
      const Shooting shooting = closing.shot(state, local_error);
      why = "from " + name + ": " + shooting.reason;
      if (!shooting.converged) continue;
      State finer = state;
      const Motion motion = closing.record(state, local_error);
      if (!closing.shot(finer, 0.01 * local_error).converged) finer = state;
      const Motion exact = closing.record(finer, 0.01 * local_error);
      return {name,
              state,
              motion,
              shooting.correction,
              shooting.maps,
              relative_difference(motion, exact),
              rms_difference(motion, exact)};
    }
  throw NoSolution(format("%s: shooting closed no motion of period %s at %g Hz: %s",
                          parameters.file.c_str(),
                          turns > 1 ? format("%d T", turns).c_str() : "T",
                          search.omega / angular(1), why.c_str()));
}

}  // namespace rotor_stator::motion
