/**
# The tables of the figures

One function per kind of scene: columns with units, what was modelled, then the rows. */
#pragma once

#include "output/table.hpp"
#include "scenes/contact.hpp"
#include "scenes/geometry.hpp"
#include "scenes/orbits.hpp"
#include "scenes/response.hpp"
#include "scenes/timing.hpp"

namespace rotor_stator
{

/** Figs 1 and 2. */
Table geometry_table(const GeometryScene& scene);

/** Fig. 3. */
Table response_table(const ResponseScene& scene);

/** Figs 4, 5, 6 and 8. */
Table orbit_table(const OrbitScene& scene);

/** Figs 7 and 9. */
Table contact_table(const OrbitScene& scene);

/** Table 1, for the data sets of the scene. */
Table parameter_table(const std::string& scene_file, const std::string& reading);

/** The timing table. */
Table timing_table(const TimingScene& scene);

}  // namespace rotor_stator
