/**
# Hard cases: what each method does where it may fail

Beside the paper, which reports no failure.

    build/hard_cases > data/generated/hard_cases.tsv

A method is trusted for what it does when it cannot succeed. This list collects cases that are likely to
break one: no clearance, hardly any damping, a single ball, no gravity, grazing contact, bodies of very
unequal mass, a cage whose balls never return to where they were, starts far from the answer, speeds on a
fold or at the resonance of the contact.

Each case ends in one of two ways: a solution that an independent check confirms, or a refusal with its
reason. A wrong answer that claims success is the only failure, and would be drawn in orange. Filled circles
are periodic motions that were confirmed, open ones aperiodic motions whose statistics were; a dash is a
refusal. Harmonic balance and shooting must refuse where no periodic motion exists; time integration can
still answer there, so it has fewer dashes without being the better method for that. An answer that could
be neither confirmed nor refuted is marked as such and not counted as solved.

Modelled: all cases of data/scenes/hard_cases.toml by harmonic balance (the paper's predictor, arc length),
shooting and RK4. */
#include "hard/verification.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{.option = "--every",
                        .value = "1",
                        .meaning = "only each n-th of the rows",
                        .has_readings = false};
  return run_figure(argc, argv, program, [](SceneFile& file, const std::string& value) {
    const int every = whole_number("--every", value, 1, 1000);
    const hard::HardCases hard = hard::read_hard_cases(file);
    const std::size_t methods = hard::methods.size();
    const std::size_t rows = (hard.cases.size() * methods + every - 1) / every;
    const auto ends = computed_in_parallel("hard cases", rows, [&](std::size_t row) {
      const hard::HardCase& machine = hard.cases[row * every / methods];
      const hard::Method& method = hard::methods[row * every % methods];
      return hard::verify(machine, method, answer_by(method, machine, hard.rule),
                          hard.rule);
    });
    return hard::hard_table(hard, ends);
  });
}
