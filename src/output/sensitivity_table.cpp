#include "output/sensitivity_table.hpp"

#include "model/errors.hpp"

namespace rotor_stator
{

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
  table.describe(usual.parameters);
  table.note(text("  harmonic balance: m = %d, N = %d, relative tolerance %g",
                  usual.harmonics, usual.samples, NewtonSettings{}.tolerance));
  table.note(
      text("  time integration: rk4, h = %g s, %g s from rest, then %d periods "
           "(orbit: %d); a whole number of steps fits each of %d parts of a period",
           usual.time_integration.stepper.step, usual.time_integration.longest,
           usual.time_integration.shown_periods, scene.orbit_periods,
           usual.time_integration.stepper.intervals_per_period));
  table.note(text(
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

}  // namespace rotor_stator
