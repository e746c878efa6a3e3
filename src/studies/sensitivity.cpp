#include "studies/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::studies
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
  FourierTransform transform = amplitude_transform(model.harmonics);
  return highest(model, frequencies, [&](const std::vector<double>& speeds) {
    std::vector<double> amplitude;
    for (const PeriodicMotion& motion :
         sweep(parameters, angular(speeds), model.harmonics, model.samples))
      amplitude.push_back(motion.found() ? half_peak_to_peak(motion.bodies, transform)[2]
                                         : 0);
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

motion::Motion integrated_motion(const Model& model, double frequency)
{
  return motion::motion_of(steady_state_at(model, frequency),
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
  return motion::contact_share(model.parameters, integrated_motion(model, frequency)) < 1;
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
  const auto solution = motion::search_periodic(model.parameters, angular(frequency),
                                                model.harmonics, model.samples);
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

OrbitSize orbit_size(const motion::Motion& motion)
{
  std::vector<double> x, y;
  for (const Bodies& bodies : motion.positions) {
    x.push_back(bodies.rotor.x);
    y.push_back(bodies.rotor.y);
  }
  return {mean_size(x, motion.points_per_period), mean_size(y, motion.points_per_period)};
}

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
  const OrbitSize size = orbit_size(
      motion::motion_of(steady, model.time_integration.stepper.intervals_per_period));
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

/**
## Sensitivity: the scene file

What data/scenes/sensitivity.toml may say. */

namespace
{

double total_mass(const Parameters& parameters)
{
  return parameters.stator.mass + parameters.rotor.mass;
}

double mass_ratio(const Parameters& parameters)
{
  return parameters.rotor.mass / parameters.stator.mass;
}

void set_masses(Parameters& parameters, double total, double ratio)
{
  parameters.stator.mass = total / (1 + ratio);
  parameters.rotor.mass = total - parameters.stator.mass;
}

double value_of(const Model& model, Unpublished parameter)
{
  switch (parameter) {
    case Unpublished::mass:
      return total_mass(model.parameters);
    case Unpublished::mass_ratio:
      return mass_ratio(model.parameters);
    case Unpublished::cage_ratio:
      return model.parameters.bearing.cage_speed_ratio;
    case Unpublished::samples:
      return model.samples;
    case Unpublished::step:
      return model.time_integration.stepper.step;
  }
  throw NoSolution("unknown parameter");
}

/** The values of one parameter; they must rise and hold the default. */
Variation read_variation(StrictToml& table, const std::string& key, const Model& usual,
                         Unpublished parameter)
{
  Variation variation{parameter, table.numbers(key, Range::positive), 0};
  const std::vector<double>& values = variation.values;
  if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) !=
      values.end())
    table.fail(key, "must rise");
  const double standard = value_of(usual, parameter);
  const auto found = std::find_if(values.begin(), values.end(), [&](double value) {
    return std::abs(value - standard) < 1e-9 * standard;
  });
  if (found == values.end())
    table.fail(key, format("must hold the default, %.9g", standard));
  variation.usual = static_cast<std::size_t>(found - values.begin());
  return variation;
}

std::vector<Variation> read_variations(StrictToml table, const Model& usual)
{
  std::vector<Variation> variations{
      read_variation(table, "mass_kg", usual, Unpublished::mass),
      read_variation(table, "mass_ratio", usual, Unpublished::mass_ratio),
      read_variation(table, "cage_ratio", usual, Unpublished::cage_ratio),
      read_variation(table, "samples", usual, Unpublished::samples),
      read_variation(table, "step_s", usual, Unpublished::step)};
  if (variations[2].values.back() > 0.5)
    table.fail("cage_ratio", "must be in 0 < c <= 0.5");
  table.integers("samples", 2 * usual.harmonics + 1, 1 << 20);
  table.refuse_unknown_keys();
  return variations;
}

}  // namespace

SensitivityScene read_sensitivity_scene(const std::string& file,
                                        const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  const int harmonics = toml.integer("harmonics", 1, 4096);
  SensitivityScene scene{
      .usual = {.parameters = read_parameters(scene_file, "parameters"),
                .harmonics = harmonics,
                .samples = default_samples(harmonics),
                .time_integration = read_steady_settings(scene_file)},
      .variations = {},
      .peak_speeds = scene_file.speed_range("peak_hz"),
      .time_peak_speeds = scene_file.speed_range("time_peak_hz"),
      .loss_speeds = scene_file.speed_range("contact_loss_hz"),
      .orbit_frequency = toml.number("orbit_hz", Range::positive),
      .orbit_periods = toml.integer("orbit_periods", 1, 100000)};
  if (scene.usual.time_integration.stepper.method != "rk4")
    toml.fail("time_integration", "must have the method rk4, whose step is varied");
  scene.variations = read_variations(toml.table("values"), scene.usual);
  toml.refuse_unknown_keys();
  return scene;
}

SensitivityScene near_defaults(SensitivityScene scene)
{
  for (Variation& variation : scene.variations) {
    Variation near{variation.parameter, {}, 0};
    for (std::size_t k = 0; k < variation.values.size(); ++k) {
      const double value = variation.values[k];
      const bool neighbour = k + 1 >= variation.usual && k <= variation.usual + 1;
      const bool whole =
          variation.parameter == Unpublished::cage_ratio &&
          has_rotation_period(
              varied(scene.usual, Unpublished::cage_ratio, value).parameters.bearing);
      if (k == variation.usual) near.usual = near.values.size();
      if (neighbour || whole) near.values.push_back(value);
    }
    variation = near;
  }
  return scene;
}

Model varied(Model usual, Unpublished parameter, double value)
{
  Parameters& parameters = usual.parameters;
  switch (parameter) {
    case Unpublished::mass:
      set_masses(parameters, value, mass_ratio(parameters));
      break;
    case Unpublished::mass_ratio:
      set_masses(parameters, total_mass(parameters), value);
      break;
    case Unpublished::cage_ratio:
      parameters.bearing.cage_speed_ratio = value;
      break;
    case Unpublished::samples:
      usual.samples = static_cast<int>(value);
      break;
    case Unpublished::step:
      usual.time_integration.stepper.step = value;
      break;
  }
  return usual;
}

namespace
{

struct Label {
  std::string name, unit;
};

Label label(Unpublished parameter)
{
  switch (parameter) {
    case Unpublished::mass:
      return {"mass", "kg"};
    case Unpublished::mass_ratio:
      return {"mass_ratio", "-"};
    case Unpublished::cage_ratio:
      return {"cage_ratio", "-"};
    case Unpublished::samples:
      return {"samples", "-"};
    case Unpublished::step:
      return {"step", "s"};
  }
  throw NoSolution("unknown parameter");
}

const std::string parameter_meaning =
    "mass: m_s + m_r; mass_ratio: m_r/m_s at the default m_s + m_r; cage_ratio: "
    "omega_cage/omega; samples: N; step: longest h of rk4";

const std::vector<Column> output_columns{
    {"f_peak", "Hz", "speed of the largest x_r"},
    {"amp_peak", "m", "half peak-to-peak of x_r there"},
    {"f_loss_first", "Hz", "lowest speed with loss of contact; -1: none"},
    {"f_loss_last", "Hz", "highest speed with loss of contact; -1: none"},
    {"amp_x_13p4", "m", "half peak-to-peak of x_r, integrated, mean over the periods"},
    {"amp_y_13p4", "m", "the same of y_r"},
    {"amp_x_13p4_aft", "m", "half peak-to-peak of x_r, harmonic balance; -1: none"},
    {"amp_y_13p4_aft", "m", "the same of y_r; -1: none"}};

std::vector<Column> columns()
{
  std::vector<Column> all{{"parameter", "word", parameter_meaning},
                          {"value", "see unit", "of the parameter"},
                          {"unit", "word", "of the parameter"},
                          {"default", "-", "1 at the default"}};
  all.insert(all.end(), output_columns.begin(), output_columns.end());
  all.push_back({"error_f_loss_first", "Hz",
                 "half a step of the search: loss comes and goes near the ends"});
  all.push_back({"error_f_loss_last", "Hz", "the same"});
  all.push_back({"error_x_13p4", "m", "standard error of amp_x_13p4"});
  all.push_back({"error_y_13p4", "m", "standard error of amp_y_13p4"});
  all.push_back({"spread_13p4", "-", "Poincare spread over the largest displacement"});
  all.push_back({"periodic_13p4", "-", "1 if the motion has the period of rotation"});
  all.push_back({"peak_by", "word", "aft: harmonic balance; rk4: time integration"});
  return all;
}

void describe(Table& table, const SensitivityScene& scene)
{
  const Model& usual = scene.usual;
  describe(table, usual.parameters);
  table.note(format("  harmonic balance: m = %d, N = %d, relative tolerance %g",
                    usual.harmonics, usual.samples, NewtonSettings{}.tolerance));
  table.note(
      format("  time integration: rk4, h = %g s, %g s from rest, then %d periods "
             "(orbit: %d); a whole number of steps fits each of %d parts of a period",
             usual.time_integration.stepper.step, usual.time_integration.longest,
             usual.time_integration.shown_periods, scene.orbit_periods,
             usual.time_integration.stepper.intervals_per_period));
  table.note(format(
      "  peak: %g to %g Hz by harmonic balance, %g to %g Hz by rk4; loss of "
      "contact: %zu speeds from %g to %g Hz, then bisection; orbit: %g Hz",
      scene.peak_speeds.front(), scene.peak_speeds.back(), scene.time_peak_speeds.front(),
      scene.time_peak_speeds.back(), scene.loss_speeds.size(), scene.loss_speeds.front(),
      scene.loss_speeds.back(), scene.orbit_frequency));
}

}  // namespace

Table sensitivity_table(const SensitivityScene& scene)
{
  Table table("Sensitivity to the parameters that the paper leaves out", columns());
  describe(table, scene);
  table.note(
      "modelled: one parameter at a time, the others at their defaults; N does not enter "
      "time integration, nor h harmonic balance: there the default's numbers stand");
  for (const SensitivityPoint& point : compute_sensitivity(scene)) {
    const Label parameter = label(point.parameter);
    std::vector<Cell> row{parameter.name, point.value, parameter.unit, point.usual};
    for (const MaybeMeasured& output : point.outputs)
      row.emplace_back(output ? output->value : -1);
    for (Output output : {f_loss_first, f_loss_last, amp_x, amp_y})
      row.emplace_back(point.outputs[output] ? point.outputs[output]->uncertainty : 0);
    row.emplace_back(point.spread);
    row.emplace_back(point.periodic);
    row.emplace_back(std::string(peak_by_integration(point.parameter) ? "rk4" : "aft"));
    table.row(row);
  }
  return table;
}

Table sensitivity_derivative_table(const SensitivityScene& scene)
{
  Table table("Normalised derivatives with respect to what the paper leaves out",
              {{"parameter", "word", parameter_meaning},
               {"output", "word", "a column of sensitivity.tsv"},
               {"derivative", "-", "d ln(output)/d ln(parameter) at the default"},
               {"uncertainty", "-",
                "from the errors of loss of contact and of the mean over periods"},
               {"low", "see unit", "value of the parameter at one end of the difference"},
               {"high", "see unit", "and at the other"},
               {"unit", "word", "of the parameter"}});
  describe(table, scene);
  table.note(
      "modelled: the nearest values on both sides of the default, or the default and one "
      "side; 0 where the parameter does not enter the output");
  for (const auto& d : normalised_derivatives(compute_sensitivity(scene))) {
    const Label parameter = label(d.parameter);
    table.row({parameter.name, output_columns[d.output].name, d.slope.value,
               d.slope.uncertainty, d.low, d.high, parameter.unit});
  }
  return table;
}

}  // namespace rotor_stator::studies
