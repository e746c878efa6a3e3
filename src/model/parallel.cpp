#include "model/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace rotor_stator {

namespace {

constexpr const char *stiffness_key = "stiffness_N_per_m",
                     *damping_key = "damping_N_s_per_m",
                     *coefficients_key = "coefficients";

std::array<double, 4> read_four(StrictToml& table, const char* key)
{
  std::array<double, 4> four{};
  if (!table.has(key)) return four;
  std::ranges::copy(table.numbers(key, Range::any, "[xx, xy, yx, yy]"), four.begin());
  return four;
}

std::vector<Coefficients> read_coefficients(StrictToml& table)
{
  for (const char* key : {stiffness_key, damping_key})
    if (table.has(key)) table.fail(key, "not together with coefficients");
  const auto file =
      std::filesystem::path(table.file()).parent_path() / table.string(coefficients_key);
  if (std::error_code error; !std::filesystem::exists(file, error))
    table.fail(coefficients_key, "names no file: " + file.string());
  const NumberTable by_speed(file.string());
  constexpr const char* names[] = {"k_xx", "k_xy", "k_yx", "k_yy",
                                   "c_xx", "c_xy", "c_yx", "c_yy"};
  for (const std::string& name : by_speed.names())
    if (name != "f" && std::ranges::find(names, name) == std::end(names))
      by_speed.fail("column " + name + ": must be f, k_xx ... k_yy or c_xx ... c_yy");
  std::vector<Coefficients> list;
  for (std::size_t row = 0; row < by_speed.rows(); ++row) {
    Coefficients at{.speed = angular(by_speed.at(row, "f"))};
    if (at.speed < 0 || (row > 0 && at.speed <= list.back().speed))
      by_speed.fail(row, "f must not be negative, and rise from row to row");
    for (std::size_t k = 0; k < 8; ++k)
      if (std::ranges::find(by_speed.names(), names[k]) != by_speed.names().end())
        (k < 4 ? at.stiffness : at.damping)[k % 4] = by_speed.at(row, names[k]);
    list.push_back(at);
  }
  return list;
}

double largest_of(const ParallelElements& elements,
                  std::array<double, 4> Coefficients::*what)
{
  double most = 0;
  for (const Coefficients& at : elements.linear)
    for (const double value : at.*what) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

ParallelElements read_parallel(StrictToml table)
{
  constexpr const char *cubic_key = "cubic_stiffness_N_per_m3",
                       *stop_key = "stop_stiffness_N_per_m", *gap_key = "stop_gap_m";
  ParallelElements elements;
  elements.cubic = table.number_or(cubic_key, Range::not_negative, 0);
  if (table.has(stop_key) || table.has(gap_key)) {
    elements.stop_stiffness = table.number(stop_key, Range::not_negative);
    elements.stop_gap = table.number(gap_key, Range::not_negative);
  }
  if (table.has(coefficients_key))
    elements.linear = read_coefficients(table);
  else if (table.has(stiffness_key) || table.has(damping_key))
    elements.linear = {{.speed = 0,
                        .stiffness = read_four(table, stiffness_key),
                        .damping = read_four(table, damping_key)}};
  return elements;
}

void describe_parallel(Table& table, const std::string& name,
                       const ParallelElements& elements)
{
  if (elements.cubic > 0)
    table.detail(name + format(": k_3 = %.15g N/m^3", elements.cubic));
  if (elements.stop_stiffness > 0)
    table.detail(name + format(": stop of %.15g N/m after %.15g m",
                               elements.stop_stiffness, elements.stop_gap));
  if (elements.linear.empty()) return;
  const Coefficients &first = elements.linear.front(), &last = elements.linear.back();
  if (elements.linear.size() > 1)
    return table.detail(
        name + format(": K and C by %zu speeds from %.9g to %.9g Hz, constant beyond",
                      elements.linear.size(), first.speed / angular(1),
                      last.speed / angular(1)));
  const auto four = [](const std::array<double, 4>& k) {
    return format("(%.9g, %.9g, %.9g, %.9g)", k[0], k[1], k[2], k[3]);
  };
  table.detail(name + ": K = " + four(first.stiffness) +
               " N/m, C = " + four(first.damping) + " N s/m, xx xy yx yy");
}

double largest_stiffness(const ParallelElements& elements, double load, double length)
{
  double cubic = 0;
  if (elements.cubic > 0) {
    /** Where it alone carries the load. */
    const double moved = std::min(length, std::cbrt(load / elements.cubic));
    cubic = 3 * elements.cubic * moved * moved;
  }
  return cubic + elements.stop_stiffness + largest_of(elements, &Coefficients::stiffness);
}

double largest_damping(const ParallelElements& elements)
{
  return largest_of(elements, &Coefficients::damping);
}

Parallel::Parallel(const ParallelElements& elements, double rotor_speed)
    : cubic_(elements.cubic), stop_stiffness_(elements.stop_stiffness),
      stop_gap_(elements.stop_gap), rotor_speed_(rotor_speed)
{
  const std::vector<Coefficients>& rows = elements.linear;
  if (rows.empty()) return;
  const auto after =
      std::ranges::upper_bound(rows, rotor_speed, {}, &Coefficients::speed);
  now_ = after == rows.begin() ? rows.front() : rows.back();
  if (after == rows.begin() || after == rows.end()) return;
  now_ = *(after - 1);
  const double range = after->speed - now_.speed, further = rotor_speed - now_.speed;
  for (const auto what : {&Coefficients::stiffness, &Coefficients::damping})
    for (std::size_t k = 0; k < 4; ++k) {
      (slope_.*what)[k] = (((*after).*what)[k] - (now_.*what)[k]) / range;
      (now_.*what)[k] += further * (slope_.*what)[k];
    }
}

void Parallel::add(Vec2 u, Vec2 rate, double omega, BearingReaction& sum) const
{
  const double square = u.x * u.x + u.y * u.y, distance = std::sqrt(square);
  /** Of a central force f(r), r = |u|: f/r and (f/r)'/r. */
  double central = cubic_ * square, steeper = 2 * cubic_;
  if (stop_gap_ == 0) {
    central += stop_stiffness_;
  } else if (distance > stop_gap_) {
    central += stop_stiffness_ * (1 - stop_gap_ / distance);
    steeper += stop_stiffness_ * stop_gap_ / (distance * square);
  }
  const auto& [speed, k, c] = now_;
  const auto& [unused, k_slope, c_slope] = slope_;
  const auto product = [](const std::array<double, 4>& a, Vec2 v) -> Vec2 {
    return {a[0] * v.x + a[1] * v.y, a[2] * v.x + a[3] * v.y};
  };
  const Vec2 by_u = product(k, u), by_rate = product(c, rate);
  sum.force.x += central * u.x + by_u.x + by_rate.x;
  sum.force.y += central * u.y + by_u.y + by_rate.y;
  sum.stiffness.xx += central + steeper * u.x * u.x + k[0];
  sum.stiffness.xy += steeper * u.x * u.y + k[1];
  sum.stiffness.yx += steeper * u.x * u.y + k[2];
  sum.stiffness.yy += central + steeper * u.y * u.y + k[3];
  sum.damping.xx += c[0];
  sum.damping.xy += c[1];
  sum.damping.yx += c[2];
  sum.damping.yy += c[3];
  if (!(omega > 0)) return;
  const Vec2 turning = product(k_slope, u), moving = product(c_slope, rate);
  const double ratio = rotor_speed_ / omega;
  sum.speed_slope.x += ratio * (turning.x + moving.x) + by_rate.x / omega;
  sum.speed_slope.y += ratio * (turning.y + moving.y) + by_rate.y / omega;
}

}  // namespace rotor_stator
