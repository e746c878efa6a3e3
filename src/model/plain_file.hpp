/**
# Files that a user names for input */
#pragma once

#include <string>

namespace rotor_stator
{

/** Throws BadInput, naming what is `expected`, unless `file` is a plain file: devices and pipes may never
    end. */
void require_plain_file(const std::string& file, const std::string& expected);

}  // namespace rotor_stator
