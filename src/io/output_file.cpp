#include "io/output_file.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
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
  std::string unfinished =
      std::filesystem::absolute(file).parent_path() / ".unfinished-XXXXXX";
  const int descriptor = mkstemp(unfinished.data());
  std::FILE* const out = descriptor < 0 ? nullptr : fdopen(descriptor, "wb");
  const mode_t mask = umask(0);
  umask(mask);
  struct stat old;
  const bool is_there = stat(file.c_str(), &old) == 0;
  const bool done =
      out && fchmod(descriptor, is_there ? old.st_mode & 0777 : 0666 & ~mask) == 0 &&
      std::fwrite(content.data(), 1, content.size(), out) == content.size() &&
      std::fflush(out) == 0 && fsync(descriptor) == 0 &&
      rename(unfinished.c_str(), file.c_str()) == 0;
  const int error = errno;
  if (out) std::fclose(out);
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
