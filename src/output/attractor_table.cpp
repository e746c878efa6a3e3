#include "output/attractor_table.hpp"

#include "model/errors.hpp"
#include "output/provenance.hpp"
#include "scenes/attractors.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"origin", "-",
     "1 carried on from the next lower speed, 2 from the next higher; begun on the solution with 3 few, 4 many harmonics; 5 at random states"},
    {"starts", "-", "number of starts that ended so"},
    {"attractor", "-", "number of the attractor at this set and speed"},
    {"verdict", "-",
     "1 T-periodic, 2 kT-periodic, 3 quasi-periodic, 4 chaotic, 0 undecided"},
    {"period", "-", "k of the least spread"},
    {"spread", "-", "extent of the Poincare section over the largest displacement"},
    {"spread_k", "-",
     "largest distance of points kT apart over the largest displacement"},
    {"exponent", "1/s", "largest Lyapunov exponent"},
    {"exponent_error", "1/s", "its standard error"},
    {"seconds", "s", "integrated"},
    {"amp_x_s", "m", "half peak-to-peak of x_s"},
    {"amp_y_s", "m", ""},
    {"amp_x_r", "m", ""},
    {"amp_y_r", "m", ""},
    {"x_s", "m", "state at phase 0"},
    {"y_s", "m", ""},
    {"x_r", "m", ""},
    {"y_r", "m", ""},
    {"vx_s", "m/s", ""},
    {"vy_s", "m/s", ""},
    {"vx_r", "m/s", ""},
    {"vy_r", "m/s", ""}};

std::vector<Cell> cells(const AttractorPoint& p)
{
  const Attractor& a = p.attractor;
  const SectionJudgement& j = a.judgement;
  std::vector<Cell> row{p.set,
                        p.frequency,
                        static_cast<int>(p.origin),
                        p.starts,
                        p.number,
                        static_cast<int>(j.verdict),
                        j.period,
                        j.spread,
                        j.spread_k,
                        j.exponent.value,
                        j.exponent.error,
                        a.seconds};
  for (double amplitude : a.amplitude) row.emplace_back(amplitude);
  for (double value : vector_of(a.state)) row.emplace_back(value);
  return row;
}

void describe(const AttractorScene& scene, Table& table)
{
  const AttractorSettings& s = scene.settings;
  for (const Parameters& parameters : scene.sets) table.describe(parameters);
  table.note(text(
      "modelled: rk4, up and down through %zu speeds, from %d and %d harmonics at each, and from %d random states at %zu speeds (seed %d)",
      scene.frequencies.size(), scene.few_harmonics, scene.many_harmonics,
      scene.random_starts, scene.random_frequencies.size(), scene.seed));
  table.note(text(
      "transient: until the section's spread is below %g, at most %g s; then %g s if the section closes, %g s if chaotic, at most %g s else",
      s.transient.settled, s.transient.longest, s.least, s.chaotic, s.most));
  table.note(text(
      "verdict: closed below a spread of %g, k up to %d; chaotic if the exponent less 3 errors is above %g 1/s; quasi-periodic if it is within 3 errors of 0",
      s.rule.periodic, s.rule.most_period, s.rule.zero_rate));
  table.note(text(
      "same attractor: means and scatters within %g of the largest scatter if closed, %g else",
      s.same_periodic, s.same_aperiodic));
}

}  // namespace

Table attractor_table(const std::string& scene_file, const std::string& reading,
                      const std::string& journal)
{
  const AttractorScene scene = read_attractor_scene(scene_file, reading);
  Table table("Attractors", columns);
  describe(scene, table);
  std::vector<std::string> files{scene_file};
  for (const Parameters& parameters : scene.sets) files.push_back(parameters.file);
  const std::string stamp = source_revision() + " " + compiler() + " " + stamp_of(files);
  for (const AttractorPoint& point : compute_attractors(scene, journal, stamp))
    table.row(cells(point));
  return table;
}

}  // namespace rotor_stator
