#include "explore/plot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/errors.hpp"
#include "io/output_file.hpp"

namespace rotor_stator::explore {

namespace {

using std::filesystem::path;

/** Beside the program: in the source tree, whose folders of builds stand beside figures,
    or installed. */
path script_file(const std::string& script)
{
  std::error_code error;
  const path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const path above = program.parent_path().parent_path();
  for (const char* folder : {"figures", "share/rotor_stator/figures"})
    if (std::filesystem::is_regular_file(above / folder / script, error))
      return above / folder / script;
  throw BadInput("--plot: no figures/" + script +
                 " beside the program; cmake --install copies it");
}

std::string python()
{
  const char* chosen = std::getenv("PYTHON");
  return chosen && *chosen ? chosen : "/usr/bin/python3";
}

std::string content_of(const path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/** A folder that is removed with all that is in it. */
struct TemporaryFolder {
  path folder;

  TemporaryFolder()
  {
    std::string name = std::filesystem::temp_directory_path() / "rotor_stator_XXXXXX";
    if (!mkdtemp(name.data())) throw NoSolution("--plot: no temporary folder: " + name);
    folder = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
};

/** Runs Python; whether it ended well. What it writes goes to `log`. */
bool run_python(const std::vector<std::string>& arguments, const path& log)
{
  std::vector<std::string> words{python(), "-B"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const bool begun =
      posix_spawnp(&child, argv[0], &files, nullptr, argv.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&files);
  int status = 1;
  return begun && waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace

void require_plot(const std::string& file, const std::string& script,
                  const std::vector<std::string>& inputs)
{
  const std::string suffix = path(file).extension();
  if (suffix != ".svg" && suffix != ".png" && suffix != ".pdf")
    throw BadInput("--plot '" + file + "': must end in .svg, .png or .pdf");
  require_writable("--plot", file, inputs);
  script_file(script);
  const TemporaryFolder temporary;
  if (!run_python({"-c", "import matplotlib, numpy"}, temporary.folder / "log"))
    throw BadInput("--plot: needs Matplotlib in " + python() +
                   ": install python3-matplotlib, or name another Python in PYTHON");
}

std::string plot(const std::string& file, const std::string& script,
                 const std::string& table, const std::optional<std::string>& overlay)
try {
  const TemporaryFolder temporary;
  const path log = temporary.folder / "log", data = temporary.folder / "table.tsv";
  const path figure =
      (temporary.folder / "figure").concat(path(file).extension().string());
  write_file(data, table);
  std::vector<std::string> words{script_file(script), data, figure};
  if (overlay) words.push_back(*overlay);
  if (run_python(words, log)) {
    write_file(file, content_of(figure));
    return "";
  }
  std::string why = content_of(log);
  while (!why.empty() && why.back() == '\n') why.pop_back();
  return "--plot: " + script + ": " + printable(why.substr(why.rfind('\n') + 1));
} catch (const NoSolution& error) {
  return error.what();
}

}  // namespace rotor_stator::explore
