#include "io/errors.hpp"

#include <cstdarg>
#include <cstdio>

namespace rotor_stator
{

std::string text(const char* format, ...)
{
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list copy;
  va_copy(copy, arguments);
  std::string result(std::vsnprintf(nullptr, 0, format, copy), '\0');
  va_end(copy);
  std::vsnprintf(result.data(), result.size() + 1, format, arguments);
  va_end(arguments);
  return result;
}

}  // namespace rotor_stator
