/**
# The three kinds of contenders */
#pragma once

#include <memory>

#include "scenes/contender.hpp"

namespace rotor_stator
{

/** A solver of all speeds of a task, as a contender. */
template <class Solver>
Contender contender(const Task& task, const Setting& setting)
{
  const auto solver = std::make_shared<Solver>(task, setting);
  return {.run = [solver] { solver->run(); },
          .motions = [solver](int points) { return solver->motions(points); },
          .counts = [solver] { return solver->counts(); }};
}

Contender aft_contender(const Task& task, const Setting& setting);
Contender time_contender(const Task& task, const Setting& setting);
Contender shooting_contender(const Task& task, const Setting& setting);

}  // namespace rotor_stator
