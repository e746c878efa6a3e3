#include "time/section.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

int closing_period(std::span<const Displacements> section, double closed)
{
  constexpr std::size_t fewest = 9;
  for (std::size_t k = 1; k <= most_period; ++k) {
    const std::size_t window = std::max(fewest, 3 * k + 1);
    if (section.size() < window) break;
    if (extent(section.last(window), k) < closed) return static_cast<int>(k);
  }
  return 0;
}

BatchMean batch_mean(const std::vector<double>& series, std::size_t most_batches)
{
  const std::size_t batches = std::min(most_batches, series.size());
  const auto count = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / count;
  double squares = 0;
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const std::size_t first = batch * series.size() / batches;
    const std::size_t last = (batch + 1) * series.size() / batches;
    double part = 0;
    for (std::size_t k = first; k < last; ++k)
      part += series[k] / static_cast<double>(last - first);
    squares += (part - mean) * (part - mean);
  }
  const auto n = static_cast<double>(batches * std::max<std::size_t>(1, batches - 1));
  return {mean, std::sqrt(squares / n)};
}

BatchMean long_mean(const std::vector<double>& series)
{
  BatchMean mean = batch_mean(series);
  mean.error = std::max(mean.error, batch_mean(series, 4).error);
  return mean;
}

}  // namespace rotor_stator
