/** Sensitivity: the features against closed forms of rotor and stator moving as one body,
   against each other, and against the solver called for one speed. */
#include <cmath>
#include "support/catch.hpp"

#include "io/errors.hpp"
#include "studies/sensitivity.hpp"
#include "support/cases.hpp"
#include "support/command.hpp"

using namespace rotor_stator;
using namespace rotor_stator::studies;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

SensitivityScene scene()
{
  SceneFile file(SOURCE_DIR "/data/scenes/sensitivity.toml", "exchanged");
  return read_sensitivity_scene(file);
}

/** The peak of both bodies as one mass M on both suspensions, driven by m_e e ω²: with
    ω_0² = K/M and ζ = C/(2Mω_0), at ω_0/√(1 - 2ζ²), of m_e e/(2Mζ√(1 - ζ²)). */
CurvePoint joint_peak(const Parameters& p)
{
  const double mass = p.stator.mass + p.rotor.mass;
  const double omega_0 = joint_resonance(p);
  const double zeta = (p.stator.damping() + p.rotor.damping()) / (2 * mass * omega_0);
  return {omega_0 / std::sqrt(1 - 2 * zeta * zeta) / hertz(1),
          p.unbalance / (2 * mass * zeta * std::sqrt(1 - zeta * zeta))};
}

/** A power law as points about a default of 2, one output known at some values only. */
SensitivityPoint power_law(double value, bool usual, bool known)
{
  SensitivityPoint point{Unpublished::mass, value, usual};
  point.outputs[f_peak] = Measured{5 * std::pow(value, 3)};
  if (known) point.outputs[amp_x_aft] = Measured{std::pow(value, -0.5), 1e-3};
  return point;
}

}  // namespace

TEST_CASE("The peak follows the joint resonance when the masses change")
{
  const SensitivityScene s = scene();
  for (const auto& [parameter, value] :
       {std::pair{Unpublished::mass, 30.0}, std::pair{Unpublished::mass, 120.0},
        std::pair{Unpublished::mass_ratio, 1.0},
        std::pair{Unpublished::mass_ratio, 4.0}}) {
    const Model model = varied(s.usual, parameter, value);
    const CurvePoint expected = joint_peak(model.machine);
    const CurvePoint peak = balance_peak(model, s.peak_speeds);
    INFO("value " << value);
    CHECK(peak.frequency == Approx(expected.frequency).epsilon(0.01));
    CHECK(peak.amplitude == Approx(expected.amplitude).epsilon(0.05));
  }
}

TEST_CASE("At the defaults harmonic balance and time integration find the same peak")
{
  const SensitivityScene s = scene();
  const CurvePoint balance = balance_peak(s.usual, s.peak_speeds);
  const CurvePoint integrated = integrated_peak(s.usual, s.time_peak_speeds);
  CHECK(balance.frequency == Approx(integrated.frequency).epsilon(2e-4));
  CHECK(balance.amplitude == Approx(integrated.amplitude).epsilon(2e-4));
}

TEST_CASE("The refined peak is the solution at its speed, and higher than its neighbours")
{
  const SensitivityScene s = scene();
  const CurvePoint peak = balance_peak(s.usual, s.peak_speeds);
  const auto at = [&](double frequency) {
    const auto size = balance_orbit_size(s.usual, frequency);
    REQUIRE(size);
    return size->x.value;
  };
  CHECK(peak.amplitude == Approx(at(peak.frequency)).epsilon(1e-5));
  CHECK(at(peak.frequency - 0.05) < at(peak.frequency));
  CHECK(at(peak.frequency + 0.05) < at(peak.frequency));
}

TEST_CASE("Contact is lost in the band of Fig. 3, and never where gravity holds it")
{
  const SensitivityScene s = scene();
  const auto loss = contact_loss(s.usual, {11.0, 12.0, 13.0, 14.0, 15.0});
  REQUIRE(loss);
  CHECK(loss->first.value > 12);
  CHECK(loss->first.value < 13);
  CHECK(loss->last.value > 14);
  CHECK(loss->last.value < 15);
  CHECK(loss->first.error == Approx(0.5));

  Model quiet = s.usual;
  quiet.machine.unbalance /= 10;
  CHECK_FALSE(contact_loss(quiet, {11.0, 12.0, 13.0, 14.0, 15.0}));
}

TEST_CASE(
    "The size of an integrated orbit: closed form, and no error where it is periodic")
{
  Motion motion{40, 0, {}};
  for (int k = 0; k < 40 * 20; ++k)
    motion.positions.push_back(
        {{0, 0}, {3 * std::cos(motion.phase(k) + 0.1), 2 + std::sin(motion.phase(k))}});
  const OrbitSize size = orbit_size(motion);
  CHECK(size.x.value == Approx(3).epsilon(1e-5));
  CHECK(size.y.value == Approx(1).epsilon(1e-5));
  CHECK(size.x.error < 1e-12);
}

TEST_CASE("Masses are varied as said: the total at fixed ratio, the ratio at fixed total")
{
  const Model usual = scene().usual;
  const auto heavy = varied(usual, Unpublished::mass, 90).machine;
  CHECK(heavy.stator.mass == Approx(30));
  CHECK(heavy.rotor.mass == Approx(60));
  const auto other = varied(usual, Unpublished::mass_ratio, 3).machine;
  CHECK(other.stator.mass == Approx(15));
  CHECK(other.rotor.mass == Approx(45));
}

TEST_CASE("Normalised derivatives of a power law are its exponents")
{
  const auto derivatives =
      normalised_derivatives({power_law(1, false, true), power_law(1.8, false, false),
                              power_law(2, true, true), power_law(2.3, false, false)});
  REQUIRE(derivatives.size() == 2);
  CHECK(derivatives[0].output == f_peak);
  CHECK(derivatives[0].slope.value == Approx(3));
  CHECK(derivatives[0].low == 1.8);
  CHECK(derivatives[0].high == 2.3);
  /** One side only, and the nearest value that has the output. */
  CHECK(derivatives[1].output == amp_x_aft);
  CHECK(derivatives[1].slope.value == Approx(-0.5));
  CHECK(derivatives[1].low == 1);
  CHECK(derivatives[1].high == 2);
  CHECK(derivatives[1].slope.error > 1e-3);
}

/** Would catch a number that is computed for another point, or at two. */
TEST_CASE("Outputs that a parameter does not enter are those of the defaults")
{
  SensitivityScene s = scene();
  int peaks = 0, balances = 0, integrations = 0;
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    SensitivityPoint& point = s.points[k];
    const auto number = static_cast<double>(k);
    if (point.usual) {
      peaks += point.peak;
      balances += point.balance;
      integrations += point.integration;
    }
    if (point.peak) point.set(f_peak, {number}, {number});
    if (point.balance) point.set(amp_x_aft, {number}, {number});
    if (point.integration) point.set(f_loss_first, {number}, {number});
  }
  CHECK(peaks == 2);
  CHECK(balances == 1);
  CHECK(integrations == 1);
  fill_from_defaults(s.points);
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    const SensitivityPoint& point = s.points[k];
    INFO("row " << k);
    CHECK(point.outputs[f_peak]->value == Approx(point.peak ? k
                                                 : point.parameter == Unpublished::step
                                                     ? 20
                                                     : 3));
    CHECK(point.outputs[amp_x_aft]->value == Approx(point.balance ? k : 3));
    CHECK(point.outputs[f_loss_last]->value == Approx(point.integration ? k : 3));
  }
}

TEST_CASE("A sensitivity scene must hold the defaults, in rising order")
{
  const Scratch scratch;
  const std::string text = read_whole(SOURCE_DIR "/data/scenes/sensitivity.toml");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    std::filesystem::create_directories(scratch.path("scenes"));
    scratch.write("set1.toml", read_whole(SOURCE_DIR "/data/set1.toml"));
    return scratch.write("scenes/sensitivity.toml", changed);
  };
  const auto read = [](const std::string& name) {
    SceneFile file(name, "exchanged");
    return read_sensitivity_scene(file);
  };
  CHECK_NOTHROW(read(with("4.0]", "5.0]")));
  CHECK_THROWS_AS(read(with("54.0, 60.0", "54.0")), BadInput);
  CHECK_THROWS_AS(read(with("54.0, 60.0", "60.0, 54.0")), BadInput);
  CHECK_THROWS_AS(read(with("0.485, 0.5]", "0.485, 0.5, 0.6]")), BadInput);
  CHECK_THROWS_AS(read(with("[13,", "[12,")), BadInput);
}
