/**
# Parameters of the rotor, the stator and their bearing

One TOML file describes one machine, in the units named in each key, SI or those of
io/units.cpp. Every key is required unless said otherwise, an unknown key is an error, and
every value is checked when it is read, so that no program meets a machine that cannot
exist. The bearing's keys are in model/catalogue.hpp. */
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "model/machine.hpp"

namespace rotor_stator {

/** A vector of the x-y plane. */
template <class Number>
struct Vec2Of {
  Number x, y;
};
using Vec2 = Vec2Of<double>;

/** A body on its own suspension, the same in x and y. */
struct Body {
  double mass;  ///< m [kg], not in the paper (D-13)
  /** ω₀ [rad/s], the body alone; 0 where nothing but the bearing carries it. */
  double natural_frequency;
  double damping_ratio;  ///< ξ [-]
  double damper = 0;     ///< [N s/m], given instead of ξ
  Vec2 load = {0, 0};    ///< constant force [N], beside the weight
  bool rigid = false;    ///< held: a mass that no force moves measurably, without weight

  double stiffness() const { return mass * natural_frequency * natural_frequency; }
  double damping() const { return 2 * damping_ratio * mass * natural_frequency + damper; }

  /** The constant force [N], gravity g along -y; and its acceleration [m/s²]. */
  Vec2 static_load(double gravity) const
  {
    return rigid ? Vec2{0, 0} : Vec2{load.x, load.y - mass * gravity};
  }
  Vec2 static_acceleration(double gravity) const
  {
    return rigid ? Vec2{0, 0} : Vec2{load.x / mass, load.y / mass - gravity};
  }
};

/** A spall [bearing.defect]: over an angle a ball loses up to `depth` of its deflection.
    Angles [rad] are those of the surface that is damaged. */
struct Defect {
  enum class Surface { none, outer_race, inner_race, ball };
  /** As files and tables name them. */
  static constexpr std::array surfaces{"none", "outer_race", "inner_race", "ball"};
  Surface surface = Surface::none;
  double depth = 0;  ///< [m]
  double width = 0;  ///< [rad]
  /** Of its middle [rad]: outer race from the x axis, inner race from the unbalance. */
  double place = 0;
  int ball = 1;     ///< which one, where a ball is damaged
  double spin = 0;  ///< its turns about itself per base period, seen from the cage
};

/** Stiffness [N/m] and damping [N s/m], xx, xy, yx and yy, at a rotor speed [rad/s]. */
struct Coefficients {
  double speed = 0;
  std::array<double, 4> stiffness{}, damping{};
};

/** What stands beside the balls [bearing.parallel] (parallel.hpp). */
struct ParallelElements {
  double cubic = 0;                       ///< of a spring that hardens [N/m³]
  double stop_stiffness = 0;              ///< of a ring that the rotor meets [N/m] ...
  double stop_gap = 0;                    ///< ... where it is so far from the middle [m]
  std::vector<Coefficients> linear = {};  ///< by ascending speed
  double speed_ratio = 1;  ///< of the rotor's speed over `turns` base frequencies

  bool any() const { return cubic > 0 || stop_stiffness > 0 || !linear.empty(); }
  /** Whether it pushes back in x and in y what is displaced. */
  bool holds() const
  {
    const auto is_spring = [](const Coefficients& at) {
      return at.stiffness[0] > 0 && at.stiffness[3] > 0;
    };
    return cubic > 0 || stop_stiffness > 0 || std::ranges::any_of(linear, is_spring);
  }
  bool is_damped() const
  {
    return std::ranges::any_of(linear, [](const Coefficients& at) {
      return at.damping != std::array<double, 4>{};
    });
  }
};

/** The ball bearing between them. */
struct Bearing {
  int balls;                 ///< n
  double contact_stiffness;  ///< K_H [N/m^{3/2}], or K [N/m^exponent]
  double clearance;         ///< δ [m], radial; negative where balls are pressed at u = 0
  double cage_speed_ratio;  ///< c = ω_cage/ω [-]
  double radius_ratio;      ///< R_b/(R_b + R) [-]; 0 when only c was given
  double ball_diameter = 0;  ///< [m]; 0 when only c was given
  /** Largest of Hertz [Pa] on the race that has more of it, over Q^{1/3}; 0 unknown. */
  double pressure = 0;
  double damping = 0;                 ///< λ of Hunt and Crossley [s/m]
  double exponent = 1.5;              ///< of the penetration; 10/9 for rollers
  double contact_angle = 0;           ///< α [rad], of the kinematics alone
  double outer_ring_speed_ratio = 0;  ///< ω_outer/ω [-]
  double cage_phase = 0;              ///< angle of ball 1 at t = 0 [rad]
  Defect defect = {};
  ParallelElements parallel = {};
  std::string doubt = {};  ///< of its clearance beside the class of its designation
  std::string place = {};  ///< of an element to the ground, for headers

  bool is_damaged(Defect::Surface at) const { return defect.surface == at; }

  /** Which force it is: Eq. 5 of intact balls with nothing beside them; without contact
      damping too (`is_elastic_hertz`), as in the paper: it then depends on u and the
      cage's angle alone. */
  bool is_intact_hertz() const
  {
    return exponent == 1.5 && clearance >= 0 && !parallel.any() &&
           is_damaged(Defect::Surface::none);
  }

  bool is_elastic_hertz() const { return damping == 0 && is_intact_hertz(); }

  /** Whether the force depends on the rate of u. */
  bool is_damped() const { return damping > 0 || parallel.is_damped(); }

  /** The angle of ball 1 [rad] at the rotor's angle ωt = `phase`. */
  double cage_angle(double phase) const { return cage_phase + cage_speed_ratio * phase; }
};

/** Of all that was read of a machine, to tell it from others: a hash (FNV-1a). */
class Identity {
public:
  void add(std::span<const std::byte> bytes)
  {
    for (const std::byte byte : bytes)
      hash_ = (hash_ ^ std::to_integer<std::uintmax_t>(byte)) * 0x100000001b3;
  }
  std::string word() const { return format("fnv-%016jx", hash_); }

private:
  std::uintmax_t hash_ = 0xcbf29ce484222325;
};

/** One machine. Where bodies are given by matrices, `stator` and `rotor` are single
    masses that vibrate about as they do: sizes for tolerances and steps. */
struct Parameters {
  std::string file;   ///< where it was read from
  std::string title;  ///< one line for headers and legends
  Identity identity;  ///< of the file's keys and of the matrices that it names
  Body stator;
  Body rotor;
  double unbalance;          ///< m_e e [kg m], on the rotor
  double balance_speed = 0;  ///< [rad/s] of its balance grade, 0 without one
  Bearing bearing;
  double gravity;                         ///< g [m/s²], along -y
  std::vector<std::string> derived = {};  ///< lines for headers: what a catalogue gave
  std::vector<std::string> doubts = {};   ///< what is a slip rather than a machine
  int turns = 1;  ///< of the rotor in one base period, whose frequency ω is
  /** Of the speed over `turns` ω; not 1 where balls passing make the base frequency. */
  double speed_ratio = 1;
  std::vector<Bearing> further = {};  ///< bearings beside the first, of a large machine
  /** Elements between a body and the ground: joints without balls. */
  std::vector<Bearing> grounds = {};
  std::shared_ptr<const Machine> bodies = std::make_shared<const Machine>();
};

/** Elements between a body and the ground, a table of the body. */
constexpr const char* ground_key = "ground";

/** Whether a table takes only one of two keys: a study of one drops the other. */
bool excludes(const std::string& key, const std::string& other);

/** Reads bodies given by matrices or with elements to the ground, and their bearings. */
using MatrixReader = std::function<void(StrictToml& root, Parameters& parameters)>;

/** Reads and checks a machine of two masses; of bodies given by matrices too, where there
    is a reader of them (`read_machine`). Throws BadInput with file, line and key. */
Parameters read_parameters(StrictToml root, const MatrixReader& matrices = {});
inline Parameters read_parameters(const std::string& file)
{
  return read_parameters(StrictToml(file));
}

/** Those of the data sets that a key of a scene names. */
Parameters read_parameters(SceneFile& scene, const std::string& key);
std::vector<Parameters> read_parameter_list(SceneFile& scene, const std::string& key);

/** The `#` lines of a machine; with the keys, in a table that has one machine only. */
void describe(Table& table, const Parameters& parameters, bool with_keys = true);

/** ω [rad/s] of a frequency [Hz]. */
double angular(double hertz);
std::vector<double> angular(const std::vector<double>& hertz);

/** The speed of the rotor [rad/s] at the base frequency ω. */
double rotor_speed(const Parameters& parameters, double omega);

/** The same machine, its base period K turns of the rotor: ω is then a K-th of the speed,
    and the cage ratio counts the cage's turns per base period. */
Parameters over_turns(Parameters parameters, int turns);

/** Ball passages through a fixed direction per turn, n·c. The bearing's force has the
   period T = 2π/ω only when this is a whole number (D-11) and no ball is damaged. */
double passages_per_turn(const Bearing& bearing);
bool has_rotation_period(const Bearing& bearing);

/** Throws BadInput, in the name of `who`, when the force has another period. */
void require_rotation_period(const Parameters& parameters, const char* who);

/** Throws BadInput, in the name of `who`, for matrices and for elements to the ground. */
void require_two_masses(const Parameters& parameters, const char* who);

/** All bearings of a machine; and after them what joins its bodies to the ground. */
std::vector<Bearing> bearings_of(const Parameters& parameters);
std::vector<Bearing> joints_of(const Parameters& parameters);

/** A name of what belongs to bearing b, counted from 0: name, name_2, … */
std::string numbered(const std::string& name, std::size_t b);

/** The same of all that is between two masses, and between them and the ground. */
inline bool has_elastic_hertz_alone(const Parameters& parameters)
{
  return parameters.bearing.is_elastic_hertz() && parameters.grounds.empty();
}
inline bool has_intact_hertz_alone(const Parameters& parameters)
{
  return parameters.bearing.is_intact_hertz() && parameters.grounds.empty();
}

/** Whether nothing stands beside the balls, nor between a body and the ground. */
bool is_bare(const Parameters& parameters);

/** Calls `change` with every joint of a machine. */
template <class Change>
void change_joints(Parameters& parameters, Change change)
{
  change(parameters.bearing);
  for (Bearing& one : parameters.further) change(one);
  for (Bearing& one : parameters.grounds) change(one);
}

/** Throws BadInput where a damaged ball adds a third angle to those of rotor and cage. */
void require_two_angles(const Parameters& parameters);

/** Whether anything turns with the rotor; if not, only passing balls move the machine. */
bool turns_visibly(const Parameters& parameters);

}  // namespace rotor_stator
