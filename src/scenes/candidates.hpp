/**
# Settings to be tried

A table of a scene file for each method, with the values of its settings. They come in
groups: one accuracy each, within it the cheaper ones first, so that a search can stop
early. */
#pragma once

#include "model/strict_toml.hpp"
#include "scenes/contender.hpp"

namespace rotor_stator
{

/** Settings of one method with the same accuracy, cheapest first. */
using SettingGroup = std::vector<Setting>;

struct Candidates {
  std::string method;
  std::vector<SettingGroup> groups;
};

/** The tables of `toml` that are named in its key "methods", in that order. Throws BadInput. */
std::vector<Candidates> read_candidates(StrictToml& toml);

}  // namespace rotor_stator
