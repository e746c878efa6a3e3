/**
# Random questions to explore

One seed gives one case: the bytes of a parameter file and the options. Most cases are a good file and
good options with a few things wrong, since pure noise never gets past the first check; the others
are legal and extreme. */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rotor_stator::tests
{

struct FuzzCase {
  std::string file;                    ///< content of machine.toml
  std::vector<std::string> arguments;  ///< program and options

  /** The command line, for a person to repeat it. */
  std::string command() const;
};

/** What is wrong: the file, the options, or nothing (legal and extreme). */
enum class Fuzz { file, options, extreme };

/** The case of a seed, bounded to `work` (the option --budget) if that is not empty. The same on every
    machine. */
FuzzCase fuzz_case(std::uint64_t seed, Fuzz kind, const std::string& work);

}  // namespace rotor_stator::tests
