#include "io/whole_file.hpp"

#include <filesystem>
#include <fstream>

#include "io/errors.hpp"

namespace rotor_stator
{

void require_writable(const std::string& file)
{
  const auto folder = std::filesystem::absolute(file).parent_path();
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw BadInput(file + ": its folder does not exist");
  if (std::filesystem::is_directory(file, ignored))
    throw BadInput(file + ": is a directory; a file is expected");
}

void write_file(const std::string& file, const std::string& content)
{
  const std::string unfinished = file + ".tmp";
  std::ofstream out(unfinished, std::ios::binary);
  out << content;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(unfinished, file, error);
  if (!out || error) throw BadInput(file + ": cannot be written");
}

}  // namespace rotor_stator
