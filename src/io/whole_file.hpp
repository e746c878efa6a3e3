/** # Files that a user names for output */
#pragma once

#include <string>

namespace rotor_stator
{

/** Throws BadInput unless `file` can be a file in a folder that is there: asked before the work. */
void require_writable(const std::string& file);

/** Writes `content` to `file`, all or nothing. Throws BadInput when it cannot. */
void write_file(const std::string& file, const std::string& content);

}  // namespace rotor_stator
