#include "explore/shape.hpp"

#include <algorithm>

#include "io/errors.hpp"
#include "io/table.hpp"
#include "model/large_machine.hpp"

namespace rotor_stator::explore {

namespace {

const std::vector<Column> columns{
    {"node", "-", "of the table of nodes, or its row from 1"},
    {"z", "m", "along the shaft"},
    phase_column,
    {"x", "m", "rotor, at the node"},
    {"y", "m", "rotor, at the node"},
    time_column};

}  // namespace

Exploration explore_shape(const ShapeRequest& request)
{
  const NumberTable nodes(request.nodes);
  const bool is_numbered =
      std::ranges::find(nodes.names(), "node") != nodes.names().end();
  const auto number = [&](std::size_t i) {
    return is_numbered ? nodes.at(i, "node") : static_cast<double>(i + 1);
  };
  const auto instants_of = [&](int periods) {
    const auto instants = static_cast<std::size_t>(periods) * request.points;
    if (instants > most_rows / nodes.rows())
      throw BadInput(
          format("--nodes %s: %zu nodes at %zu instants give more than %d rows: "
                 "--points is too large",
                 request.nodes.c_str(), nodes.rows(), instants, most_rows));
    return instants;
  };
  instants_of(std::max(request.periods, request.subharmonic));
  for (std::size_t i = 0; i < nodes.rows(); ++i) nodes.at(i, "z");
  const Parameters parameters =
      machine_of(request, request.frequency, request.frequency, {.nodes = &nodes});
  const LargeBodies* machine = parameters.bodies->matrices();
  if (!machine || machine->nodes.rows() == 0)
    throw BadInput(request.parameter_file +
                   ": rotor.matrices is missing: shape is that of a rotor given by them");
  Table table(request.periods == 1
                  ? "Orbits of a rotor's nodes over one period"
                  : format("Orbits of a rotor's nodes over %d periods", request.periods),
              columns);
  table.choose(request.columns, columns.size() - 1, request.plot.has_value());
  const FoundMotion at = computed(parameters, request, table);
  table.note("nodes: " + request.nodes);
  for (const auto& [bearing, i] : machine->bearing_nodes)
    table.row_line("bearing", {bearing + 1, number(i), nodes.at(i, "z")});
  const motion::Motion& motion = at.motion;
  const std::size_t instants = instants_of(std::max(request.periods, at.closes_after));
  Eigen::MatrixXd places(machine->nodes.rows(), instants);
  Eigen::VectorXd q(machine->nodes.cols());
  for (std::size_t k = 0; k < instants; ++k) {
    for (int i = 0; i < q.size(); ++i)
      q[i] = motion::shown_at(motion, k % motion.size(), i);
    places.col(k) = machine->nodes * q;
  }
  for (std::size_t i = 0; i < nodes.rows(); ++i)
    for (std::size_t k = 0; k < instants; ++k) {
      const double periods = at.base_periods * motion.t_over_period(k);
      const auto place = places.col(k).segment<2>(2 * i);
      table.row({number(i), nodes.at(i, "z"), angular(periods), place[0], place[1],
                 periods / at.base_frequency});
    }
  conclude(table, parameters, at.touches(), at.budget);
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
