/**
# Normalised derivatives with respect to what the paper leaves out

Run: build/sensitivity_derivatives > data/generated/sensitivity_derivatives.tsv
By what power of an unpublished parameter each output changes at the defaults: 0 says that
the paper could leave it out. Modelled: the scene of sensitivity.cpp next to the defaults
alone. */
#include "io/program.hpp"
#include "studies/sensitivity.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{
      .scene_file = "data/scenes/sensitivity.toml",
      .options = {{"--sensitivity", "data/reference/sensitivity.tsv", "their table"}}};
  return run_figure(argc, argv, program, [](SceneFile& file, const Options& options) {
    const studies::SensitivityScene scene = studies::read_sensitivity_scene(file);
    const auto points = studies::read_sensitivity(scene, options["--sensitivity"]);
    return studies::derivative_table(scene, studies::normalised_derivatives(points));
  });
}
