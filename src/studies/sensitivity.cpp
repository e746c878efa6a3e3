#include "studies/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "io/errors.hpp"
#include "io/number_table.hpp"

namespace rotor_stator::studies {

namespace {

double total_mass(const Parameters& machine)
{
  return machine.stator.mass + machine.rotor.mass;
}

double mass_ratio(const Parameters& machine)
{
  return machine.rotor.mass / machine.stator.mass;
}

void set_masses(Parameters& machine, double total, double ratio)
{
  machine.stator.mass = total / (1 + ratio);
  machine.rotor.mass = total - machine.stator.mass;
}

/** What is varied, in the order of `Unpublished`. */
struct Parameter {
  std::string key, name, unit;  ///< in the scene and in the table
  double (*value)(const Model& model);
  void (*set)(Model& model, double value);
};

const std::vector<Parameter> parameters{
    {"mass_kg", "mass", "kg", [](auto& model) { return total_mass(model.machine); },
     [](auto& m, double value) { set_masses(m.machine, value, mass_ratio(m.machine)); }},
    {"mass_ratio", "mass_ratio", "-",
     [](auto& model) { return mass_ratio(model.machine); },
     [](auto& m, double value) { set_masses(m.machine, total_mass(m.machine), value); }},
    {"cage_ratio", "cage_ratio", "-",
     [](auto& model) { return model.machine.bearing.cage_speed_ratio; },
     [](auto& model, double value) { model.machine.bearing.cage_speed_ratio = value; }},
    {"samples", "samples", "-", [](auto& model) -> double { return model.samples; },
     [](auto& model, double value) { model.samples = static_cast<int>(value); }},
    {"step_s", "step", "s",
     [](auto& model) { return model.time_integration.stepper.step; },
     [](auto& model, double value) { model.time_integration.stepper.step = value; }}};

const Parameter& label(Unpublished parameter)
{
  return parameters[static_cast<std::size_t>(parameter)];
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

/** Adds the points of one parameter; its values must rise and hold the default. */
void add_points(StrictToml& table, Unpublished parameter, SensitivityScene& scene)
{
  const std::string& key = label(parameter).key;
  const auto values = table.numbers(key, Range::positive);
  if (std::ranges::adjacent_find(values, std::greater_equal<>()) != values.end())
    table.fail(key, "must rise");
  const double standard = label(parameter).value(scene.usual);
  const auto usual = std::ranges::find_if(
      values, [&](double value) { return std::abs(value - standard) < 1e-9 * standard; });
  if (usual == values.end())
    table.fail(key, format("must hold the default, %.9g", standard));
  for (const double& value : values) {
    SensitivityPoint point{parameter, value, &value == &*usual};
    const bool first = parameter == Unpublished::mass;
    point.peak = !point.usual || first || parameter == Unpublished::cage_ratio;
    point.balance = point.usual ? first : enters(parameter, amp_x_aft);
    point.integration = point.usual ? first : enters(parameter, amp_x);
    scene.points.push_back(point);
  }
}

}  // namespace

bool peak_by_integration(Unpublished parameter)
{
  return parameter == Unpublished::cage_ratio || parameter == Unpublished::step;
}

SensitivityScene read_sensitivity_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  const int harmonics = toml.integer("harmonics", 1, 4096);
  SensitivityScene scene{.usual = {.machine = read_parameters(file, "parameters"),
                                   .harmonics = harmonics,
                                   .samples = default_samples(harmonics),
                                   .time_integration = read_steady_settings(file)},
                         .peak_speeds = file.speed_range("peak_hz"),
                         .time_peak_speeds = file.speed_range("time_peak_hz"),
                         .loss_speeds = file.speed_range("contact_loss_hz"),
                         .orbit_frequency = toml.number("orbit_hz", Range::positive),
                         .orbit_periods = toml.integer("orbit_periods", 1, 100000)};
  if (scene.usual.time_integration.stepper.method != "rk4")
    toml.fail("time_integration", "must have the method rk4, whose step is varied");
  StrictToml values = toml.table("values");
  for (std::size_t k = 0; k < parameters.size(); ++k)
    add_points(values, static_cast<Unpublished>(k), scene);
  for (double ratio : values.numbers("cage_ratio", Range::positive))
    if (ratio > 0.5) values.fail("cage_ratio", "must be in 0 < c <= 0.5");
  values.integers("samples", 2 * harmonics + 1, 1 << 20);
  toml.refuse_unknown_keys();
  return scene;
}

Model varied(Model usual, Unpublished parameter, double value)
{
  label(parameter).set(usual, value);
  return usual;
}

void fill_from_defaults(std::vector<SensitivityPoint>& points)
{
  for (SensitivityPoint& point : points)
    for (int output = 0; output < output_count; ++output) {
      if (point.computes(output)) continue;
      const auto from = std::find_if(points.begin(), points.end(), [&](const auto& p) {
        return p.usual && p.computes(output) &&
               (output > amp_peak ||
                peak_by_integration(p.parameter) == peak_by_integration(point.parameter));
      });
      point.outputs[output] = from->outputs[output];
      if (output != amp_x) continue;
      point.spread = from->spread;
      point.periodic = from->periodic;
    }
}

namespace {

const char* const parameter_meaning =
    "mass: m_s + m_r; mass_ratio: m_r/m_s at the default m_s + m_r; cage_ratio: "
    "omega_cage/omega; samples: N; step: longest h of rk4";

using Point = SensitivityPoint;
using Get = Cell (*)(const Point&);

template <Output output>
constexpr Get value = [](const Point& p) -> Cell {
  return p.outputs[output] ? p.outputs[output]->value : -1;
};
template <Output output>
constexpr Get error = [](const Point& p) -> Cell {
  return p.outputs[output] ? p.outputs[output]->error : 0;
};

const std::vector<Field<Point>> fields{
    {"parameter", "word", parameter_meaning,
     [](auto& p) { return label(p.parameter).name; }},
    {"value", "see unit", "of the parameter", &Point::value},
    {"unit", "word", "of the parameter", [](auto& p) { return label(p.parameter).unit; }},
    {"default", "-", "1 at the default", &Point::usual},
    {"f_peak", "Hz", "speed of the largest x_r", value<f_peak>},
    {"amp_peak", "m", "half peak-to-peak of x_r there", value<amp_peak>},
    {"f_loss_first", "Hz", "lowest speed with loss of contact; -1: none",
     value<f_loss_first>},
    {"f_loss_last", "Hz", "highest speed with loss of contact; -1: none",
     value<f_loss_last>},
    {"amp_x_13p4", "m", "half peak-to-peak of x_r, integrated, mean over the periods",
     value<amp_x>},
    {"amp_y_13p4", "m", "the same of y_r", value<amp_y>},
    {"amp_x_13p4_aft", "m", "half peak-to-peak of x_r, harmonic balance; -1: none",
     value<amp_x_aft>},
    {"amp_y_13p4_aft", "m", "the same of y_r; -1: none", value<amp_y_aft>},
    {"error_f_loss_first", "Hz",
     "half a step of the search: loss comes and goes near the ends", error<f_loss_first>},
    {"error_f_loss_last", "Hz", "the same", error<f_loss_last>},
    {"error_x_13p4", "m", "standard error of amp_x_13p4", error<amp_x>},
    {"error_y_13p4", "m", "standard error of amp_y_13p4", error<amp_y>},
    {"spread_13p4", "-", "Poincare spread over the largest displacement", &Point::spread},
    {"periodic_13p4", "-", "1 if the motion has the period of rotation",
     &Point::periodic},
    {"peak_by", "word", "aft: harmonic balance; rk4: time integration", [](auto& p) {
       return std::string(peak_by_integration(p.parameter) ? "rk4" : "aft");
     }}};

/** The columns of the outputs and, from `f_loss_first` to `amp_y`, of their errors stand in their order. */
constexpr int first_output = 4, first_error = 12;

void describe(Table& table, const SensitivityScene& scene)
{
  const Model& usual = scene.usual;
  const SteadySettings& integration = usual.time_integration;
  describe(table, usual.machine);
  table.note(format("  harmonic balance: m = %d, N = %d, relative tolerance %g",
                    usual.harmonics, usual.samples, NewtonSettings{}.tolerance));
  table.note(
      format("  time integration: rk4, h = %g s, %g s from rest, then %d periods "
             "(orbit: %d); a whole number of steps fits each of %d parts of a period",
             integration.stepper.step, integration.longest, integration.shown_periods,
             scene.orbit_periods, integration.stepper.intervals_per_period));
  table.note(format(
      "  peak: %g to %g Hz by harmonic balance, %g to %g Hz by rk4; loss of "
      "contact: %zu speeds from %g to %g Hz, then bisection; orbit: %g Hz",
      scene.peak_speeds.front(), scene.peak_speeds.back(), scene.time_peak_speeds.front(),
      scene.time_peak_speeds.back(), scene.loss_speeds.size(), scene.loss_speeds.front(),
      scene.loss_speeds.back(), scene.orbit_frequency));
}

/** The nearest point from `at` on in one direction, of the same parameter, that has the
   output; `at` itself when there is none. */
const Point& nearest(const std::vector<Point>& points, std::size_t at, int direction,
                     Output output)
{
  for (std::size_t k = at + direction; k < points.size(); k += direction) {
    if (points[k].parameter != points[at].parameter) break;
    if (points[k].outputs[output]) return points[k];
  }
  return points[at];
}

NormalisedDerivative difference(const Point& low, const Point& high, Output output)
{
  NormalisedDerivative derivative{low.parameter, output, low.value, high.value, {0}};
  if (!enters(low.parameter, output)) return derivative;
  const Measured &a = *low.outputs[output], &b = *high.outputs[output];
  const double span = std::log(high.value / low.value);
  derivative.slope.value = std::log(b.value / a.value) / span;
  derivative.slope.error = (a.error / a.value + b.error / b.value) / span;
  return derivative;
}

using Derivative = NormalisedDerivative;
const std::vector<Field<Derivative>> derivative_fields{
    {"parameter", "word", parameter_meaning,
     [](auto& d) { return label(d.parameter).name; }},
    {"output", "word", "a column of sensitivity.tsv",
     [](auto& d) { return fields[first_output + d.output].name; }},
    {"derivative", "-", "d ln(output)/d ln(parameter) at the default",
     [](auto& d) { return d.slope.value; }},
    {"uncertainty", "-",
     "from the errors of loss of contact and of the mean over periods",
     [](auto& d) { return d.slope.error; }},
    {"low", "see unit", "value of the parameter at one end of the difference",
     &Derivative::low},
    {"high", "see unit", "and at the other", &Derivative::high},
    {"unit", "word", "of the parameter",
     [](auto& d) { return label(d.parameter).unit; }}};

}  // namespace

Table sensitivity_table(const SensitivityScene& scene, const std::vector<Point>& points)
{
  Table table("Sensitivity to the parameters that the paper leaves out", fields);
  describe(table, scene);
  table.note(
      "modelled: one parameter at a time, the others at their defaults; N does not enter "
      "time integration, nor h harmonic balance: there the default's numbers stand");
  for (const Point& point : points) table.row(fields, point);
  return table;
}

/**
## Normalised derivatives

From the table of the sensitivity: nothing is computed again. */

std::vector<Point> read_sensitivity(const SensitivityScene& scene,
                                    const std::string& table)
{
  const NumberTable read(table);
  std::vector<Point> points = scene.points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (read.rows() != points.size() ||
        std::abs(read.at(k, "value") - points[k].value) > 1e-9 * points[k].value)
      throw BadInput(table + ": is not the table of this scene");
    for (int output = 0; output < output_count; ++output) {
      const double value = read.at(k, fields[first_output + output].name);
      if (value < 0) continue;
      const bool has_error = output >= f_loss_first && output <= amp_y;
      points[k].outputs[output] = Measured{
          value,
          has_error ? read.at(k, fields[first_error + output - f_loss_first].name) : 0};
    }
  }
  return points;
}

std::vector<Derivative> normalised_derivatives(const std::vector<Point>& points)
{
  std::vector<Derivative> derivatives;
  for (std::size_t at = 0; at < points.size(); ++at) {
    if (!points[at].usual) continue;
    for (int k = 0; k < output_count; ++k) {
      const auto output = static_cast<Output>(k);
      const Point& low = nearest(points, at, -1, output);
      const Point& high = nearest(points, at, +1, output);
      if (points[at].outputs[output] && &low != &high)
        derivatives.push_back(difference(low, high, output));
    }
  }
  return derivatives;
}

Table derivative_table(const SensitivityScene& scene,
                       const std::vector<Derivative>& derivatives)
{
  Table table("Normalised derivatives with respect to what the paper leaves out",
              derivative_fields);
  describe(table, scene);
  table.note(
      "modelled: the nearest values on both sides of the default, or the default and one "
      "side; 0 where the parameter does not enter the output");
  for (const Derivative& derivative : derivatives)
    table.row(derivative_fields, derivative);
  return table;
}

}  // namespace rotor_stator::studies
