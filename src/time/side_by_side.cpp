#include "time/side_by_side.hpp"

#include <algorithm>
#include <tuple>

#include "io/errors.hpp"
#include "time/fixed_step.hpp"

namespace rotor_stator {

std::vector<Failure> advance_together(std::span<const Passage> passages)
{
  /** As many in a row as the registers hold: wider ones take longer than two that fit. */
  const auto widest = static_cast<std::size_t>(widest_registers());
  using Alike = std::tuple<int, FixedStep::Work>;
  struct Lane {
    Passage passage;
    Alike alike;
    long steps;
  };
  thread_local std::vector<Lane> lanes;
  lanes.clear();
  std::vector<Failure> failures;
  for (std::size_t k = 0; k < passages.size(); ++k) {
    const Passage& one = passages[k];
    const auto fixed = dynamic_cast<FixedStep*>(one.flow);
    try {
      if (fixed && !fixed->is_general()) {
        fixed->pay(one.count);
        lanes.push_back({one,
                         {fixed->balls(), fixed->work()},
                         fixed->steps_per_interval() * one.count});
        continue;
      }
      for (long i = 0; i < one.count; ++i) {
        if (one.is_beside)
          one.flow->advance_beside(one.first + i, *one.state);
        else
          one.flow->advance(one.first + i, *one.state);
        if (one.path) one.path->push_back(*one.state);
      }
    } catch (const NoSolution&) {
      failures.push_back({k, std::current_exception()});
    }
  }
  /** None waits long for another one in its row. */
  const auto key = [](const Lane& lane) { return std::tie(lane.alike, lane.steps); };
  if (lanes.size() > widest) std::ranges::stable_sort(lanes, {}, key);
  std::vector<Passage> row;
  row.reserve(widest);
  for (std::size_t k = 0; k < lanes.size(); ++k) {
    row.push_back(lanes[k].passage);
    const bool is_last = k + 1 == lanes.size() || lanes[k + 1].alike != lanes[k].alike;
    if (row.size() < widest && !is_last) continue;
    FixedStep::advance_row(row);
    row.clear();
  }
  return failures;
}

void travel(std::span<Traveller* const> all)
{
  constexpr std::size_t at_once = 16;
  std::vector<Traveller*> under_way;
  std::vector<Passage> passages;
  std::vector<std::size_t> ends;
  for (auto waiting = all.begin(); waiting != all.end() || !under_way.empty();) {
    while (under_way.size() < at_once && waiting != all.end())
      under_way.push_back(*waiting++);
    passages.clear();
    ends.clear();
    std::erase_if(under_way, [&](Traveller* one) {
      const std::size_t before = passages.size();
      one->next(passages);
      if (passages.size() == before) return true;
      ends.push_back(passages.size());
      return false;
    });
    const std::vector<Failure> failures = advance_together(passages);
    auto failure = failures.begin();
    for (std::size_t k = 0; k < under_way.size(); ++k) {
      const auto is_own = [&] {
        return failure != failures.end() && failure->passage < ends[k];
      };
      if (is_own()) {
        under_way[k]->lost(failure->why);
        while (is_own()) ++failure;
        continue;
      }
      try {
        under_way[k]->arrived();
      } catch (const NoSolution&) {
        under_way[k]->lost(std::current_exception());
      }
    }
  }
}

}  // namespace rotor_stator
