#include "model/plain_file.hpp"

#include <filesystem>

#include "model/errors.hpp"

namespace rotor_stator
{

void require_plain_file(const std::string& file, const std::string& expected)
{
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) throw BadInput(file + ": no such file");
  if (!std::filesystem::is_regular_file(status))
    throw BadInput(file + ": is " +
                   (is_directory(status) ? "a directory" : "no plain file") + "; " +
                   expected + " is expected");
}

}  // namespace rotor_stator
