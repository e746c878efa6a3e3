#include "deviations/evidence.hpp"

#include "io/errors.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::deviations {

DeviationScene read_deviation_scene(const SceneFile& file)
{
  if (file.reading() != "exchanged")
    throw BadInput("--reading " + file.reading() +
                   ": must be exchanged; the deviations compare both readings (D-09)");
  return {file};
}

PeriodicMotion require_periodic(const BalanceSearch& search)
{
  const PeriodicMotion solution = motion::find_periodic(search);
  if (!solution.found())
    throw NoSolution(format("%s: %d harmonics at %g Hz: %s",
                            search.parameters.file.c_str(), search.harmonics,
                            search.omega / angular(1), solution.newton.reason().c_str()));
  return solution;
}

motion::Motion DeviationScene::integrated(double frequency) const
{
  const SteadyState steady = settled(machine, frequency);
  if (!steady.periodic)
    throw NoSolution(format("the motion at %g Hz is not T-periodic (spread %.2g)",
                            frequency, steady.spread));
  return motion_of(steady);
}

EvidenceList spread_of(const std::string& key, const SteadyState& steady,
                       const std::string& meaning)
{
  return {
      {key, steady.spread, "-", meaning},
      {key + "_error", steady.spread_error, "-", "its standard error, 0 if T-periodic"}};
}

EvidenceList mean_of(const std::string& key, const std::string& meaning,
                     const motion::Motion& motion, int periods,
                     const std::function<double(const motion::Motion&)>& measure)
{
  const BatchMean mean = motion::mean_over(motion, periods, measure);
  return {{key, mean.value, "-", meaning},
          {key + "_error", mean.error, "-", "its standard error over the turns"}};
}

EvidenceList contact_of(const std::string& key, const std::string& meaning,
                        const Parameters& machine, const motion::Motion& motion)
{
  return mean_of(key, meaning, motion, 1, [&](const motion::Motion& turn) {
    return motion::contact_share(machine, turn);
  });
}

}  // namespace rotor_stator::deviations
