#include "output/sampling_table.hpp"

#include "balance/fourier_transform.hpp"
#include "model/errors.hpp"

namespace rotor_stator
{

Table sampling_table(const SamplingScene& scene)
{
  Table table(
      "Error of sampling the force, against the error of truncating the series",
      {{"panel", "-", "number of the machine and speed"},
       {"f", "Hz", "speed of rotation"},
       {"m", "-", "harmonics"},
       {"samples_over_m", "-", "N is the next fast size from this times m, plus one"},
       {"N", "-", "samples per period"},
       {"default", "-", "1 if this is the default N of that m"},
       {"found", "-", "1 if Newton converged with this N"},
       {"sampling", "-",
        "displacement error against the same m finely sampled; 0 if not found"},
       {"sampling_force", "-", "the same of the bearing's force"},
       {"truncation", "-",
        "displacement error of that m, finely sampled, against the reference"},
       {"truncation_force", "-", "the same of the bearing's force"}});
  for (std::size_t k = 0; k < scene.machines.size(); ++k) {
    table.describe(scene.machines[k]);
    table.note(text("panel %zu: %s at %g Hz", k + 1, scene.machines[k].title.c_str(),
                    scene.frequencies[k]));
  }
  table.note(
      text("modelled: harmonic balance; finely sampled: N = %d m; reference: m = %d",
           scene.fine_over_m, scene.reference_harmonics));
  for (const SamplingPoint& p : compute_sampling(scene))
    table.row({p.machine + 1, scene.frequencies[p.machine], p.harmonics, p.samples_over_m,
               p.samples, p.samples == default_samples(p.harmonics), p.found,
               p.sampling.displacement, p.sampling.force, p.truncation.displacement,
               p.truncation.force});
  return table;
}

}  // namespace rotor_stator
