#include "io/output_file.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

std::string folder_of(const std::string& file)
{
  const std::string folder = std::filesystem::path(file).parent_path();
  return folder.empty() ? "." : folder;
}

bool is_same(const struct stat& a, const struct stat& b)
{
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/** How the files of an option begin. */
constexpr std::pair<const char*, const char*> beginnings[] = {
    {"--plot", "<?xml"},
    {"--plot", "\x89PNG"},
    {"--plot", "%PDF"},
    {"--to", "%%MatrixMarket"},
    {"--save", "# Branch of harmonic balance\n"},
    {"--waterfall", "# Lines of "},
    {"--section", "# Poincare sections "},
    {"--motions", "# Motions on the attractors\n"}};

/** Whether this program wrote a file of the kind that an option asks for. */
bool is_own(const std::string& file, const std::string& option)
{
  std::ifstream in(file, std::ios::binary);
  std::string ends(4000, ' ');  // of a PDF the last lines say so
  in.read(ends.data(), 2000);
  const auto begun = static_cast<std::size_t>(in.gcount());
  in.clear();
  if (begun == 2000 && in.seekg(-2000, std::ios::end)) in.read(&ends[2000], 2000);
  const bool is_of_kind = std::ranges::any_of(beginnings, [&](const auto& kind) {
    return kind.first == option && ends.starts_with(kind.second);
  });
  const bool is_table = ends.starts_with("# ");
  const char* const writer = is_table ? "\n# source: rotor_stator" : "rotor_stator";
  return is_of_kind && ends.find(writer) != ends.npos;
}

std::array<std::atomic<const char*>, 16> temporaries;

/** By calls that a handler of signals may make. */
void remove_now(const char* name)
{
  if (unlink(name) != 0) rmdir(name);
}

extern "C" void remove_all_and_end(int signal)
{
  for (auto one = temporaries.rbegin(); one != temporaries.rend(); ++one)
    if (const char* name = *one) remove_now(name);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

Temporary::Temporary(std::string name) : name_(std::move(name))
{
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, remove_all_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);
  for (auto& place : temporaries)
    if (const char* none = nullptr; place.compare_exchange_strong(none, name_.c_str()))
      break;
}

Temporary::~Temporary()
{
  remove_now(name_.c_str());
  for (auto& place : temporaries)
    if (place == name_.c_str()) place = nullptr;
}

void require_plain_name(const std::string& name)
{
  for (std::size_t k = 0, length = 1; k < name.size(); k += length) {
    const auto is_inner = [](char c) { return (c & 0xc0) == 0x80; };
    const auto first = static_cast<unsigned char>(name[k]);
    length = std::max(1, std::countl_one(first));
    const std::string letter = name.substr(k, length);
    const bool is_whole = letter.size() == length && length <= 4 &&
                          !is_inner(letter[0]) &&
                          std::all_of(letter.begin() + 1, letter.end(), is_inner);
    if (!is_whole || printable(letter) != letter)
      throw BadInput("'" + name.substr(0, k) + format("\\x%02x...': ", first) +
                     "names of files hold neither control characters nor bytes that are "
                     "no UTF-8");
  }
}

bool is_same_file(const std::string& a, const std::string& b)
{
  struct stat of_a, of_b;
  const bool is_there = stat(a.c_str(), &of_a) == 0;
  if (is_there != (stat(b.c_str(), &of_b) == 0)) return false;
  if (is_there) return is_same(of_a, of_b);
  return std::filesystem::path(a).filename() == std::filesystem::path(b).filename() &&
         stat(folder_of(a).c_str(), &of_a) == 0 &&
         stat(folder_of(b).c_str(), &of_b) == 0 && is_same(of_a, of_b);
}

void require_writable(const std::string& option, const std::string& file,
                      const std::vector<std::string>& inputs, bool is_forced)
{
  const auto refuse = [&](const std::string& why) {
    throw BadInput(option + " '" + file + "': " + why);
  };
  if (file.empty()) refuse("the name is empty");
  if (access(folder_of(file).c_str(), W_OK | X_OK) != 0)
    refuse(errno == ENOENT || errno == ENOTDIR ? "its folder does not exist"
                                               : "its folder cannot be written to");
  struct stat known, other;
  if (lstat(file.c_str(), &known) != 0)
    return errno == ENOENT ? void() : refuse(std::strerror(errno));
  if (!S_ISREG(known.st_mode))
    refuse(S_ISDIR(known.st_mode)   ? "is a directory; a file is expected"
           : S_ISLNK(known.st_mode) ? "is a symbolic link; a file is expected"
                                    : "is no regular file");
  for (const std::string& input : inputs)
    if (is_same_file(file, input)) refuse("is the input " + input);
  if (fstat(STDOUT_FILENO, &other) == 0 && is_same(known, other))
    refuse("is the standard output");
  if (is_forced) return;
  if (access(file.c_str(), W_OK) != 0) refuse("is write-protected; --force replaces it");
  if (known.st_size > 0 && !is_own(file, option))
    refuse("is no file of " + option + " that this program wrote; --force replaces it");
}

void write_files(const std::vector<NamedContent>& files)
{
  std::deque<Temporary> unfinished;
  const mode_t mask = umask(0);
  umask(mask);
  const auto check = [](bool done, const std::string& file) {
    if (!done) throw NoSolution(file + ": cannot be written: " + std::strerror(errno));
  };
  for (const auto& [file, content] : files) {
    std::string name = folder_of(file) + "/.unfinished-XXXXXX";
    const int descriptor = mkstemp(name.data());
    check(descriptor >= 0, file);
    unfinished.emplace_back(name);
    std::FILE* const out = fdopen(descriptor, "wb");
    struct stat old;
    const bool is_there = stat(file.c_str(), &old) == 0;
    const bool done =
        out && fchmod(descriptor, is_there ? old.st_mode & 0777 : 0666 & ~mask) == 0 &&
        std::fwrite(content.data(), 1, content.size(), out) == content.size() &&
        std::fflush(out) == 0 && fsync(descriptor) == 0;
    const int error = errno;
    if (out) std::fclose(out);
    errno = error;
    check(done, file);
  }
  for (std::size_t k = 0; k < files.size(); ++k)
    check(rename(unfinished[k].name().c_str(), files[k].name.c_str()) == 0,
          files[k].name);
}

void write(const std::string& text)
{
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw NoSolution("the standard output cannot be written to");
}

}  // namespace rotor_stator
