#include "io/program.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>

#include "io/errors.hpp"
#include "io/output_file.hpp"

namespace rotor_stator {

namespace {

/** One line on stderr, whatever the message holds. */
int complain(const std::string& message, int status)
{
  std::fprintf(stderr, "%s\n", printable(message).c_str());
  return status;
}

/** What is said of the first argument that nothing expects; empty when there is none. */
std::string unexpected(const CLI::App& app)
{
  const auto left = app.remaining(true);
  if (left.empty()) return "";
  const std::string word = left.front().substr(0, left.front().find('='));
  /** What others call a speed and a number of speeds. */
  constexpr std::pair<const char*, const char*> instead[]{
      {"--rpm", "--frequency"}, {"--speed", "--frequency"}, {"--frequency", "--from"},
      {"--rpm", "--from"},      {"--speed", "--from"},      {"--step", "--count"}};
  std::vector<std::string> known;
  const auto chosen = app.get_subcommands();
  for (const CLI::Option* option : (chosen.empty() ? app : *chosen.back()).get_options())
    known.push_back(option->get_name());
  std::vector<std::string> commands;
  if (chosen.empty())
    for (const CLI::App* command : app.get_subcommands({}))
      commands.push_back(command->get_name());
  known.insert(known.end(), commands.begin(), commands.end());
  if (std::ranges::find(known, word) != known.end())
    return word + ": stands before the command; options come after it";
  for (const auto& [other, own] : instead)
    if (word == other && std::ranges::find(known, own) != known.end())
      return word + ": not expected; did you mean " + own +
             (own == std::string("--count") ? "?" : " 1500rpm?");
  return word + ": not expected" + suggestion(word, known) +
         (commands.empty() ? "" : "; subcommands: " + joined(commands, ", "));
}

}  // namespace

int guarded(const std::function<int()>& work)
{
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow fails to be written
  try {
    return work();
  } catch (const BadInput& error) {
    return complain(error.what(), 2);
  } catch (const NoSolution& error) {
    return complain(error.what(), 3);
  } catch (const std::bad_alloc&) {
    return complain("out of memory: ask for fewer harmonics, samples or points", 3);
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(error.what(), 2);
  } catch (const std::exception& error) {
    return complain(std::string("internal error, please report it: ") + error.what(), 3);
  }
}

bool parse(CLI::App& app, int argc, char** argv)
{
  app.set_version_flag("--version", source_revision(), "print the version and exit");
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::CallForVersion& version) {
    write(version.what() + std::string("\n"));
  } catch (const CLI::Success&) {
    write(app.help());
  } catch (const CLI::ParseError& error) {
    const std::string argument = unexpected(app);
    throw BadInput(argument.empty() ? error.what() : argument);
  }
  return false;
}

int whole_number(const std::string& option, const std::string& value, int least, int most)
{
  int number = 0;
  const char* const end = value.data() + value.size();
  const auto [rest, error] = std::from_chars(value.data(), end, number);
  if (error != std::errc() || rest != end || number < least || number > most)
    throw BadInput(format("%s %s: must be in %d...%d, a whole number", option.c_str(),
                          value.c_str(), least, most));
  return number;
}

double real_number(const std::string& option, const std::string& value, double least,
                   double most)
{
  const std::optional<double> number = decimal(value);
  if (!number || *number < least || *number > most || (least == 0 && *number == 0))
    throw BadInput(option + " " + value + ": must be " +
                   (least == 0 ? format("> 0, at most %g", most)
                               : format("in %g...%g", least, most)) +
                   ", in decimal notation");
  return *number;
}

double speed_in_hertz(const std::string& option, const std::string& value,
                      std::string& unit, bool may_rest)
{
  /** 2π times as much is still a number, and so is the period of the slowest. */
  constexpr double largest = 1e300;
  std::string number = value, own = "Hz";
  for (const std::string known : {"Hz", "hz", "rpm", "RPM"})
    if (value.ends_with(known)) {
      own = known == "hz" ? "Hz" : known == "RPM" ? "rpm" : known;
      number.erase(value.size() - own.size());
      if (number.ends_with(' ')) number.pop_back();
    }
  const std::optional<double> speed = decimal(number);
  const bool is_rest = speed && *speed == 0 && may_rest;
  if (!speed || (!(*speed >= 1 / largest && *speed <= largest) && !is_rest))
    throw BadInput(option + " " + value + ": must be " + (may_rest ? "0 or " : "") +
                   "a positive speed in Hz, or as 1500rpm");
  if (is_rest && own == "Hz") return 0;  // 0 is one in any unit
  if (unit.empty()) unit = own;
  if (unit != own)
    throw BadInput(option + " " + value + ": is in " + own + ", the other end in " +
                   unit);
  return own == "rpm" ? *speed / 60 : *speed;
}

int run_figure(int argc, char** argv, const std::function<Table(SceneFile&)>& compute,
               const OwnOption& own)
{
  const std::string name = std::filesystem::path(argv[0]).filename();
  std::string scene_file = "data/scenes/" + name + ".toml", reading = "exchanged";
  CLI::App app("Computes one table; TSV on stdout.");
  app.add_option("scene", scene_file, "scene file")->capture_default_str();
  app.add_option("--reading", reading, "reading of Table 1: exchanged or as-printed")
      ->capture_default_str();
  if (own.value) app.add_option(own.name, *own.value, own.meaning)->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    SceneFile scene(scene_file, reading);
    write(compute(scene).text());
    return 0;
  });
}

}  // namespace rotor_stator
