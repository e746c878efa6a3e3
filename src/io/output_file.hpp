/** # Files that a user names for output

A file is checked before anything is computed, so that no long run ends at a name that
cannot be written. */
#pragma once

#include <string>
#include <vector>

namespace rotor_stator {

/** Throws BadInput unless `file`, the value of `option`, can be written to: a regular
    file or none yet, in a folder that is there, and neither one of `inputs` nor the
    standard output. Asked before the work. */
void require_writable(const std::string& option, const std::string& file,
                      const std::vector<std::string>& inputs);

/** Writes `content` to `file`, all or nothing: beside it, then renamed. Throws NoSolution
    when it cannot. */
void write_file(const std::string& file, const std::string& content);

/** Writes all of `text` to stdout. Throws NoSolution when it cannot (a full disk, a
    closed pipe). */
void write(const std::string& text);

}  // namespace rotor_stator
