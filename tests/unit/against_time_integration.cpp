/** What a panel shows: harmonic balance or rk8pd. They share nothing but Eq. 7. */
#include "figures/panels.hpp"
#include "motion/motion.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

const SteadySettings accurate{
    .stepper = {.method = "rk8pd", .intervals_per_period = 64, .tolerance = 1e-13},
    .settled = 1e-10,
    .longest = 12};

}  // namespace

/** Catches a rule that measures with the static sag inside, 0.7 % at 3 Hz, or that never falls back on the
    integrated motion. */
TEST_CASE("A panel shows harmonic balance only up to an rms error of 10 % about the mean")
{
  for (const auto& [frequency, shows_balance] : {std::pair{3.0, false}, {6.0, true}}) {
    INFO(frequency << " Hz");
    const figures::PanelScene scene{.title = "",
                                    .parameters = set_1(),
                                    .frequencies = {frequency},
                                    .harmonics = 6,
                                    .samples = default_samples(6),
                                    .time_integration = accurate};
    const figures::Panel panel = figures::panels_of(scene, find_periodic).at(0);
    REQUIRE(panel.balance);
    /** The rms of the harmonics 1 to 31, by Parseval. */
    const auto vibration = [](const Motion& m) -> Eigen::MatrixXd {
      return series_of(m, 31).rightCols(62);
    };
    const Eigen::MatrixXd exact = vibration(panel.settled);
    const double rms = (vibration(*panel.balance) - exact).norm() / exact.norm();
    CHECK(panel.rms_difference.value == Approx(rms).epsilon(0.01));
    CHECK((rms <= 0.1) == shows_balance);
    CHECK(panel.difference < 0.01);
    CHECK(panel.shows_balance() == shows_balance);
    CHECK(&panel.shown() == (shows_balance ? &*panel.balance : &panel.settled));
  }
}
