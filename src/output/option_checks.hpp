/** # Options in their range

Each throws BadInput with the option, its value and what is accepted. */
#pragma once

#include <optional>
#include <string>

namespace rotor_stator
{

void require_positive(const char* option, double value);
void require_between(const char* option, double value, double least, double most);
void require_range(const char* option, int value, int least, int most);

/** N as asked for, or the default for m; both checked. */
int checked_samples(int harmonics, const std::optional<int>& samples);

}  // namespace rotor_stator
