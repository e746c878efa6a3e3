/**
# Settings of the timed methods, and those that a search tries

A scene file has a table for each method with the values of its settings. They come in groups: one
accuracy each, within it the cheaper ones first, so that a search can stop early. */
#pragma once

#include <string>
#include <vector>

#include "io/toml_file.hpp"

namespace rotor_stator::costs {

/** One method at one setting; zero where the method has no such setting.

- *aft*: harmonic balance. The number of harmonics is the same at all speeds, or falls with the speed. Each
  speed starts from the ones before, or from a transient.
- *aft-tolerance*: orders and samples chosen and their error estimated, as by `explore response --tolerance`.
- *rk4* (fixed step), GSL's steppers: time integration.
- *shooting-rk4*, *shooting-rk8pd*, …: Newton's method on the period map. */
struct Setting {
  std::string method;
  int harmonics = 0;             ///< aft: m, the least where `corner` asks for more
  double corner = 0;             ///< aft: m f is at least this [Hz]
  int samples_per_harmonic = 0;  ///< aft: N is a fast size above this times m
  int samples = 0;               ///< aft: N itself, instead
  std::string algebra =
      {};  ///< aft: "dense" factors; "whole": as everywhere, but all harmonics at once
  bool paper_sweep = false;  ///< aft: the paper's continuation, continuation/sweep.hpp
  double tolerance =
      0;            ///< aft: Newton's; aft-tolerance: the one asked for; GSL: local error
  double step = 0;  ///< rk4 [s]
  double transient = 0;             ///< at each speed [s]; of aft, that of its start
  int recorded = 0;                 ///< time integration: intervals of a last period
  double periodicity_residual = 0;  ///< shooting; "closure" in files [-]

  bool is_shooting() const { return method.starts_with("shooting-"); }

  /** "m=6 N>4m tol=1e-07". */
  std::string text() const;
};

/** Number of harmonics and samples of an aft setting at a speed [Hz]. */
int harmonics_at(const Setting& setting, double frequency);
int samples_for(const Setting& setting, int harmonics);

/** Settings of one method with the same accuracy, cheapest first. */
using SettingGroup = std::vector<Setting>;

struct Candidates {
  std::string method;
  std::vector<SettingGroup> groups;
};

/** The tables of `toml` that are named in its key "methods", in that order. Throws BadInput. */
std::vector<Candidates> read_candidates(StrictToml& toml);

}  // namespace rotor_stator::costs
