/**
# The options of explore

Those of each command, read into its request. */
#pragma once

#include "explore/attractors.hpp"
#include "explore/campbell.hpp"
#include "explore/check.hpp"
#include "explore/map.hpp"
#include "explore/response.hpp"
#include "explore/runup.hpp"
#include "explore/shaft.hpp"
#include "explore/shape.hpp"

namespace CLI {
class App;
}

namespace rotor_stator::explore {

/** Reads the options of a command into its request. What is returned throws BadInput for
    options that do not belong together, once they are parsed. */
using Check = std::function<void()>;
Check add_options(CLI::App& command, CheckRequest& request);
Check add_options(CLI::App& command, MotionRequest& request);
Check add_options(CLI::App& command, ResponseRequest& request);
Check add_options(CLI::App& command, AttractorsRequest& request);
Check add_options(CLI::App& command, RunUpRequest& request);
Check add_options(CLI::App& command, MapRequest& request);
Check add_options(CLI::App& command, ShaftRequest& request);
Check add_options(CLI::App& command, ShapeRequest& request);
Check add_options(CLI::App& command, CampbellRequest& request);

}  // namespace rotor_stator::explore
