/** # Evidence on the model (§2 and Table 1) */
#include <cmath>
#include <numbers>

#include "deviations/evidence.hpp"
#include "deviations/printed_equations.hpp"
#include "io/errors.hpp"
#include "model/hertz.hpp"
#include "time/settle.hpp"

namespace rotor_stator::deviations {

EvidenceList sign_of_approach(const DeviationScene& scene)
{
  const StaticContact contact = static_contact(scene.machine);
  const auto growth = [&](double stiffness) {
    return free_modes(scene.machine, stiffness).real().maxCoeff();
  };
  const double printed = growth(-contact.stiffness);
  /** The largest sag v [m] of the rotor below the stator, without contact, that both
      bodies can carry with Eq. 4 as printed: the greatest value of v - F(v)(1/k_s +
      1/k_r), where the printed force pushes them further apart. */
  const double compliance =
      1 / scene.machine.stator.stiffness() + 1 / scene.machine.rotor.stiffness();
  const BallBearing bearing(scene.machine.bearing);
  double sag_printed = 0;
  for (int k = 0; k <= 10000; ++k) {
    const double v = 2 * scene.machine.bearing.clearance * k / 10000;
    sag_printed = std::max(sag_printed, v - compliance * bearing.force({1, 0}, {0, v}).y);
  }
  return {{"D-01.stiffness_ours", contact.stiffness, "N/m",
           "slope of the bearing's force along the static contact, Eq. 4 corrected"},
          {"D-01.stiffness_printed", -contact.stiffness, "N/m",
           "the same at the same penetration, Eq. 4 as printed"},
          {"D-01.suspension", scene.machine.stator.stiffness(), "N/m",
           "stiffness of the stiffer suspension"},
          {"D-01.growth_printed", printed, "1/s",
           "growth rate of both bodies linearised about that contact, as printed"},
          {"D-01.growth_ours", growth(contact.stiffness), "1/s",
           "the same with Eq. 4 corrected; negative: it decays"},
          {"D-01.doubling_printed", std::numbers::ln2 / printed, "s",
           "time in which a disturbance doubles, as printed"},
          {"D-01.sag", std::abs(free_displacement(scene.machine, 0, 0).y), "m",
           "distance by which the rotor sags below the stator without contact"},
          {"D-01.sag_printed", sag_printed, "m",
           "largest such distance for which the printed sign has an equilibrium"}};
}

EvidenceList radius_of_hertz(const DeviationScene& scene)
{
  StrictToml table = scene.table("steel");
  const Solid steel{table.number("young_modulus_Pa", Range::positive),
                    table.number("poisson_ratio", Range::not_negative)};
  const double radius = table.number("ball_radius_m", Range::positive);
  const double k_h = hertz_contact_stiffness(radius, steel, steel);
  const double printed = scene.machine.bearing.contact_stiffness;
  const double needed = radius * (printed / k_h) * (printed / k_h);
  /** Balls that do not overlap: R_b < (R_b + R) sin(π/n). */
  const double race =
      needed / std::sin(std::numbers::pi / scene.machine.bearing.balls) - needed;
  const double force = std::abs(static_contact(scene.machine).force);
  return {{"D-07.ball_radius", radius, "m", "radius of a steel ball"},
          {"D-07.K_H", k_h, "N/m^1.5", "Eq. 2 for it, steel on steel"},
          {"D-07.K_H_table", printed, "N/m^1.5", "Table 1"},
          {"D-07.ball_radius_needed", needed, "m",
           "radius at which Eq. 2 gives Table 1's value"},
          {"D-07.race_radius_needed", race, "m",
           "inner race that has room for balls of that size"},
          {"D-07.penetration_ratio",
           hertz_penetration(k_h, force) / hertz_penetration(printed, force), "-",
           "static penetration of one ball with Eq. 2's value over that with Table 1's"}};
}

EvidenceList unit_of_stiffness(const DeviationScene& scene)
{
  const StaticContact contact = static_contact(scene.machine);
  const double k = scene.machine.bearing.contact_stiffness;
  const double force = std::abs(contact.force);
  return {{"D-08.force", force, "N", "static contact force"},
          {"D-08.penetration_hertz",
           std::abs(contact.displacement) - scene.machine.bearing.clearance, "m",
           "static penetration with Table 1's value in N/m^1.5"},
          {"D-08.penetration_linear", force / k, "m",
           "static penetration of one linear spring with Table 1's value in N/m"},
          {"D-08.stiffness_ratio", k / contact.stiffness, "-",
           "that spring's stiffness over the bearing's at the static contact"}};
}

EvidenceList two_readings(const DeviationScene& scene)
{
  const double speed = scene.table("readings").number("speed_hz", Range::positive);
  const Parameters &ours = scene.machine, &printed = scene.printed;
  const auto joint_hz = [](Parameters machine, const Parameters& masses) {
    machine.stator.mass = masses.stator.mass;
    machine.rotor.mass = masses.rotor.mass;
    return joint_resonance(machine) / angular(1);
  };
  EvidenceList list{
      {"D-09.joint_exchanged", joint_hz(ours, ours), "Hz",
       "joint resonance, exchanged frequencies with their working masses"},
      {"D-09.joint_printed", joint_hz(printed, printed), "Hz",
       "joint resonance, printed frequencies with their working masses"},
      {"D-09.joint_printed_masses_exchanged", joint_hz(printed, ours), "Hz",
       "joint resonance, printed frequencies with the masses of the exchanged reading"},
      {"D-09.joint_exchanged_masses_printed", joint_hz(ours, printed), "Hz",
       "joint resonance, exchanged frequencies with the masses of the printed reading"},
      {"D-09.stator_alone_exchanged", ours.stator.natural_frequency / angular(1), "Hz",
       "resonance of the stator alone, exchanged"},
      {"D-09.stator_alone_printed", printed.stator.natural_frequency / angular(1), "Hz",
       "resonance of the stator alone, printed: inside the range of Fig. 3"},
      {"D-09.speed", speed, "Hz", "speed of the following"}};
  for (const auto& [name, machine] :
       {std::pair{"exchanged", &ours}, std::pair{"printed", &printed}}) {
    const SteadyState steady = scene.settled(*machine, speed);
    add(list, contact_of(format("D-09.contact_%s", name),
                         "share of the time with a loaded ball", *machine,
                         scene.motion_of(steady)));
    add(list, spread_of(format("D-09.spread_%s", name), steady));
    const PeriodicMotion peak = require_periodic(
        {*machine, angular(joint_hz(*machine, *machine)), scene.harmonics});
    list.push_back({format("D-09.peak_%s", name),
                    1e3 * half_peak_to_peak(scene.motion_of(peak))[2], "mm",
                    "half peak-to-peak of x_r at the joint resonance"});
    list.push_back({format("D-09.eccentricity_%s", name),
                    1e3 * machine->unbalance / machine->rotor.mass, "mm",
                    "of the rotor's centre of mass, m_e e/m_r"});
    const auto equal = equal_force_speeds(*machine, 2 * joint_resonance(*machine));
    for (int number = 0; double omega : equal)
      list.push_back({format("D-09.equal_%s_%d", name, ++number), omega / angular(1),
                      "Hz", "gravity and unbalance load the rigid joint equally"});
  }
  return list;
}

EvidenceList unprinted_masses(const DeviationScene& scene)
{
  EvidenceList list{
      {"D-13.m_s", scene.machine.stator.mass, "kg", "stator, exchanged reading"},
      {"D-13.m_r", scene.machine.rotor.mass, "kg", "rotor, exchanged reading"},
      {"D-13.m_s_printed", scene.printed.stator.mass, "kg", "stator, printed reading"},
      {"D-13.m_r_printed", scene.printed.rotor.mass, "kg", "rotor, printed reading"},
      {"D-13.joint", joint_resonance(scene.machine) / angular(1), "Hz",
       "joint resonance"},
      {"D-13.loss",
       equal_force_speeds(scene.machine, joint_resonance(scene.machine)).front() /
           angular(1),
       "Hz", "gravity and unbalance load the rigid joint equally"},
      {"D-13.speed", scene.transition_speed, "Hz", "speed of the following"}};
  for (int number = 0;
       double factor : scene.table("masses").numbers("factors", Range::positive)) {
    list.push_back({format("D-13.factor_%d", ++number), factor, "-", "of both masses"});
    Parameters machine = scene.machine;
    machine.stator.mass *= factor;
    machine.rotor.mass *= factor;
    const SteadyState steady = scene.settled(machine, scene.transition_speed);
    add(list, contact_of(format("D-13.contact_%d", number),
                         format("share of the time in contact with both masses times %g",
                                factor),
                         machine, scene.motion_of(steady)));
    add(list, spread_of(format("D-13.spread_%d", number), steady,
                        format("Poincare spread with both masses times %g", factor)));
  }
  return list;
}

}  // namespace rotor_stator::deviations
