#include "io/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/errors.hpp"

namespace rotor_stator {

void require_writable(const std::string& option, const std::string& file,
                      const std::vector<std::string>& inputs)
{
  const auto refuse = [&](const std::string& why) {
    throw BadInput(option + " '" + file + "': " + why);
  };
  if (file.empty()) refuse("the name is empty");
  const auto folder = std::filesystem::absolute(file).parent_path();
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    refuse(errno == ENOENT || errno == ENOTDIR ? "its folder does not exist"
                                               : "its folder cannot be written to");
  struct stat known, other;
  if (lstat(file.c_str(), &known) != 0) return;
  if (!S_ISREG(known.st_mode))
    refuse(S_ISDIR(known.st_mode)   ? "is a directory; a file is expected"
           : S_ISLNK(known.st_mode) ? "is a symbolic link; a file is expected"
                                    : "is no regular file");
  const auto is_same = [&](int found) {
    return found == 0 && other.st_dev == known.st_dev && other.st_ino == known.st_ino;
  };
  for (const std::string& input : inputs)
    if (is_same(stat(input.c_str(), &other))) refuse("is the input " + input);
  if (is_same(fstat(STDOUT_FILENO, &other))) refuse("is the standard output");
}

void write_file(const std::string& file, const std::string& content)
{
  const auto folder = std::filesystem::absolute(file).parent_path();
  std::filesystem::path unfinished;
  int descriptor = -1;
  for (int k = 0; descriptor < 0 && k < 1000 && (k == 0 || errno == EEXIST); ++k) {
    unfinished =
        folder / format(".unfinished-%ld-%d.tmp", static_cast<long>(getpid()), k);
    descriptor = open(unfinished.c_str(),
                      O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  }
  bool done = descriptor >= 0;
  struct stat old;
  if (done && stat(file.c_str(), &old) == 0)
    done = fchmod(descriptor, old.st_mode & 0777) == 0;
  for (std::size_t k = 0; done && k < content.size();) {
    const ssize_t more = ::write(descriptor, content.data() + k, content.size() - k);
    done = more > 0;
    k += done ? static_cast<std::size_t>(more) : 0;
  }
  done = done && fsync(descriptor) == 0 && rename(unfinished.c_str(), file.c_str()) == 0;
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (done) return;
  if (descriptor >= 0) unlink(unfinished.c_str());
  throw NoSolution(file + ": cannot be written: " + std::strerror(error));
}

void write(const std::string& text)
{
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw NoSolution("the standard output cannot be written to");
}

}  // namespace rotor_stator
