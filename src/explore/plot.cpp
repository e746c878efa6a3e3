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

std::string temporary_folder()
{
  std::error_code error;
  const path parent = std::filesystem::temp_directory_path(error);
  std::string name = parent / "rotor_stator_XXXXXX";
  if (error || !mkdtemp(name.data()))
    throw BadInput("--plot: no temporary folder; TMPDIR names a place for it");
  return name;
}

/** Status 0 where both can be imported; to import them takes ten times as long. */
const std::string has_modules =
    "import sys; from importlib.util import find_spec; "
    "sys.exit(not (find_spec('matplotlib') and find_spec('numpy')))";
/** Before the modules of scripts: none comes from the reader's folder or settings. */
const std::string isolated =
    "import os, runpy, sys; os.environ['MPLBACKEND'] = 'svg'; import matplotlib, numpy; ";
const std::string run_script =
    "sys.argv = sys.argv[1:]; sys.path.insert(0, os.path.dirname(sys.argv[0])); "
    "runpy.run_path(sys.argv[0], run_name='__main__')";

/** Runs Python; whether it ended well. What it writes goes to `log`. */
bool run_python(const std::vector<std::string>& arguments, const std::string& log)
{
  std::vector<std::string> words{python(), "-I", "-B", "-c"};
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

void require_plot(const std::string& file, const std::string& script)
{
  const std::string suffix = path(file).extension();
  if (suffix != ".svg" && suffix != ".png" && suffix != ".pdf")
    throw BadInput("--plot '" + file + "': must end in .svg, .png or .pdf");
  script_file(script);
  const Temporary folder(temporary_folder());  // that there can be one
  if (!run_python({has_modules}, "/dev/null"))
    throw BadInput("--plot: needs Matplotlib in " + python() +
                   ": install python3-matplotlib, or name another Python in PYTHON");
}

std::string plot(const std::string& file, const std::string& script,
                 const std::string& table, const File& overlay)
try {
  const Temporary folder(temporary_folder()), log(folder.name() + "/log"),
      drawn(folder.name() + "/table.tsv"),
      figure(folder.name() + "/figure" + std::string(path(file).extension()));
  write_files({{drawn.name(), table}});
  std::vector<std::string> words{isolated + run_script, script_file(script), drawn.name(),
                                 figure.name()};
  if (overlay) words.push_back(*overlay);
  if (run_python(words, log.name())) {
    write_files({{file, content_of(figure.name())}});
    return "";
  }
  std::string why = content_of(log.name());
  while (!why.empty() && why.back() == '\n') why.pop_back();
  if (why.empty()) why = "ended without a word";
  return "--plot: " + script + ": " + printable(why.substr(why.rfind('\n') + 1));
} catch (const NoSolution& error) {
  return error.what();
}

}  // namespace rotor_stator::explore
