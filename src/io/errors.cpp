#include "io/errors.hpp"

#include <cstdarg>
#include <cstdio>

namespace rotor_stator
{

std::string format(const char* pattern, ...)
{
  std::va_list arguments;
  va_start(arguments, pattern);
  std::va_list copy;
  va_copy(copy, arguments);
  std::string result(std::vsnprintf(nullptr, 0, pattern, copy), '\0');
  va_end(copy);
  std::vsnprintf(result.data(), result.size() + 1, pattern, arguments);
  va_end(arguments);
  return result;
}

}  // namespace rotor_stator
