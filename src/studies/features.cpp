#include "studies/features.hpp"

#include <algorithm>
#include <functional>

#include "io/errors.hpp"
#include "motion/contact.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::studies {

SteadyState settled(Model model, double frequency, int shown_periods)
{
  if (shown_periods > 0) model.time_integration.shown_periods = shown_periods;
  return steady_state(model.machine, angular(frequency), model.time_integration);
}

motion::Motion motion_of(const Model& model, const SteadyState& steady)
{
  return motion::motion_of(steady, model.time_integration.stepper.intervals_per_period);
}

namespace {

/** The response curve x_r at speeds [Hz]: amplitude 0 where there is no solution. */
using Response = std::function<std::vector<CurvePoint>(const std::vector<double>&)>;

CurvePoint highest(const Model& model, std::vector<double> frequencies,
                   const Response& response)
{
  constexpr int finer = 4;
  const auto inner_top = [&](const std::vector<CurvePoint>& curve) {
    const auto top = std::ranges::max_element(curve, {}, &CurvePoint::amplitude);
    if (top == curve.begin() || top + 1 == curve.end())
      throw NoSolution(model.machine.file +
                       ": the largest amplitude is at an end of the speeds looked at");
    return top->frequency;
  };
  const double step = (frequencies[1] - frequencies[0]) / finer;
  const double centre = inner_top(response(frequencies));
  frequencies.clear();
  for (int k = -finer; k <= finer; ++k) frequencies.push_back(centre + k * step);
  const std::vector<CurvePoint> curve = response(frequencies);
  inner_top(curve);
  return refined_peak(curve);
}

bool loses_contact(const Model& model, double frequency)
{
  return motion::contact_share(model.machine,
                               motion_of(model, settled(model, frequency))) < 1;
}

/** The first of the speeds that loses contact, refined between it and the one before. The band has
   ragged ends, so another change may lie between the two: half their distance stays unknown. */
std::optional<Measured> onset(const Model& model, const std::vector<double>& frequencies)
{
  const auto first = std::ranges::find_if(
      frequencies, [&](double frequency) { return loses_contact(model, frequency); });
  if (first == frequencies.end()) return {};
  if (first == frequencies.begin()) return Measured{*first};
  double loses = *first, keeps = *(first - 1);
  const double uncertainty = 0.5 * std::abs(keeps - loses);
  for (int halving = 0; halving < 5; ++halving) {
    const double middle = 0.5 * (keeps + loses);
    (loses_contact(model, middle) ? loses : keeps) = middle;
  }
  return Measured{0.5 * (keeps + loses), uncertainty};
}

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
  if (before > *largest || after > *largest) return *largest;
  return refined_peak({{-1, before}, {0, *largest}, {1, after}}).amplitude;
}

}  // namespace

CurvePoint balance_peak(const Model& model, const std::vector<double>& frequencies)
{
  FourierTransform transform = amplitude_transform(model.harmonics);
  return highest(model, frequencies, [&](const std::vector<double>& speeds) {
    std::vector<CurvePoint> curve;
    for (const PeriodicMotion& solution :
         sweep(model.machine, angular(speeds), model.harmonics, model.samples))
      curve.push_back(
          {speeds[curve.size()],
           solution.found() ? half_peak_to_peak(solution.bodies, transform)[2] : 0});
    return curve;
  });
}

CurvePoint integrated_peak(const Model& model, const std::vector<double>& frequencies)
{
  return highest(model, frequencies, [&](const std::vector<double>& speeds) {
    std::vector<CurvePoint> curve;
    for (double frequency : speeds)
      curve.push_back(
          {frequency, orbit_size(motion_of(model, settled(model, frequency))).x.value});
    return curve;
  });
}

std::optional<ContactLoss> contact_loss(const Model& model,
                                        const std::vector<double>& frequencies)
{
  const auto first = onset(model, frequencies);
  if (!first) return {};
  return ContactLoss{*first, *onset(model, {frequencies.rbegin(), frequencies.rend()})};
}

std::optional<OrbitSize> balance_orbit_size(const Model& model, double frequency)
{
  if (!has_rotation_period(model.machine.bearing)) return {};
  const PeriodicMotion solution = motion::search_periodic(
      {model.machine, angular(frequency), model.harmonics, model.samples});
  if (!solution.found()) return {};
  const Eigen::VectorXd amplitude = half_peak_to_peak(solution.bodies);
  return OrbitSize{{amplitude[2]}, {amplitude[3]}};
}

OrbitSize orbit_size(const motion::Motion& motion)
{
  const auto period = static_cast<std::size_t>(motion.points_per_period);
  const auto mean_size = [&](double Vec2::*displacement) -> Measured {
    std::vector<double> values, mirrored, sizes;
    for (const Bodies& bodies : motion.positions) {
      values.push_back(bodies.rotor.*displacement);
      mirrored.push_back(-values.back());
    }
    for (std::size_t k = 0; k < values.size(); k += period)
      sizes.push_back(0.5 * (crest(values, k, period) + crest(mirrored, k, period)));
    return batch_mean(sizes);
  };
  return {mean_size(&Vec2::x), mean_size(&Vec2::y)};
}

}  // namespace rotor_stator::studies
