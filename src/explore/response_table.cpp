#include "explore/response_table.hpp"

#include <algorithm>
#include <cmath>

#include "motion/contact.hpp"

namespace rotor_stator::explore {

namespace {

/** Component k of a value in each direction. */
template <Displacements ResponseRow::*what, int k>
constexpr auto part = [](const ResponseRow& r) -> Cell { return (r.*what)[k]; };
using Row = ResponseRow;

const ResponseFields usual_fields{
    {"f", "Hz", "speed of rotation", &Row::frequency},
    {"amp_x_s", "m", "half peak-to-peak of x_s", part<&Row::amplitude, 0>},
    {"amp_y_s", "m", "half peak-to-peak of y_s", part<&Row::amplitude, 1>},
    {"amp_x_r", "m", "half peak-to-peak of x_r", part<&Row::amplitude, 2>},
    {"amp_y_r", "m", "half peak-to-peak of y_r", part<&Row::amplitude, 3>}};

const ResponseFields means{{"mean_x_s", "m", "mean of x_s", part<&Row::mean, 0>},
                           {"mean_y_s", "m", "mean of y_s", part<&Row::mean, 1>},
                           {"mean_x_r", "m", "mean of x_r", part<&Row::mean, 2>},
                           {"mean_y_r", "m", "mean of y_r", part<&Row::mean, 3>}};

const ResponseFields rms{
    {"rms_x_s", "m", "rms of x_s about the mean", part<&Row::rms, 0>},
    {"rms_y_s", "m", "rms of y_s about the mean", part<&Row::rms, 1>},
    {"rms_x_r", "m", "rms of x_r about the mean", part<&Row::rms, 2>},
    {"rms_y_r", "m", "rms of y_r about the mean", part<&Row::rms, 3>}};

const ResponseFields contact_fields{
    {"amp_F_x", "N", "half peak-to-peak of F_x", [](auto& r) { return r.force.x; }},
    {"amp_F_y", "N", "half peak-to-peak of F_y", [](auto& r) { return r.force.y; }},
    {"contact_share", "-", "share of the time with a loaded ball", &Row::contact_share},
    {"ball_load", "N", "largest force of a ball", &Row::ball_load}};

}  // namespace

void observe(ResponseRow& row, const Parameters& parameters, const motion::Motion& motion)
{
  const auto samples = motion::displacement_samples(motion);
  for (Eigen::Index i = 0; i < 4; ++i)
    row.mean[static_cast<std::size_t>(i)] = samples.col(i).mean();
  const auto forces = motion::bearing_forces(parameters, motion);
  const auto half_range = [&](double Vec2::*axis) {
    const auto [low, high] = std::ranges::minmax_element(forces, {}, axis);
    return 0.5 * ((*high).*axis - (*low).*axis);
  };
  row.force = {half_range(&Vec2::x), half_range(&Vec2::y)};
  row.contact_share = motion::contact_share(parameters, motion);
  row.ball_load = motion::largest_ball_load(
      parameters, motion, std::ssize(motion.positions) / motion.points_per_period);
}

ResponseColumns columns_of(const Parameters& parameters, const ResponseFields& own,
                           bool is_settled)
{
  ResponseFields all = usual_fields;
  const auto add = [&](const ResponseFields& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  add(own);
  const std::size_t usual = all.size();
  if (is_settled)
    add({{"lyapunov", "1/s", "growth rate of neighbouring motions", &Row::lyapunov}});
  add(means);
  if (is_settled) add(rms);
  add(contact_fields);
  if (const double pressure = parameters.bearing.pressure; pressure > 0)
    all.push_back({"stress", "N/mm^2", "largest pressure of Hertz under ball_load",
                   [=](auto& r) { return 1e-6 * pressure * std::cbrt(r.ball_load); }});
  return {all, usual};
}

}  // namespace rotor_stator::explore
