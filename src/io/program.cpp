#include "io/program.hpp"

#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <new>

#include "io/errors.hpp"

namespace rotor_stator
{

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), watched_(isatty(STDERR_FILENO) == 1)
{
}

Progress::~Progress()
{
  if (watched_ && done_ > 0) std::fputc('\n', stderr);
}

void Progress::step()
{
  ++done_;
  if (watched_) std::fprintf(stderr, "\r%s: %zu of %zu", what_.c_str(), done_, total_);
}

namespace
{

/** One line on stderr, whatever the message holds. */
int complain(std::string message, int status)
{
  for (char& c : message)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  std::fprintf(stderr, "%s\n", message.c_str());
  return status;
}

}  // namespace

int guarded(const std::function<int()>& work)
{
  try {
    return work();
  } catch (const BadInput& error) {
    return complain(error.what(), 2);
  } catch (const NoSolution& error) {
    return complain(error.what(), 3);
  } catch (const std::bad_alloc&) {
    return complain("out of memory: ask for fewer harmonics, samples or points", 3);
  }
}

bool parse(CLI::App& app, int argc, char** argv)
{
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw BadInput(error.what());
    app.exit(error);
    return false;
  }
}

void write(const std::string& text)
{
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw NoSolution("the table could not be written to stdout");
}

const std::string& Options::operator[](const std::string& name) const
{
  return std::find_if(others.begin(), others.end(),
                      [&](const ExtraOption& option) { return option.name == name; })
      ->value;
}

int whole_number(const std::string& option, const std::string& value, int least, int most)
{
  int number = 0;
  const char* const end = value.data() + value.size();
  const auto [rest, error] = std::from_chars(value.data(), end, number);
  if (error != std::errc() || rest != end || number < least || number > most)
    throw BadInput(format("%s %s: must be a whole number from %d to %d", option.c_str(),
                          value.c_str(), least, most));
  return number;
}

int run(int argc, char** argv, const Program& program,
        const std::function<Table(const Options&)>& compute)
{
  Options options{program.scene_file, "exchanged", program.options};
  CLI::App app("Computes one table; TSV on stdout.");
  app.add_option("scene", options.scene_file, "scene file")->capture_default_str();
  if (program.has_readings)
    app.add_option("--reading", options.reading,
                   "reading of Table 1: exchanged or as-printed")
        ->capture_default_str();
  for (ExtraOption& option : options.others)
    app.add_option(option.name, option.value, option.meaning)->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(compute(options).text());
    return 0;
  });
}

int run_figure(int argc, char** argv, const std::function<Table(SceneFile&)>& compute)
{
  const std::string name = std::filesystem::path(argv[0]).filename();
  return run(argc, argv, {"data/scenes/" + name + ".toml"}, [&](const Options& options) {
    SceneFile scene(options.scene_file, options.reading);
    return compute(scene);
  });
}

}  // namespace rotor_stator
