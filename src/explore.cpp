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

/** Throws BadInput where a file cannot be written, or is that of another option too. */
void require_files(const Request& asked)
{
  std::ranges::for_each(asked.inputs, require_plain_name);
  for (auto file = asked.outputs.begin(); file != asked.outputs.end(); ++file) {
    const auto& [option, name] = *file;
    require_plain_name(name);
    require_writable(option, name, asked.inputs, asked.force);
    for (auto other = asked.outputs.begin(); other != file; ++other)
      if (is_same_file(name, other->second))
        throw BadInput(name + ": is the file of two options");
  }
  if (asked.overlay && !asked.plot) throw BadInput("--overlay: needs --plot");
  if (asked.rpm && !asked.plot) throw BadInput("--rpm: needs --plot");
}

/** What a command finds; where nothing is found, the file of the machine is named. */
Exploration found_by(const std::function<Exploration()>& explored,
                     const std::string& parameter_file)
try {
  return explored();
} catch (const NoSolution& error) {
  const std::string why = error.what();
  throw NoSolution((why.starts_with(parameter_file) ? "" : parameter_file + ": ") + why);
}

/** Computes, draws by the script and prints: what cannot be written keeps nothing else
    from being written. */
void run(const Request& asked, const std::string& script,
         const std::function<Exploration()>& explored)
{
  require_files(asked);
  if (asked.plot) require_plot(*asked.plot, script);
  Exploration found = found_by(explored, asked.parameter_file);
  if (asked.rpm) found.table.value("speed_axis", "rpm");
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
  if (!asked.quiet)
    for (const std::string& text : found.table.warnings())
      std::fprintf(stderr, "warning: %s\n", printable(text).c_str());
  std::erase(missing, "");
  if (!missing.empty()) throw NoSolution(joined(missing, "; "));
}

/** A command with its options, run once these are parsed. */
template <class Asked>
void add(CLI::App& app, const char* name, Exploration (*explored)(const Asked&),
         const char* script, const char* meaning)
{
  CLI::App* command = app.add_subcommand(name, meaning);
  const auto asked = std::make_shared<Asked>();
  const Check check = add_options(*command, *asked);
  command->callback([=] {
    check();
    run(*asked, script, [=] { return explored(*asked); });
  });
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Explores a rotor and a stator in a ball bearing; a table on stdout.");
  app.require_subcommand(1);
  app.option_defaults()->disable_flag_override();  // no --quiet=7
  add(app, "check", explore_check, "", "what a machine is, before anything is computed");
  add(app, "orbit", explore_orbit, "orbit.py", "displacements and force over one period");
  add(app, "contact", explore_contact, "contact.py",
      "force of every ball over two periods");
  add(app, "response", explore_response, "response.py",
      "amplitudes against speed: what the machine does, or a branch");
  add(app, "spectrum", explore_spectrum, "spectrum.py",
      "lines of the motion, with names such as BPFO-1X");
  add(app, "attractors", explore_attractors, "sections.py",
      "what the machine settles on, speed by speed");
  add(app, "runup", explore_runup, "response.py",
      "run-up or coast-down: amplitudes while the speed changes");
  add(app, "map", explore_map, "map.py",
      "quantities over two keys of the parameter file");
  add(app, "shaft", explore_shaft, "", "matrices of a shaft of beam elements, in files");
  add(app, "shape", explore_shape, "shape.py",
      "orbits along a rotor given by matrices, at one speed");
  add(app, "campbell", explore_campbell, "campbell.py",
      "whirl frequencies against speed, critical speeds");
  return guarded([&] {
    parse(app, argc, argv);
    return 0;
  });
}
