#include "support/command.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace rotor_stator::tests {

Outcome run_program(const std::string& arguments)
{
  const Scratch scratch;
  const auto end_of_name = std::min(arguments.find(' '), arguments.size());
  const std::string command = "cd '" SOURCE_DIR "' && '" PROGRAM_DIR "/" +
                              arguments.substr(0, end_of_name) + "'" +
                              arguments.substr(end_of_name) + " > '" +
                              scratch.path("out") + "' 2> '" + scratch.path("err") + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_whole(scratch.path("out")),
          read_whole(scratch.path("err"))};
}

Scratch::Scratch()
{
  std::string name =
      (std::filesystem::temp_directory_path() / "rotor_stator_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

Scratch::~Scratch()
{
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string Scratch::write(const std::string& name, const std::string& content) const
{
  std::ofstream(path(name)) << content;
  return path(name);
}

std::string read_whole(const std::string& file)
{
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

}  // namespace rotor_stator::tests
