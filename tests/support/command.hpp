/**
# Running a program of the project and keeping what it printed */
#pragma once

#include <filesystem>
#include <string>

namespace rotor_stator::tests {

struct Outcome {
  int status;
  std::string out, err;
};

/** Runs `arguments` (program name first, relative to the build folder) in the project's
    root. */
Outcome run_program(const std::string& arguments);

/** A folder of its own for each use, removed at the end. */
class Scratch {
public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const;

private:
  std::filesystem::path folder_;
};

std::string read_whole(const std::string& file);

}  // namespace rotor_stator::tests
