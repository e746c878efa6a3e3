/**
# explore: one's own machine

    build/explore check data/set1.toml
    build/explore orbit data/set1.toml --frequency 45 --harmonics 10 > orbit.tsv
    build/explore contact data/set1.toml --frequency 45 > contact.tsv
    build/explore spectrum data/set1.toml --frequency 45 --harmonics 24 > spectrum.tsv
    build/explore response data/set1.toml --from 1 --to 60 > response.tsv
    build/explore runup data/set1.toml --from 0 --to 60 --seconds 20 > runup.tsv
    build/explore attractors data/set1.toml --from 18 --to 22 --count 17 > attractors.tsv
    build/explore map data/set1.toml --x frequency=10:50:41 --quantity amplitude > map.tsv
    build/explore shaft data/rotors/overhung_shaft.toml --to overhung > nodes.tsv
    build/explore shape data/rotors/overhung.toml --frequency 30 --nodes nodes.tsv
    build/explore campbell data/rotors/overhung.toml --from 0 --to 100 --count 34

The general program for follow-up studies: any parameter file, any speed, harmonic balance
or one of the time integrators. A table on stdout, errors on stderr. */
#include <CLI/CLI.hpp>

#include "explore/options.hpp"
#include "explore/plot.hpp"
#include "explore/spectrum.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::explore;

/** Files that a command writes, by the option that names them, and reads beside its
    machine. */
struct Files {
  std::vector<std::pair<const char*, std::optional<std::string>>> written = {};
  std::vector<std::optional<std::string>> read = {};
};
Files files_of(const Request&)
{
  return {};
}
Files files_of(const ResponseRequest& asked)
{
  return {{{"--save", asked.save}, {"--waterfall", asked.waterfall}},
          {asked.restart, asked.resume}};
}
Files files_of(const AttractorsRequest& asked)
{
  return {{{"--section", asked.section}, {"--motions", asked.motions}}};
}
Files files_of(const RunUpRequest& asked)
{
  return {{{"--waterfall", asked.waterfall}}};
}
Files files_of(const MapRequest& asked)
{
  return {.read = {asked.list, asked.resume}};
}
Files files_of(const ShaftRequest& asked)
{
  return {.read = {asked.folder}};
}
Files files_of(const ShapeRequest& asked)
{
  return {.read = {asked.nodes}};
}

/** Throws BadInput where a file cannot be written, or is that of another option too. */
void require_files(const Request& asked, Files files)
{
  files.written.emplace_back("--plot", asked.plot);
  files.read.insert(files.read.end(), {asked.parameter_file, asked.overlay});
  std::vector<std::string> inputs, outputs;
  for (const auto& file : files.read) {
    if (!file) continue;
    require_plain_name(*file);
    inputs.push_back(*file);
  }
  for (const auto& [option, file] : files.written) {
    if (!file) continue;
    require_plain_name(*file);
    require_writable(option, *file, inputs, asked.force);
    for (const std::string& other : outputs)
      if (is_same_file(*file, other))
        throw BadInput(*file + ": is the file of two options");
    outputs.push_back(*file);
  }
  if (asked.overlay && !asked.plot) throw BadInput("--overlay: needs --plot");
  if (asked.rpm && !asked.plot) throw BadInput("--rpm: needs --plot");
}

/** What a command finds; where nothing is found, the file of the machine is named. */
template <class Asked>
Exploration found_by(const Asked& asked, Exploration (*explored)(const Asked&))
try {
  return explored(asked);
} catch (const NoSolution& error) {
  const std::string why = error.what();
  const bool is_named = why.starts_with(asked.parameter_file);
  throw NoSolution((is_named ? "" : asked.parameter_file + ": ") + why);
}

/** Computes, draws by the script and prints: what cannot be written keeps nothing else
    from being written. */
template <class Asked>
void run(const Asked& asked, Exploration (*explored)(const Asked&),
         const std::string& script)
{
  require_files(asked, files_of(asked));
  if (asked.plot) require_plot(*asked.plot, script);
  Exploration found = found_by(asked, explored);
  if (asked.rpm) found.table.value("speed_unit", "rpm");
  std::vector<std::string> missing{found.unfinished};
  for (const NamedContent& file : found.files) try {
      write_files({file});
    } catch (const NoSolution& error) {
      missing.emplace_back(error.what());
    }
  if (asked.plot)
    missing.push_back(
        plot(*asked.plot, script,
             found.drawn.empty() ? found.table.text(TableFormat::tsv, true) : found.drawn,
             asked.overlay));
  if (!found.is_written) write(found.table.text(asked.format));
  for (const std::string& why : missing)
    if (!why.empty()) throw NoSolution(why);
  if (asked.quiet) return;
  for (const std::string& text : found.table.warnings())
    std::fprintf(stderr, "warning: %s\n", printable(text).c_str());
}

/** The commands, each with a request of its own. */
class Commands {
public:
  explicit Commands(CLI::App& app) : app_(app) {}

  template <class Asked>
  void add(const char* name, Exploration (*explored)(const Asked&), const char* script,
           const char* meaning)
  {
    CLI::App* command = app_.add_subcommand(name, meaning);
    const auto asked = std::make_shared<Asked>();
    const Check check = add_options(*command, *asked);
    runs_.emplace_back(command, [=] {
      check();
      run(*asked, explored, script);
    });
  }

  void run_chosen() const
  {
    for (const auto& [command, run] : runs_)
      if (command->parsed()) run();
  }

private:
  CLI::App& app_;
  std::vector<std::pair<CLI::App*, std::function<void()>>> runs_;
};

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Explores a rotor and a stator in a ball bearing; a table on stdout.");
  app.require_subcommand(1);
  Commands all(app);
  all.add("check", explore_check, "", "what a machine is, before anything is computed");
  all.add("orbit", explore_orbit, "orbit.py", "displacements and force over one period");
  all.add("contact", explore_contact, "contact.py",
          "force of every ball over two periods");
  all.add("response", explore_response, "response.py",
          "amplitudes against speed: what the machine does, or a branch");
  all.add("spectrum", explore_spectrum, "spectrum.py",
          "lines of the motion, with names such as BPFO-1X");
  all.add("attractors", explore_attractors, "sections.py",
          "what the machine settles on, speed by speed");
  all.add("runup", explore_runup, "response.py",
          "run-up or coast-down: amplitudes while the speed changes");
  all.add("map", explore_map, "map.py", "quantities over two keys of the parameter file");
  all.add("shaft", explore_shaft, "", "matrices of a shaft of beam elements, in files");
  all.add("shape", explore_shape, "shape.py",
          "orbits along a rotor given by matrices, at one speed");
  all.add("campbell", explore_campbell, "campbell.py",
          "whirl frequencies against speed, critical speeds");
  return guarded([&] {
    if (parse(app, argc, argv)) all.run_chosen();
    return 0;
  });
}
