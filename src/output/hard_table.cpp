#include "output/hard_table.hpp"

#include <algorithm>

#include "model/errors.hpp"
#include "scenes/hard_checks.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> columns{
    {"case", "-", "group of the list, varied value, speed"},
    {"method", "-", "aft predictor, aft arc length, shooting or rk4"},
    {"status", "-", "0 an answer is claimed, 3 refused"},
    {"residual", "-",
     "Newton's, the closure of the period or the Poincare spread; -1 none"},
    {"check_error", "-",
     "of displacement, by the check; of amplitude if aperiodic; -1 none"},
    {"verdict", "-", "solved, refused, silent error or unconfirmed"},
    {"f", "Hz", "speed"},
    {"harmonics", "-", "m of harmonic balance; -1 none"},
    {"samples", "-", "N of harmonic balance; -1 none"},
    {"stated_error", "-", "of displacement, by the method's own refinement; -1 none"},
    {"stated_error_force", "-", "the same of the force; -1 none"},
    {"multiplier", "-", "largest modulus of the Floquet multipliers; -1 none"},
    {"floquet_change", "-", "of that by refinement: m to 2m, or the tolerance; -1 none"},
    {"check_multiplier", "-",
     "largest modulus on the motion that the check found; -1 none"},
    {"stability", "-", "stable, unstable, unknown; - where nothing is claimed"},
    {"regime", "-", "T-periodic or aperiodic; - where nothing is claimed"},
    {"check", "-", "what checked it"},
    {"note", "-", "where it started, or the reason of the refusal"}};

void add(const HardCase& hard, Method method, const Judgement& judgement, Table& table)
{
  const Answer& a = judgement.answer;
  const Check& c = judgement.check;
  const std::string regime = !a.claimed ? "-" : a.periodic ? "T-periodic" : "aperiodic";
  const auto told = [&](double value) { return a.claimed ? value : -1; };
  table.row({hard.name, name_of(method), a.claimed ? 0 : 3, told(a.residual), c.error,
             judgement.verdict, hard.frequency, a.harmonics, a.samples, told(a.stated),
             told(a.stated_force), c.multiplier, c.floquet_change, c.found_multiplier,
             c.stability, regime, c.by, a.reason});
}

/** The sums that are asked for first. */
void count(const std::vector<Judgement>& judgements, Table& table)
{
  const std::size_t methods = std::size(all_methods);
  for (std::size_t k = 0; k < methods; ++k) {
    const auto ended = [&](const char* verdict) {
      int number = 0;
      for (std::size_t i = k; i < judgements.size(); i += methods)
        number += judgements[i].verdict == verdict;
      return number;
    };
    table.note(name_of(all_methods[k]) +
               text(": %d solved, %d refused, %d silent errors, %d unconfirmed",
                    ended("solved"), ended("refused"), ended("silent error"),
                    ended("unconfirmed")));
  }
}

}  // namespace

Table hard_table(const std::string& list, int every)
{
  const HardCases hard = read_hard_cases(list);
  const auto judgements = judge_all(hard, every);
  Table table("How each method ends on the hard cases", columns);
  table.note(
      text("rule: claimed when the stated error is at most %g; false when the check "
           "finds more than %g times it (and %g), or more than %g",
           hard.rule.accuracy, hard.rule.most_error_ratio, hard.rule.least_error,
           hard.rule.most_error));
  table.note(text("cases: %zu", hard.cases.size()));
  count(judgements, table);
  const std::size_t methods = std::size(all_methods);
  for (std::size_t piece = 0; piece < judgements.size(); piece += every)
    add(hard.cases[piece / methods], all_methods[piece % methods], judgements[piece],
        table);
  return table;
}

}  // namespace rotor_stator
