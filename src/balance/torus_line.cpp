#include "balance/torus_line.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "balance/fourier_transform.hpp"

namespace rotor_stator {

Bearing bearing_along(const TorusLine& line, Bearing bearing)
{
  const bool is_on_it = line.turns == 1 && has_rotation_period(bearing) &&
                        std::lround(passages_per_turn(bearing)) == line.z;
  if (!is_on_it)
    bearing.cage_speed_ratio = static_cast<double>(line.turns * line.z) / bearing.balls;
  return bearing;
}

double order_of(Harmonic h, const Bearing& bearing)
{
  return h.k_1 + h.k_2 * passages_per_turn(bearing);
}

/** One of each pair of opposite ones, that of positive order, ascending after the
    mean. */
static Harmonics ascending(const std::set<Harmonic>& pairs, const Bearing& bearing)
{
  std::vector<Harmonic> list;
  for (Harmonic h : pairs) {
    const double order = order_of(h, bearing);
    if (order > 0 || (order == 0 && (h.k_2 > 0 || (h.k_2 == 0 && h.k_1 >= 0))))
      list.push_back(h);
  }
  std::ranges::stable_sort(list, {}, [&](Harmonic h) { return order_of(h, bearing); });
  const auto mean = std::ranges::find(list, Harmonic{0, 0});
  std::rotate(list.begin(), mean, mean + 1);
  return Harmonics(std::move(list));
}

Harmonics orders_up_to(int m, const Bearing& bearing)
{
  std::set<Harmonic> pairs;
  for (double k_2 = -m; k_2 <= m; ++k_2)
    for (double k_1 = std::abs(k_2) - m; k_1 <= m - std::abs(k_2); ++k_1)
      pairs.insert({k_1, k_2});
  return ascending(pairs, bearing);
}

Harmonics joined(const Harmonics& first, const Harmonics& others)
{
  std::vector<Harmonic> list = first.list();
  for (Harmonic h : others.list())
    if (std::ranges::find(first.list(), h) == first.list().end()) list.push_back(h);
  return Harmonics(std::move(list));
}

Harmonics up_to(double order, int passages, const Bearing& bearing, Harmonic half)
{
  std::set<Harmonic> pairs;
  for (const Harmonic moved : {Harmonic{}, half})
    for (double k_2 = moved.k_2 - passages; k_2 <= passages; ++k_2) {
      const double passing = k_2 * passages_per_turn(bearing);
      const double lowest = std::ceil(-order - passing - moved.k_1);
      for (double k_1 = moved.k_1 + lowest; k_1 + passing <= order; ++k_1)
        pairs.insert({k_1, k_2});
    }
  return ascending(pairs, bearing);
}

namespace {

/** Looks for z with one number of samples. */
struct LineSearch {
  std::vector<Harmonic> kept, others;
  int turns;
  std::vector<int> taken_by = {};  ///< the last z that took this image

  bool is_free(int z, int n)
  {
    for (Harmonic h : kept)
      if (std::exchange(taken_by[image(h, z, n)], z) == z) return false;
    if (taken_by.back() == z) return false;
    return std::ranges::none_of(
        others, [&](Harmonic h) { return taken_by[image(h, z, n)] == z; });
  }

  std::size_t image(Harmonic h, int z, int n) const
  {
    const auto p = std::abs(std::lround(turns * (h.k_1 + z * h.k_2)) % n);
    return static_cast<std::size_t>(std::min(p, n - p));
  }
};

}  // namespace

TorusLine line_without_images(const Harmonics& kept, const Harmonics& others,
                              int least_samples, int turns)
{
  LineSearch search{kept.list(), others.list(), turns};
  std::erase_if(search.others, [&](Harmonic h) {
    return std::ranges::find(search.kept, h) != search.kept.end();
  });
  for (int n = fast_transform_size(std::max(least_samples, 4 * kept.count()));;
       n = fast_transform_size(n + n / 16 + 1)) {
    search.taken_by.assign(static_cast<std::size_t>(n / 2 + 1), 0);
    for (int z = 1; z <= n / 2; ++z)
      if (search.is_free(z, n)) return {z, n, turns};
  }
}

}  // namespace rotor_stator
