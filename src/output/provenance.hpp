/**
# Where a table comes from

Stamped when the library is compiled. A new commit alone triggers no rebuild. */
#pragma once

#include <string>

namespace rotor_stator
{

/** Name and version of the project and the revision of its source, with "-dirty" after
    uncommitted changes; "unknown" outside git. */
std::string source_revision();

/** Compiler, version and flags. */
std::string compiler();

}  // namespace rotor_stator
