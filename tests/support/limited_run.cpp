#include "support/limited_run.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "support/command.hpp"

namespace rotor_stator::tests
{

namespace
{

/** A process that waits instead of working is ended after this long [s]. */
constexpr unsigned longest_wait = 120;

/** In the child: only calls that are safe after a fork. */
[[noreturn]] void become(char* const* argv, const char* folder, int cpu_seconds)
{
  const rlimit seconds{static_cast<rlim_t>(cpu_seconds),
                       static_cast<rlim_t>(cpu_seconds + 1)};
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CPU, &seconds);
  setrlimit(RLIMIT_CORE, &no_core);
  alarm(longest_wait);
  if (chdir(folder) != 0) _exit(126);
  const int out = open("out", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err = open("err", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int in = open("/dev/null", O_RDONLY);
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  execv(argv[0], argv);
  _exit(127);
}

}  // namespace

LimitedOutcome run_limited(const std::vector<std::string>& arguments,
                           const std::string& folder, int cpu_seconds)
{
  std::vector<std::string> words = arguments;
  words.front() = PROGRAM_DIR "/" + words.front();
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no new process");
  if (child == 0) become(argv.data(), folder.c_str(), cpu_seconds);
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("lost a process");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          WIFSIGNALED(status) ? WTERMSIG(status) : 0, read_whole(folder + "/out"),
          read_whole(folder + "/err")};
}

}  // namespace rotor_stator::tests
