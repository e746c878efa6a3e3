/**
# Work against precision

Paper: §3.3, claim C9.

    build/work_precision > data/generated/work_precision.tsv

Which method is faster depends on the error that is wanted. Each run of a method is a
point, its error upwards and the CPU time of one thread to the right; the line joins the
best points of the method. Where two lines cross, the order of the methods changes.

The upper row shows the error of displacement, the lower row that of the force. The second
is much larger: the force has higher harmonics that hardly move the bodies. The bars show
where the time goes at an error of a thousandth: into the bearing's force, into Fourier
transforms, or into linear algebra and the rest.

The CPU time includes tables, the start, the transient or the iterations, but not the
planning of Fourier transforms, which a process does once. The reference is shooting with
a far tighter tolerance, compared with harmonic balance with very many harmonics; the
header says how well they agree.

Each motion is computed twice: from nothing, and from the known motion at a speed a little
below. The second is what a sweep over the speeds costs at each of its steps. Repetitions
are timed one after the other. The force inside harmonic balance is timed in a run of its
own; all other shares of the time are numbers of operations times what one takes in the
same run.

Modelled: seven T-periodic motions of both data sets, four of which are drawn. */
#include "balance/fourier_transform.hpp"
#include "costs/timed_method.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "model/ball_bearing.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::costs;

struct WorkPrecisionScene {
  SceneFile file;
  StrictToml toml = file.toml();
  std::vector<Parameters> sets = read_parameter_list(file, "parameters");
  /** [Hz]: one for each set, and how far below it the known motion is. */
  std::vector<double> frequencies = toml.numbers("speeds_hz", Range::positive);
  double below = toml.number("below_hz", Range::positive);
  std::vector<Candidates> candidates = read_candidates(toml);
  int repetitions = toml.integer("repetitions", 1, 1000);
  /** [s]: a run above it is repeated twice only. */
  double long_run = toml.number("long_run_s", Range::positive);
  /** Of the second, independent reference. */
  int reference_harmonics = toml.integer("reference_harmonics", 1, 4096);
  TruthSettings truth{.settling = read_steady_settings(file)};
};

WorkPrecisionScene read_work_precision(const SceneFile& file)
{
  const WorkPrecisionScene scene{file};
  const StrictToml& toml = scene.toml;
  if (scene.sets.size() != scene.frequencies.size())
    toml.fail("speeds_hz", "must have one value for each of parameters");
  for (double frequency : scene.frequencies)
    if (frequency <= scene.below) toml.fail("below_hz", "must be below every speed");
  toml.refuse_unknown_keys();
  return scene;
}

struct WorkPoint : Measurement {
  std::size_t number;  ///< of the case
  double frequency;    ///< [Hz]
  bool continued;      ///< from the motion below, else from nothing
  double force_share = 0, transform_share = 0;  ///< of the CPU time [-]

  bool found() const { return std::isfinite(displacement); }
};

/** The scene's case of that number, the motion below its speed known. Throws NoSolution
    when a reference cannot be had or is not T-periodic. */
References work_case(const WorkPrecisionScene& scene, std::size_t number)
{
  const Parameters& parameters = scene.sets[number - 1];
  const auto periodic_motion = [&](double frequency) {
    TrueMotion truth = true_motion(parameters, frequency, scene.truth);
    if (!truth.periodic)
      throw NoSolution(
          format("the motion at %g Hz is not T-periodic (Poincare spread %.1e)",
                 frequency, truth.spread));
    return truth;
  };
  const double frequency = scene.frequencies[number - 1], below = frequency - scene.below;
  const TrueMotion truth = periodic_motion(frequency);
  return {{parameters, {frequency}, Task::Known{below, periodic_motion(below).state}},
          {truth}};
}

/** Evaluations that are timed together, enough for the clock. */
constexpr int instants = 20000;

/** CPU seconds of one evaluation of the bearing's force by a time method, along a
    motion. */
double seconds_of_force(const Parameters& parameters, const motion::Motion& motion)
{
  const BallBearing bearing(parameters.bearing);
  std::vector<Direction> cage;
  for (std::size_t k = 0; k < motion.size(); ++k)
    cage.push_back(Direction::of(parameters.bearing.cage_speed_ratio * motion.phase(k)));
  volatile double kept = 0;
  const CpuTime time = time_of(5, [&] {
    double sum = 0;
    for (int k = 0; k < instants; ++k) {
      const std::size_t at = k % motion.size();
      sum += bearing.force(cage[at], motion.positions[at].relative()).x;
    }
    kept = sum;
  });
  return time.median / instants;
}

/** CPU seconds of one Fourier transform of a series of N samples, copies included. */
double seconds_of_transform(int samples)
{
  FourierTransform transform(samples);
  const int times = std::max(1, instants / samples);
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(samples, 1);
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(1, 2 * (samples / 4) + 1);
  const CpuTime time = time_of(5, [&] {
    for (int k = 0; k < times; ++k) {
      transform.to_series(values, series);
      transform.to_samples(series, values);
    }
  });
  return time.median / (2 * times);
}

/** A run in which the force is timed, or the number of evaluations times what one
    takes. */
void split_time(WorkPoint& point, const References& references)
{
  if (point.schedule.method() != "aft") {
    const double force =
        static_cast<double>(point.force_instants) *
        seconds_of_force(references.parameters, references.truths.front().motion);
    point.force_share = std::min(1.0, force / point.median);
    return;
  }
  Task task = references;
  task.profiled = true;
  const auto method = timed_method(task, point.schedule);
  double force = 0;
  const CpuTime profiled = time_of(point.repetitions, [&] {
    method->run();
    force += method->counts().force_seconds / point.repetitions;
  });
  point.force_share = std::min(1.0, force / profiled.median);
  const double transforms = static_cast<double>(point.transforms) *
                            seconds_of_transform(point.schedule.at(0).sample_count());
  point.transform_share = std::min(1 - point.force_share, transforms / point.median);
}

using Row = WorkPoint;

const std::vector<Field<Row>> work_precision_fields{
    {"case", "-", "number of the case in the header", &Row::number},
    {"f", "Hz", "speed", &Row::frequency},
    {"start", "-",
     "nothing: static load or quasi-static contact; below: the motion below",
     [](auto& r) { return std::string(r.continued ? "below" : "nothing"); }},
    {"method", "-", "aft: harmonic balance; rk4; rk8; GSL's; shooting- with rk4 or rk8",
     [](auto& r) { return r.schedule.method(); }},
    {"setting", "-", "m, N, tolerance, step [s], transient [s], closure",
     [](auto& r) { return r.schedule.text(); }},
    {"found", "-", "whether it gave a motion", [](auto& r) { return r.found(); }},
    {"cpu_s", "s", "CPU of one thread, median of the repetitions", &Row::median},
    {"cpu_min_s", "s", "least", &Row::least},
    {"cpu_max_s", "s", "most", &Row::most},
    {"repetitions", "-", "fewer for the long runs", &Row::repetitions},
    {"error", "-", "largest relative error of displacement; -1 when not found",
     [](auto& r) { return r.found() ? r.displacement : -1; }},
    {"error_force", "-", "largest relative error of force; -1 when not found",
     [](auto& r) { return r.found() ? r.force : -1; }},
    {"force_share", "-", "of the CPU time in the bearing's force", &Row::force_share},
    {"transform_share", "-", "of the CPU time in Fourier transforms",
     &Row::transform_share},
    {"evaluations", "-", "evaluations of the bearing's force, one instant each",
     &Row::force_instants},
    {"transforms", "-", "Fourier transforms of one series", &Row::transforms}};

WorkPoint work_point(const WorkPrecisionScene& scene, std::size_t number,
                     References reference, bool continued, const Setting& setting)
{
  if (!continued) reference.before.reset();
  const double once = measure(reference, setting, 1).median;
  const int repetitions = once > scene.long_run ? 2 : scene.repetitions;
  WorkPoint point{measure(reference, setting, repetitions), number,
                  reference.frequencies.front(), continued};
  if (point.found()) split_time(point, reference);
  return point;
}

Table work_precision_table(const WorkPrecisionScene& scene,
                           const std::vector<std::vector<Cell>>& cases,
                           const std::vector<WorkPoint>& points)
{
  Table table("Work against precision: one periodic motion, every method",
              work_precision_fields);
  table.value("below", scene.below);
  table.value("repetitions", scene.repetitions);
  table.note("below: the motion known is so many Hz below the speed");
  table.note(what_is_timed);
  table.note(format(
      "reference: shooting by rk8, tolerance %g; agreement: with harmonic balance, m = "
      "%d",
      scene.truth.tolerance, scene.reference_harmonics));
  for (const std::vector<Cell>& one : cases) table.row_line("case", one);
  table.note("row case: number, speed, file, Poincare spread, closure, agreement");
  for (const WorkPoint& point : points) table.row(work_precision_fields, point);
  return table;
}

}  // namespace

int main(int argc, char** argv)
{
  return run_figure(argc, argv, [](SceneFile& file) {
    const WorkPrecisionScene scene = read_work_precision(file);
    std::vector<std::vector<Cell>> cases;
    std::vector<WorkPoint> points;
    for (std::size_t number = 1; number <= scene.frequencies.size(); ++number) {
      const References reference = work_case(scene, number);
      const TrueMotion& truth = reference.truths.front();
      cases.push_back(
          {number, truth.frequency, one_word(reference.parameters.file), truth.spread,
           truth.periodicity_residual,
           agreement(reference.parameters, truth, scene.reference_harmonics)});
      for (const Candidates& method : watched("methods", scene.candidates))
        for (bool continued : {false, true})
          for (const Setting& setting : method.groups | std::views::join)
            points.push_back(work_point(scene, number, reference, continued, setting));
    }
    return work_precision_table(scene, cases, points);
  });
}
