/**
# Figures of what explore computed

Drawn by a script of the folder figures, in the source tree or installed, with Matplotlib.
 */
#pragma once

#include "explore/request.hpp"

namespace rotor_stator::explore {

/** Asked before the work. Throws BadInput unless the suffix of `file`, the value of
    --plot, is .svg, .png or .pdf, and Python with Matplotlib can run `script`, of the
    folder figures in the source tree or installed. */
void require_plot(const std::string& file, const std::string& script);

/** Draws a table by `script` into `file`, with the measured table `overlay` if there is
    one, all or nothing; returns why it could not, empty otherwise. */
std::string plot(const std::string& file, const std::string& script,
                 const std::string& table, const File& overlay);

}  // namespace rotor_stator::explore
