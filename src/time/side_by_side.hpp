/**
# Several motions side by side

Many motions (a response, a map, many starts) take least time when as many are integrated
at once as the registers of the processor hold. Each integration is a traveller: it gives
the passages to be made next, and is told when they have been made. Its result has the
same bits as alone, and one that ends does not end the others.

    Settling one(machine, omega, base, start), two(machine, 2 * omega, base, start);
    travel(std::vector<Traveller*>{&one, &two});
    // one.settled(), two.settled() */
#pragma once

#include <exception>
#include <span>

#include "io/errors.hpp"
#include "time/flow.hpp"

namespace rotor_stator {

/** The way of one motion: `count` output intervals from `first` on. */
struct Passage {
  Flow* flow;
  long first;
  State* state;
  long count = 1;
  std::vector<State>* path = nullptr;  ///< gets the state after each interval
  bool is_beside = false;  ///< with the steps of the passage before it, of one interval
};

/** What stopped one of several passages. */
struct Failure {
  std::size_t passage;
  std::exception_ptr why;
};

/** Makes all passages, those with fixed steps in lanes. A passage that fails (NoSolution)
    leaves its state where it stops. */
std::vector<Failure> advance_together(std::span<const Passage> passages);

class Traveller {
public:
  virtual ~Traveller() = default;

  /** Appends the passages that it makes next, none when it has ended. */
  virtual void next(std::vector<Passage>& all) = 0;

  /** They have been made. May throw NoSolution, which `lost` then gets. */
  virtual void arrived() = 0;

  /** One of them failed; it has ended. */
  virtual void lost(std::exception_ptr why) = 0;
};

/** Until all have ended. Some are under way at once; the others follow in their order. */
void travel(std::span<Traveller* const> all);

template <class Kind>
void travel(std::vector<Attempt<std::unique_ptr<Kind>>>& all)
{
  std::vector<Traveller*> begun;
  for (auto& one : all)
    if (one.has_value() && one.get()) begun.push_back(one.get().get());
  travel(std::span<Traveller* const>(begun));
}

}  // namespace rotor_stator
