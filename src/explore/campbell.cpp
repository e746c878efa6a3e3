#include "explore/campbell.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "io/errors.hpp"
#include "model/large_machine.hpp"

namespace rotor_stator::explore {

namespace {

struct Mode {
  double frequency, damping;  ///< [Hz], [-]
  int whirl;                  ///< 1 forward, -1 backward, 0 neither
};

const char* word(int whirl)
{
  return whirl > 0 ? "forward" : whirl < 0 ? "backward" : "planar";
}

/** The linear machine, without the coordinates of a stator that is held. */
class Linear {
public:
  Linear(const LargeBodies& machine, const Eigen::MatrixXd& stiffness, bool is_rigid)
      : first_(is_rigid ? 2 : 0), machine_(machine)
  {
    const auto n = machine.mass.rows() - first_;
    mass_.compute(machine.mass.bottomRightCorner(n, n));
    k_ = (machine.stiffness + machine.joints * stiffness * machine.joints.transpose())
             .bottomRightCorner(n, n);
  }

  /** The oscillating modes at a speed [Hz], frequencies ascending. */
  std::vector<Mode> modes(double speed) const
  {
    const auto n = k_.rows();
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    a.topRightCorner(n, n).setIdentity();
    a.bottomLeftCorner(n, n) = -mass_.solve(k_);
    a.bottomRightCorner(n, n) =
        -mass_.solve((machine_.damping + angular(speed) * machine_.gyroscopic)
                         .bottomRightCorner(n, n));
    const Eigen::EigenSolver<Eigen::MatrixXd> found(a);
    if (found.info() != Eigen::Success)
      throw NoSolution(format("the modes at %g Hz were not found", speed));
    std::vector<Mode> list;
    for (Eigen::Index k = 0; k < 2 * n; ++k)
      if (const auto lambda = found.eigenvalues()[k]; lambda.imag() > 1e-6)
        list.push_back({lambda.imag() / angular(1), -lambda.real() / std::abs(lambda),
                        whirl(found.eigenvectors().col(k))});
    std::ranges::sort(list, {}, &Mode::frequency);
    return list;
  }

private:
  /** By the sense in which the ellipses of all places that are shown turn, weighted by
      their areas. */
  int whirl(const Eigen::VectorXcd& shape) const
  {
    double turning = 0, whole = 0;
    for (int i = first_; i + 1 < machine_.shown; i += 2) {
      const auto x = shape[i - first_], y = shape[i + 1 - first_];
      turning += 2 * (x * std::conj(y)).imag();
      whole += std::norm(x) + std::norm(y);
    }
    constexpr double round = 0.02;  // a line, by the ratio of its axes
    return turning > round * whole ? 1 : turning < -round * whole ? -1 : 0;
  }

  int first_;
  const LargeBodies& machine_;
  Eigen::LDLT<Eigen::MatrixXd> mass_;
  Eigen::MatrixXd k_;
};

/** Frequency less that of the order at a speed: zero where it is critical. */
double beyond(const Linear& machine, double order, std::size_t mode, double speed)
{
  const auto modes = machine.modes(speed);
  return mode < modes.size() ? modes[mode].frequency - order * speed : 0;
}

/** Between two speeds of other sign, by bisection with secants. */
double critical_speed(const Linear& machine, double order, std::size_t mode, double low,
                      double high, double at_low, double at_high)
{
  for (int step = 0; step < 30 && high - low > 1e-9 * high; ++step) {
    double middle = step % 3 == 2 ? (low + high) / 2
                                  : low + (high - low) * at_low / (at_low - at_high);
    middle = std::clamp(middle, low + 1e-3 * (high - low), high - 1e-3 * (high - low));
    const double found = beyond(machine, order, mode, middle);
    const bool is_low = (found > 0) == (at_low > 0);
    (is_low ? low : high) = middle;
    (is_low ? at_low : at_high) = found;
  }
  return (low + high) / 2;
}

std::vector<Column> columns_of(bool critical)
{
  if (critical)
    return {{"f", "Hz", "critical speed of rotation"},
            {"line", "word", "what meets the mode: 1X, or the passing balls"},
            {"mode", "-", "by frequency at that speed, from 1"},
            {"frequency", "Hz", "of the mode there"},
            {"damping", "-", "ratio to critical damping"},
            {"whirl", "word", "forward, backward or planar"}};
  return {{"f", "Hz", "speed of rotation"},
          {"mode", "-", "by frequency at this speed, from 1"},
          {"frequency", "Hz", "of the damped mode"},
          {"damping", "-", "ratio to critical damping"},
          {"whirl", "-", "1 forward, -1 backward, 0 planar"}};
}

}  // namespace

std::vector<double> natural_frequencies(const Parameters& parameters, std::size_t most)
{
  const LargeBodies machine = matrices_of(parameters);
  const Linear linear(machine, mean_contact_stiffness(parameters, machine),
                      parameters.stator.rigid);
  std::vector<double> list;
  for (const Mode& mode : linear.modes(0))
    if (list.size() < most) list.push_back(mode.frequency);
  return list;
}

Exploration explore_campbell(const CampbellRequest& request)
{
  require_range(request.from, request.to);
  if (request.critical && request.plot)
    throw BadInput("--plot: draws frequencies; leave out --critical");
  const Parameters parameters =
      read_machine(StrictToml(request.parameter_file),
                   {.from = request.from, .to = request.to, .harmonics = 64});
  const LargeBodies machine = matrices_of(parameters);
  const Eigen::MatrixXd stiffness = mean_contact_stiffness(parameters, machine);
  const Linear linear(machine, stiffness, parameters.stator.rigid);
  const auto columns = columns_of(request.critical);
  Table table(request.critical ? "Critical speeds of the linear machine"
                               : "Whirl frequencies against speed (Campbell)",
              columns);
  table.choose(request.columns, columns.size(), request.plot.has_value());
  describe(table, parameters);
  for (Eigen::Index k = 0; k < stiffness.rows(); k += 2)
    table.row_line("bearing", {k / 2 + 1, stiffness(k, k), stiffness(k, k + 1),
                               stiffness(k + 1, k + 1)});
  table.note(
      "row bearing: mean contact stiffness xx, xy, yy [N/m], 0: no contact at rest");
  struct Order {
    double value;
    std::string name;
  };
  std::vector<Order> orders{{1, "1X"}};
  for (const Bearing& bearing : bearings_of(parameters))
    if (const double value = passages_per_turn(bearing);
        std::abs(value - orders.back().value) > 1e-9)
      orders.push_back(
          {value, orders.size() == 1 ? "BPFO" : "BPFO_" + std::to_string(orders.size())});
  for (const auto& [value, name] : orders) table.row_line("order", {name, value});
  const auto speeds = evenly_spaced(request.from, request.to, request.count);
  std::vector<std::vector<Mode>> modes;
  for (const double speed : speeds) {
    modes.push_back(linear.modes(speed));
    const std::size_t shown = std::min<std::size_t>(modes.back().size(), request.modes);
    for (std::size_t i = 0; i < shown && !request.critical; ++i) {
      const auto& [frequency, damping, whirl] = modes.back()[i];
      table.row({speed, i + 1, frequency, damping, whirl});
    }
  }
  for (const auto& [value, name] : orders)
    for (std::size_t k = 1; k < speeds.size(); ++k)
      for (std::size_t i = 0; i < std::min({modes[k - 1].size(), modes[k].size(),
                                            static_cast<std::size_t>(request.modes)});
           ++i) {
        const double a = modes[k - 1][i].frequency - value * speeds[k - 1],
                     b = modes[k][i].frequency - value * speeds[k];
        if ((a > 0) == (b > 0)) continue;
        const double at =
            critical_speed(linear, value, i, speeds[k - 1], speeds[k], a, b);
        const Mode mode = linear.modes(at)[i];
        if (request.critical)
          table.row({at, name, i + 1, mode.frequency, mode.damping, word(mode.whirl)});
        else
          table.row_line("critical_speed", {at, name, i + 1, word(mode.whirl)});
      }
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
