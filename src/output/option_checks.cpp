#include "output/option_checks.hpp"

#include <cmath>

#include "balance/fourier_transform.hpp"
#include "model/errors.hpp"

namespace rotor_stator
{

void require_positive(const char* option, double value)
{
  constexpr double most = 1e300;  // 2 pi times as much is still a number
  if (!(value > 0 && value <= most))
    throw BadInput(
        text("%s %g: must be a finite number > 0, at most %g", option, value, most));
}

void require_between(const char* option, double value, double least, double most)
{
  if (!(value >= least && value <= most))
    throw BadInput(text("%s %g: must be in %g...%g", option, value, least, most));
}

void require_range(const char* option, int value, int least, int most)
{
  if (value < least || value > most)
    throw BadInput(text("%s %d: must be in %d...%d", option, value, least, most));
}

int checked_samples(int harmonics, const std::optional<int>& samples)
{
  require_range("--harmonics", harmonics, 1, 4096);
  if (samples) require_range("--samples", *samples, 2 * harmonics + 1, 1 << 20);
  return samples.value_or(default_samples(harmonics));
}

}  // namespace rotor_stator
