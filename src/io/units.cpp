#include "io/units.hpp"

#include <algorithm>
#include <numbers>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** A unit that a key may end in, beside the one that is read: own = times/over other. */
struct Unit {
  std::string_view own, other;
  double times, over;
};

constexpr double turn = 2 * std::numbers::pi;
constexpr Unit units[]{
    {"_N_per_m", "_N_per_mm", 1e3, 1},
    {"_N_per_m", "_kN_per_m", 1e3, 1},
    {"_N", "_kN", 1e3, 1},
    {"_N_s_per_m", "_N_s_per_mm", 1e3, 1},
    {"_kg", "_g", 1, 1e3},
    {"_kg", "_t", 1e3, 1},
    {"_kg", "_lb", 0.45359237, 1},
    {"_kg_m", "_g_mm", 1, 1e6},
    {"_Pa", "_MPa", 1e6, 1},
    {"_Pa", "_GPa", 1e9, 1},
    {"_rad_per_s", "_Hz", turn, 1},
    {"_rad_per_s", "_rpm", turn, 60},
    {"_rad", "_deg", turn, 360},
    {"_m", "_mm", 1, 1e3},
    {"_m", "_um", 1, 1e6},
};

/** That of a key, if any; the first that fits. A length in a denominator has none. */
const Unit* unit_of(std::string_view key)
{
  const auto found = std::ranges::find_if(
      units, [&](const Unit& unit) { return key.ends_with(unit.other); });
  if (found == std::end(units)) return nullptr;
  const auto stem = key.substr(0, key.size() - found->other.size());
  return found->own == "_m" && stem.ends_with("_per") ? nullptr : found;
}

}  // namespace

std::string own_key(const std::string& key)
{
  const Unit* const unit = unit_of(key);
  if (!unit) return key;
  return key.substr(0, key.size() - unit->other.size()).append(unit->own);
}

double in_own_unit(const std::string& key, double value)
{
  const Unit* const unit = unit_of(key);
  return unit ? value * unit->times / unit->over : value;
}

std::string meant(const std::string& found, const std::vector<std::string>& known)
{
  std::vector<std::string> all;
  for (const std::string& key : known) {
    const bool says_no_unit = key.find(found) != key.npos;
    for (const Unit& unit : units) {
      if (says_no_unit || !key.ends_with(unit.own)) continue;
      const std::string other =
          key.substr(0, key.size() - unit.own.size()).append(unit.other);
      if (own_key(other) == key) all.push_back(other);
    }
    all.push_back(key);
  }
  return suggestion(found, all);
}

}  // namespace rotor_stator
