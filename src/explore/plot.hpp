/**
# Figures of what explore computed

Drawn by a script of the folder figures, in the source tree or installed, with Matplotlib.
*/
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rotor_stator::explore {

/** Asked before the work. Throws BadInput unless `file`, the value of --plot, can be
    written to (`require_writable`), its suffix is .svg, .png or .pdf, and Python with
    Matplotlib can run `script`. */
void require_plot(const std::string& file, const std::string& script,
                  const std::vector<std::string>& inputs);

/** Draws a table by `script` into `file`, with the measured table `overlay` if there is
    one, all or nothing; returns why it could not, empty otherwise. */
std::string plot(const std::string& file, const std::string& script,
                 const std::string& table,
                 const std::optional<std::string>& overlay = {});

}  // namespace rotor_stator::explore
