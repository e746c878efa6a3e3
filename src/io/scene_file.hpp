/**
# Scene files

A scene is what one figure asks to be modelled: which data sets, which speeds, how many
harmonics and samples, how the time integration is set. It is a TOML file in data/scenes/,
checked like the parameters. */
#pragma once

#include "io/toml_file.hpp"

namespace rotor_stator {

/** A scene file being read, with the reading of Table 1 (D-09): "exchanged" or
    "as-printed". */
class SceneFile {
public:
  SceneFile(const std::string& file, const std::string& reading);

  StrictToml& toml() { return toml_; }
  const std::string& reading() const { return reading_; }

  /** The file of the data set named by a key: "set1" is data/set1.toml beside the scenes'
      folder, or data/set1-as-printed.toml under that reading. */
  std::string data_set(const std::string& key);
  std::vector<std::string> data_sets(const std::string& key);

  /** `from`, `to` and `step` in hertz, both ends included. */
  std::vector<double> speed_range(const std::string& key);

private:
  std::string file_of(const std::string& name);

  std::string file_, reading_;
  StrictToml toml_;
};

}  // namespace rotor_stator
