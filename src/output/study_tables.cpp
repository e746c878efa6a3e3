#include "output/study_tables.hpp"

#include "model/errors.hpp"
#include "output/provenance.hpp"
#include "scenes/identification.hpp"
#include "scenes/parametric_study.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> identification_columns{
    {"reading", "-", "of Table 1: 0 exchanged, 1 as printed"},
    {"m_s", "kg", "mass of the stator"},
    {"m_r", "kg", "mass of the rotor"},
    {"ratio_factor", "-",
     "m_r/m_s over the ratio that puts the joint resonance at the paper's peak"},
    {"cage_speed_ratio", "-", "omega_cage/omega"},
    {"f_peak", "Hz", "speed of the largest x_r"},
    {"f_loss_first", "Hz", "first speed at which contact is lost; -1 when never"},
    {"f_loss_last", "Hz", "last such speed; -1 when never"},
    {"low_contact", "-", "share of the low speeds with permanent contact"},
    {"low_periodic", "-", "share with T-periodic motion"},
    {"low_simple", "-", "share with higher harmonics below the limit"},
    {"middle_contact", "-", "the same of the middle speeds"},
    {"middle_periodic", "-", ""},
    {"middle_simple", "-", ""},
    {"high_contact", "-", "the same of the high speeds"},
    {"high_periodic", "-", ""},
    {"high_simple", "-", ""},
    {"passages", "-", "times a ball is loaded in 2T, mean over balls and high speeds"},
    {"c1", "-", "quantity of C1 for the score"},
    {"c4", "-", "quantity of C4"},
    {"c5", "-", "quantity of C5"},
    {"c6", "-", "quantity of C6"},
    {"c10", "-", "quantity of C10"},
    {"score", "-", "mean of the five"}};

Row numbers(const Judgement& j)
{
  Row row{j.f_peak, j.f_loss_first, j.f_loss_last};
  for (const RangeShares& s : {j.low, j.middle, j.high})
    row.insert(row.end(), {s.permanent_contact, s.periodic, s.simple});
  row.insert(row.end(), {j.passages, j.c1, j.c4, j.c5, j.c6, j.c10, j.score});
  return row;
}

std::string stamp(const std::vector<std::string>& files)
{
  return source_revision() + " " + compiler() + " " + stamp_of(files);
}

}  // namespace

Table identification_table(const std::string& scene_file, const std::string& claims_file,
                           const std::string& journal)
{
  const IdentificationScene scene = read_identification_scene(scene_file, claims_file);
  Table table("Score of the candidates for what the paper leaves out",
              identification_columns);
  table.note(text("modelled: rk4 at %zu speeds, at most %g s each; rule of %s",
                  scene.frequencies.size(), scene.settings.longest, claims_file.c_str()));
  const auto rows = run_study(
      {.name = "candidates",
       .journal = journal,
       .stamp = stamp({scene_file, claims_file}),
       .pieces = scene.candidates.size(),
       .work = [&](std::size_t k) {
         return numbers(judge(regimes_of(scene.candidates[k], scene), scene.rule));
       }});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Candidate& c = scene.candidates[k];
    std::vector<Cell> cells{c.reading, c.parameters.stator.mass, c.parameters.rotor.mass,
                            c.ratio_factor, c.parameters.bearing.cage_speed_ratio};
    cells.insert(cells.end(), rows[k].begin(), rows[k].end());
    table.row(std::move(cells));
  }
  return table;
}

namespace
{

const std::vector<Column> study_columns{
    {"delta", "m", "radial clearance"},
    {"K_H", "N/m^1.5", "contact stiffness"},
    {"f_peak", "Hz", "speed of the largest x_r; -1 without any solution"},
    {"amp_peak", "m", "half peak-to-peak of x_r there"},
    {"f_loss_first", "Hz", "first speed at which contact is lost; -1 when never"},
    {"f_loss_last", "Hz", "last such speed; -1 when never"},
    {"largest_force", "N", "largest force on one ball over all speeds"},
    {"missed", "-", "speeds without a solution"}};

}  // namespace

Table study_table(const std::string& scene_file, const std::string& journal)
{
  const ParametricStudy study = read_parametric_study(scene_file);
  Table table("Clearance against contact stiffness", study_columns);
  table.describe(study.base);
  table.note(text("modelled: sweeps up, m = %d, %zu speeds from %g to %g Hz",
                  study.harmonics, study.frequencies.size(), study.frequencies.front(),
                  study.frequencies.back()));
  const auto rows = run_study(
      {.name = "machines",
       .journal = journal,
       .stamp = stamp({scene_file, study.base.file}),
       .pieces = study.points(),
       .work = [&](std::size_t k) {
         const StudyPoint p = sweep_machine(study.machine(k), study);
         return Row{p.f_peak,      p.amp_peak,      p.f_loss_first,
                    p.f_loss_last, p.largest_force, static_cast<double>(p.missed)};
       }});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Parameters machine = study.machine(k);
    std::vector<Cell> cells{machine.bearing.clearance, machine.bearing.contact_stiffness};
    cells.insert(cells.end(), rows[k].begin(), rows[k].end());
    table.row(std::move(cells));
  }
  return table;
}

}  // namespace rotor_stator
