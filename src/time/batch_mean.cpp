#include "time/batch_mean.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rotor_stator {

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
