#include "time/section.hpp"

#include <algorithm>
#include <cmath>

namespace rotor_stator {

double extent(std::span<const Displacements> section, std::size_t apart)
{
  double widest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (apart == 0) {
      const auto [low, high] = std::ranges::minmax_element(
          section, {}, [i](const Displacements& q) { return q[i]; });
      widest = std::max(widest, (*high)[i] - (*low)[i]);
    }
    for (std::size_t n = apart; apart > 0 && n < section.size(); ++n)
      widest = std::max(widest, std::abs(section[n][i] - section[n - apart][i]));
  }
  return widest;
}

int closing_period(std::span<const Displacements> section, double closed, int most_period)
{
  constexpr std::size_t fewest = 9;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(most_period); ++k) {
    const std::size_t window = std::max(fewest, 3 * k + 1);
    if (section.size() < window) break;
    if (extent(section.last(window), k) < closed) return static_cast<int>(k);
  }
  return 0;
}

}  // namespace rotor_stator
