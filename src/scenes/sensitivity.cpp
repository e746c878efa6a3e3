#include "scenes/sensitivity.hpp"

#include <cmath>

#include "model/progress.hpp"

namespace rotor_stator
{

bool peak_by_integration(Unpublished parameter)
{
  return parameter == Unpublished::cage_ratio || parameter == Unpublished::step;
}

namespace
{

void add_peak(const SensitivityScene& scene, const Model& model, SensitivityPoint& point)
{
  const Peak peak = peak_by_integration(point.parameter)
                        ? integrated_peak(model, scene.time_peak_speeds)
                        : balance_peak(model, scene.peak_speeds);
  point.outputs[f_peak] = Measured{peak.frequency};
  point.outputs[amp_peak] = Measured{peak.amplitude};
}

void add_balance(const SensitivityScene& scene, const Model& model,
                 SensitivityPoint& point)
{
  const auto size = balance_orbit_size(model, scene.orbit_frequency);
  point.outputs[amp_x_aft] = size ? MaybeMeasured(size->x) : std::nullopt;
  point.outputs[amp_y_aft] = size ? MaybeMeasured(size->y) : std::nullopt;
}

void add_integration(const SensitivityScene& scene, Model model, SensitivityPoint& point)
{
  const auto loss = contact_loss(model, scene.loss_speeds);
  point.outputs[f_loss_first] = loss ? MaybeMeasured(loss->first) : std::nullopt;
  point.outputs[f_loss_last] = loss ? MaybeMeasured(loss->last) : std::nullopt;
  model.time_integration.shown_periods = scene.orbit_periods;
  const SteadyState steady = steady_state_at(model, scene.orbit_frequency);
  const OrbitSize size =
      orbit_size(motion_of(steady, model.time_integration.stepper.intervals_per_period));
  point.outputs[amp_x] = size.x;
  point.outputs[amp_y] = size.y;
  point.spread = steady.spread;
  point.periodic = steady.periodic;
}

}  // namespace

std::vector<SensitivityPoint> compute_sensitivity(const SensitivityScene& scene)
{
  SensitivityPoint usual{};
  add_balance(scene, scene.usual, usual);
  add_integration(scene, scene.usual, usual);
  std::size_t total = 0;
  for (const Variation& variation : scene.variations) total += variation.values.size();
  Progress progress("sensitivity", total);
  std::vector<SensitivityPoint> points;
  for (const Variation& variation : scene.variations)
    for (std::size_t k = 0; k < variation.values.size(); ++k) {
      SensitivityPoint point = usual;
      point.parameter = variation.parameter;
      point.value = variation.values[k];
      point.usual = k == variation.usual;
      const Model model = varied(scene.usual, point.parameter, point.value);
      add_peak(scene, model, point);
      const bool balance = !point.usual && point.parameter != Unpublished::step;
      const bool integration = !point.usual && point.parameter != Unpublished::samples;
      if (balance) add_balance(scene, model, point);
      if (integration) add_integration(scene, model, point);
      points.push_back(point);
      progress.step();
    }
  return points;
}

namespace
{

using Points = std::vector<SensitivityPoint>;

/** The nearest point from `at` on in one direction, of the same parameter, that has the
   output; `at` itself when there is none. */
const SensitivityPoint& nearest(const Points& points, std::size_t at, int direction,
                                Output output)
{
  for (std::size_t k = at + direction; k < points.size(); k += direction) {
    if (points[k].parameter != points[at].parameter) break;
    if (points[k].outputs[output]) return points[k];
  }
  return points[at];
}

/** Whether an output is computed anew for each value of a parameter. */
bool enters(Unpublished parameter, Output output)
{
  const bool by_balance = output == amp_x_aft || output == amp_y_aft;
  const bool peak = output == f_peak || output == amp_peak;
  if (parameter == Unpublished::samples) return by_balance || peak;
  if (parameter == Unpublished::step) return !by_balance;
  return true;
}

NormalisedDerivative difference(const SensitivityPoint& low, const SensitivityPoint& high,
                                Output output)
{
  if (!enters(low.parameter, output))
    return {low.parameter, output, low.value, high.value, {0}};
  const Measured &a = *low.outputs[output], &b = *high.outputs[output];
  const double span = std::log(high.value / low.value);
  const double uncertainty = a.uncertainty / a.value + b.uncertainty / b.value;
  return {low.parameter,
          output,
          low.value,
          high.value,
          {std::log(b.value / a.value) / span, uncertainty / span}};
}

}  // namespace

std::vector<NormalisedDerivative> normalised_derivatives(const Points& points)
{
  std::vector<NormalisedDerivative> derivatives;
  for (std::size_t at = 0; at < points.size(); ++at) {
    if (!points[at].usual) continue;
    for (int k = 0; k < output_count; ++k) {
      const auto output = static_cast<Output>(k);
      const SensitivityPoint& low = nearest(points, at, -1, output);
      const SensitivityPoint& high = nearest(points, at, +1, output);
      if (points[at].outputs[output] && &low != &high)
        derivatives.push_back(difference(low, high, output));
    }
  }
  return derivatives;
}

}  // namespace rotor_stator
