/** Lines of a motion: a record that is a sum of known cosines, and the names of orders. */
#include "motion/lines.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

Bearing bearing(double cage)
{
  Bearing bearing = set_1().bearing;
  bearing.cage_speed_ratio = cage;
  return bearing;
}

struct Tone {
  double order;
  std::string name;
  double amplitude;  ///< of y_r; a tenth of it in x_s [m]
};

Motion record_of(const std::vector<Tone>& tones, int points, int turns)
{
  Motion motion{points, 37, {}};
  for (int k = 0; k < points * turns; ++k) {
    Bodies q{{1e-5, 0}, {0, -2e-4}};
    for (const Tone& tone : tones) {
      const double angle =
          2 * std::numbers::pi * tone.order * k / points + 0.3 * tone.order;
      q.rotor.y += tone.amplitude * std::cos(angle);
      q.stator.x += 0.1 * tone.amplitude * std::sin(angle);
    }
    motion.positions.push_back(q);
  }
  return motion;
}

}  // namespace

/** Leakage of the largest line, four orders above the smallest, would show, and so would a name by
    chance. */
TEST_CASE("the lines of a record are the cosines that it was made of")
{
  const Bearing b = bearing(0.43);
  const double spin = (1 - 0.14 * 0.14) / (2 * 0.14);
  const std::vector<Tone> tones{{1, "1X", 1e-3},         {2, "2X", 2e-6},
                                {6.88, "BPFO", 5e-6},    {9.12, "BPFI", 3e-7},
                                {8.12, "BPFI-1X", 1e-6}, {5.88, "BPFO-1X", 1e-8},
                                {0.43, "FTF", 4e-7},     {0.86, "2FTF", 2e-8},
                                {spin, "BSF", 6e-7},     {0.732157, "", 7e-7}};
  const Lines lines = lines_of_recorded({b}, record_of(tones, 64, 128));
  CHECK(lines.mean[0] == Approx(1e-5).epsilon(1e-9));
  CHECK(lines.mean[3] == Approx(-2e-4).epsilon(1e-9));
  CHECK(lines.rest < 1e-5);
  REQUIRE(lines.lines.size() == tones.size());
  for (const Tone& tone : tones) {
    CAPTURE(tone.order);
    const auto line = std::ranges::find_if(lines.lines, [&](const Line& l) {
      return std::abs(l.order - tone.order) < 1e-4;
    });
    REQUIRE(line != lines.lines.end());
    const double accuracy = 1e-2 * (tone.name.empty() ? 1 : 0.1);
    CHECK(line->amplitude[3] == Approx(tone.amplitude).epsilon(accuracy));
    CHECK(line->amplitude[0] == Approx(0.1 * tone.amplitude).epsilon(accuracy));
    CHECK(name_of(line->order, b, 1e-9, 16).name == tone.name);
  }
}

/** Where n c is whole an order has several names; a sum that is not the shortest would show. */
TEST_CASE("the name of an order is the shortest sum")
{
  const auto name = [](double order, double cage) {
    return name_of(order, bearing(cage), 1e-9, 32);
  };
  const std::vector<double> orders{1,  3,  5,  6,   7,   8,   9,
                                   15, 16, 24, 0.5, 1.5, 7.5, 8.0 / 3};
  const std::vector<std::string> names{
      "1X",       "3X",    "5X",    "BPFO-2X", "BPFO-1X", "BPFO",      "BPFO+1X",
      "2BPFO-1X", "2BPFO", "3BPFO", "1/2X",    "3/2X",    "BPFO-1/2X", "8/3X"};
  for (std::size_t k = 0; k < orders.size(); ++k)
    CHECK(name(orders[k], 0.5).name == names[k]);
  CHECK(name(11.12, 0.43).name == "BPFI+2X");
  CHECK(name(2.24, 0.43).name == "BPFI-BPFO");
  CHECK(name(0.12, 0.43).name == "7X-BPFO");
  CHECK(name(0.31, 0.43).name.empty());
  CHECK(name(9 - 0.5 * 16 * 0.4173, 0.4173).name == "9X-1/2BPFO");
  const LineName inner = name(9.12 + 1, 0.43);
  CHECK(inner.rotation == 17);
  CHECK(inner.cage == -16);
  CHECK(inner.order(bearing(0.43)) == Approx(10.12));
}
