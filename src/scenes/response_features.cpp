#include "scenes/response_features.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "balance/bearing_problem.hpp"
#include "model/errors.hpp"
#include "scenes/response.hpp"

namespace rotor_stator
{

namespace
{

/** The vertex of the parabola through a, b, c at -1, 0, 1, where b is an extreme. */
struct Vertex {
  double at, height;
};

Vertex vertex(double a, double b, double c)
{
  const double bend = a - 2 * b + c;
  if (bend == 0) return {0, b};
  const double at = 0.5 * (a - c) / bend;
  return {at, b - 0.25 * (a - c) * at};
}

/** The amplitude of x_r [m] at each speed [Hz]; 0 where there is no solution. */
using Amplitudes = std::function<std::vector<double>(const std::vector<double>&)>;

std::size_t largest(const std::vector<double>& values, const Model& model)
{
  const auto at = std::max_element(values.begin(), values.end()) - values.begin();
  if (at == 0 || at + 1 == static_cast<std::ptrdiff_t>(values.size()))
    throw NoSolution(model.parameters.file +
                     ": the largest amplitude is at an end of the speeds looked at");
  return static_cast<std::size_t>(at);
}

Peak highest(const Model& model, const std::vector<double>& frequencies,
             const Amplitudes& amplitudes)
{
  constexpr int finer = 4;
  const double step = (frequencies[1] - frequencies[0]) / finer;
  const double centre = frequencies[largest(amplitudes(frequencies), model)];
  std::vector<double> fine;
  for (int k = -finer; k <= finer; ++k) fine.push_back(centre + k * step);
  const auto amplitude = amplitudes(fine);
  const std::size_t k = largest(amplitude, model);
  const Vertex top = vertex(amplitude[k - 1], amplitude[k], amplitude[k + 1]);
  return {fine[k] + top.at * step, top.height};
}

}  // namespace

Peak balance_peak(const Model& model, const std::vector<double>& frequencies)
{
  const Parameters& parameters = model.parameters;
  Balance balance(bearing_problem(parameters, model.samples), model.harmonics);
  const ColdStart start = [&](double omega) {
    return quasi_static_start(parameters, omega, model.harmonics);
  };
  return highest(model, frequencies, [&](const std::vector<double>& speeds) {
    std::vector<double> omegas, amplitude;
    for (double frequency : speeds) omegas.push_back(angular(frequency));
    std::vector<double> found;
    const auto points = sweep(
        balance, omegas, start, sweep_settings(parameters), [&](const SweepPoint& point) {
          found.push_back(half_peak_to_peak(
              body_series(parameters, balance, point.omega, point.x))[2]);
        });
    auto next = found.begin();
    for (const SweepPoint& point : points)
      amplitude.push_back(point.found() ? *next++ : 0);
    return amplitude;
  });
}

SteadyState steady_state_at(const Model& model, double frequency)
{
  return steady_state(model.parameters, angular(frequency),
                      static_start(model.parameters), model.time_integration);
}

namespace
{

Motion integrated_motion(const Model& model, double frequency)
{
  return motion_of(steady_state_at(model, frequency),
                   model.time_integration.stepper.intervals_per_period);
}

}  // namespace

Peak integrated_peak(const Model& model, const std::vector<double>& frequencies)
{
  return highest(model, frequencies, [&](const std::vector<double>& speeds) {
    std::vector<double> amplitude;
    for (double frequency : speeds)
      amplitude.push_back(orbit_size(integrated_motion(model, frequency)).x.value);
    return amplitude;
  });
}

namespace
{

bool loses_contact(const Model& model, double frequency)
{
  return contact_share(model.parameters, integrated_motion(model, frequency)) < 1;
}

/** The speed between one that keeps contact and one that loses it. The band has ragged
   ends, so another change may lie between the two: half their distance stays unknown. */
Measured onset(const Model& model, double keeps, double loses)
{
  const double uncertainty = 0.5 * std::abs(keeps - loses);
  for (int halving = 0; halving < 5; ++halving) {
    const double middle = 0.5 * (keeps + loses);
    (loses_contact(model, middle) ? loses : keeps) = middle;
  }
  return {0.5 * (keeps + loses), uncertainty};
}

}  // namespace

std::optional<ContactLoss> contact_loss(const Model& model,
                                        const std::vector<double>& frequencies)
{
  std::vector<std::size_t> losing;
  for (std::size_t k = 0; k < frequencies.size(); ++k)
    if (loses_contact(model, frequencies[k])) losing.push_back(k);
  if (losing.empty()) return {};
  const std::size_t first = losing.front(), last = losing.back();
  ContactLoss loss{{frequencies[first]}, {frequencies[last]}};
  if (first > 0) loss.first = onset(model, frequencies[first - 1], frequencies[first]);
  if (last + 1 < frequencies.size())
    loss.last = onset(model, frequencies[last + 1], frequencies[last]);
  return loss;
}

std::optional<OrbitSize> balance_orbit_size(const Model& model, double frequency)
{
  if (!has_rotation_period(model.parameters.bearing)) return {};
  const auto solution =
      find_periodic(model.parameters, angular(frequency), model.harmonics, model.samples);
  if (!solution.found()) return {};
  const Eigen::VectorXd amplitude = half_peak_to_peak(solution.bodies);
  return OrbitSize{{amplitude[2]}, {amplitude[3]}};
}

namespace
{

/** The largest value of the period from `begin` on, refined by a parabola where it is a
   crest. Beyond both ends of the motion stands the sample one period further in. */
double crest(const std::vector<double>& values, std::size_t begin, std::size_t period)
{
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto largest =
      std::max_element(first, first + static_cast<std::ptrdiff_t>(period));
  const auto at = static_cast<std::size_t>(largest - values.begin());
  const double before = values[at > 0 ? at - 1 : period - 1];
  const double after = values[at + 1 < values.size() ? at + 1 : at + 1 - period];
  const bool top = before <= values[at] && after <= values[at];
  return top ? vertex(before, values[at], after).height : values[at];
}

Measured mean_of_blocks(const std::vector<double>& values)
{
  const std::size_t blocks = std::min<std::size_t>(10, values.size());
  std::vector<double> means(blocks, 0);
  double mean = 0, squares = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t begin = block * values.size() / blocks,
                      end = (block + 1) * values.size() / blocks;
    for (std::size_t k = begin; k < end; ++k)
      means[block] += values[k] / static_cast<double>(end - begin);
    mean += means[block] / static_cast<double>(blocks);
  }
  for (double value : means) squares += (value - mean) * (value - mean);
  const auto count = static_cast<double>(blocks * std::max<std::size_t>(1, blocks - 1));
  return {mean, std::sqrt(squares / count)};
}

/** Mean half peak-to-peak of one displacement. */
Measured mean_size(const std::vector<double>& values, int points_per_period)
{
  std::vector<double> mirrored, sizes;
  for (double value : values) mirrored.push_back(-value);
  const auto period = static_cast<std::size_t>(points_per_period);
  for (std::size_t k = 0; k < values.size(); k += period)
    sizes.push_back(0.5 * (crest(values, k, period) + crest(mirrored, k, period)));
  return mean_of_blocks(sizes);
}

}  // namespace

OrbitSize orbit_size(const Motion& motion)
{
  std::vector<double> x, y;
  for (const Bodies& bodies : motion.positions) {
    x.push_back(bodies.rotor.x);
    y.push_back(bodies.rotor.y);
  }
  return {mean_size(x, motion.points_per_period), mean_size(y, motion.points_per_period)};
}

}  // namespace rotor_stator
