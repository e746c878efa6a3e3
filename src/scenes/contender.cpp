#include "scenes/contender.hpp"

#include <algorithm>
#include <cmath>

#include "model/errors.hpp"
#include "scenes/contender_kinds.hpp"

namespace rotor_stator
{

int rounded_up(int harmonics)
{
  int unit = 1;
  while (harmonics > 8 * unit) unit *= 2;
  return (harmonics + unit - 1) / unit * unit;
}

int harmonics_at(const Setting& setting, double frequency)
{
  if (setting.corner == 0) return setting.harmonics;
  const int wanted = static_cast<int>(std::ceil(setting.corner / frequency));
  return std::max(setting.harmonics, rounded_up(wanted));
}

int samples_for(const Setting& setting, int harmonics)
{
  return fast_transform_size(
      std::max(2 * harmonics + 2, setting.samples_per_harmonic * harmonics + 1));
}

std::string Setting::text() const
{
  std::string words;
  const auto add = [&](const std::string& word) {
    words += (words.empty() ? "" : " ") + word;
  };
  using rotor_stator::text;
  if (harmonics > 0) add(text(corner + estimate > 0 ? "m>=%d" : "m=%d", harmonics));
  if (corner > 0) add(text("m*f>=%g", corner));
  if (estimate > 0) add(text("estimate<%g", estimate));
  if (samples_per_harmonic > 0) add(text("N>%dm", samples_per_harmonic));
  if (step > 0) add(text("step=%g", step));
  if (tolerance > 0) add(text("tol=%g", tolerance));
  if (transient > 0) add(text("transient=%g", transient));
  if (closure > 0) add(text("closure=%g", closure));
  return words;
}

Contender make_contender(const Task& task, const Setting& setting)
{
  if (setting.method == "aft") return aft_contender(task, setting);
  if (setting.is_shooting()) return shooting_contender(task, setting);
  return time_contender(task, setting);
}

}  // namespace rotor_stator
