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
  return run(argc, argv, {"data/scenes/sensitivity.toml"}, [](const Options& options) {
    return studies::sensitivity_derivative_table(near_defaults(
        studies::read_sensitivity_scene(options.scene_file, options.reading)));
  });
}
