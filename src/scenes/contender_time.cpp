/**
# Contenders: time integration and shooting

One motion, timed with its transient, or with the start and the maps of shooting. */
#include <cmath>
#include <numbers>

#include "continuation/lagrange_predictor.hpp"
#include "integration/rk4.hpp"
#include "integration/time_stepper.hpp"
#include "model/errors.hpp"
#include "model/quasi_static_state.hpp"
#include "scenes/contender_kinds.hpp"
#include "scenes/scene_file.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator
{

namespace
{

/** A state of the motion at phase 0, `periods` after t = 0. */
struct Reached {
  double frequency;  ///< [Hz]
  long periods;
  State state;
};

StepperSettings stepper_settings(const Setting& setting, int intervals)
{
  const std::string method = setting.is_shooting()
                                 ? setting.method.substr(std::string("shooting-").size())
                                 : setting.method;
  return {.method = method,
          .intervals_per_period = intervals,
          .step = setting.step,
          .tolerance = setting.tolerance};
}

/** One period from each state, by the same method at the same setting. */
Motions periods_from(const Task& task, const Setting& setting, int points,
                     const std::vector<std::optional<Reached>>& reached)
{
  Motions motions;
  for (const auto& start : reached) {
    motions.emplace_back();
    if (!start) continue;
    State state = start->state;
    try {
      const TimeStepper stepper = make_stepper(task.parameters, angular(start->frequency),
                                               stepper_settings(setting, points));
      motions.back() = recorded(stepper, points, state, start->periods);
    } catch (const NoSolution&) {
      // the state was no motion
    }
  }
  return motions;
}

/** A transient of whole periods at each speed. */
class Transients
{
public:
  Transients(const Task& task, const Setting& setting) : task_(task), setting_(setting) {}

  void run()
  {
    reached_.clear();
    counts_ = {};
    State state = task_.before ? task_.before->state : static_start(task_.parameters);
    for (double frequency : task_.frequencies) {
      const TimeStepper stepper = make_stepper(task_.parameters, angular(frequency),
                                               stepper_settings(setting_, 1));
      const long periods = std::lround(std::ceil(setting_.transient * frequency - 1e-9));
      reached_.emplace_back();
      try {
        for (long k = 0; k < periods; ++k) stepper.advance(k, state);
        reached_.back() = {frequency, periods, state};
      } catch (const NoSolution&) {
        state = static_start(task_.parameters);
      }
      counts_.force_instants += stepper.evaluations();
    }
  }

  Motions motions(int points) const
  {
    return periods_from(task_, setting_, points, reached_);
  }
  Counts counts() const { return counts_; }

private:
  Task task_;
  Setting setting_;
  std::vector<std::optional<Reached>> reached_;
  Counts counts_;
};

/** Newton on the period map at each speed. */
class Shots
{
public:
  Shots(const Task& task, const Setting& setting) : task_(task), setting_(setting) {}

  void run()
  {
    reached_.clear();
    counts_ = {};
    const SweepSettings scaling = sweep_settings(task_.parameters);
    LagrangePredictor predictor(1, scaling.speed_scale);
    jacobian_.reset();
    if (task_.before)
      predictor.add(scaled(task_.before->state), angular(task_.before->frequency));
    for (double frequency : task_.frequencies) {
      reached_.emplace_back();
      const double omega = angular(frequency);
      State state =
          predictor.empty() ? cold_start(omega) : unscaled(predictor.at_speed(omega));
      if (!shot(omega, state)) {
        predictor.clear();
        jacobian_.reset();
        state = cold_start(omega);
        if (!shot(omega, state)) continue;
      }
      predictor.add(scaled(state), omega);
      reached_.back() = {frequency, 0, state};
    }
  }

  Motions motions(int points) const
  {
    return periods_from(task_, setting_, points, reached_);
  }
  Counts counts() const { return counts_; }

private:
  /** Quasi-static contact, and a transient if the setting has one. */
  State cold_start(double omega)
  {
    State state = quasi_static_state(task_.parameters, omega);
    const TimeStepper stepper =
        make_stepper(task_.parameters, omega, stepper_settings(setting_, 1));
    const double periods = std::ceil(setting_.transient * omega / (2 * std::numbers::pi));
    for (long k = 0; k < std::lround(periods); ++k) stepper.advance(k, state);
    counts_.force_instants += stepper.evaluations();
    return state;
  }

  bool shot(double omega, State& state)
  {
    const StepperSettings stepper = stepper_settings(setting_, 1);
    const Shooting result = shoot(task_.parameters, omega, state,
                                  {.method = stepper.method,
                                   .tolerance = setting_.tolerance,
                                   .step = setting_.step,
                                   .closure = setting_.closure,
                                   .final_derivative = false},
                                  &jacobian_);
    counts_.force_instants += result.evaluations;
    counts_.maps += result.maps;
    counts_.derivatives += result.derivatives;
    return result.converged;
  }

  Eigen::VectorXd scaled(const State& state) const
  {
    return vector_of(state).cwiseQuotient(state_scales(task_.parameters));
  }
  State unscaled(const Eigen::VectorXd& y) const
  {
    return state_of(Vector8(y.cwiseProduct(state_scales(task_.parameters))));
  }

  Task task_;
  Setting setting_;
  ClosureJacobian jacobian_;
  std::vector<std::optional<Reached>> reached_;
  Counts counts_;
};

}  // namespace

Contender time_contender(const Task& task, const Setting& setting)
{
  return contender<Transients>(task, setting);
}

Contender shooting_contender(const Task& task, const Setting& setting)
{
  return contender<Shots>(task, setting);
}

}  // namespace rotor_stator
