#include "stability/section_verdict.hpp"

#include <algorithm>
#include <cmath>

namespace rotor_stator
{

double extent(const std::vector<Displacements>& section, double size)
{
  double widest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [low, high] = std::minmax_element(
        section.begin(), section.end(),
        [i](const Displacements& a, const Displacements& b) { return a[i] < b[i]; });
    widest = std::max(widest, (*high)[i] - (*low)[i]);
  }
  return widest / size;
}

double spread_of_order(int k, const std::vector<Displacements>& section, double size)
{
  double widest = 0;
  const auto apart = static_cast<std::size_t>(k);
  for (std::size_t n = apart; n < section.size(); ++n)
    for (std::size_t i = 0; i < 4; ++i)
      widest = std::max(widest, std::abs(section[n][i] - section[n - apart][i]));
  return widest / size;
}

namespace
{

Verdict verdict_of(const SectionJudgement& j, const VerdictRule& rule)
{
  if (j.spread < rule.periodic) return Verdict::periodic;
  if (j.period > 1 && j.spread_k < rule.periodic) return Verdict::subharmonic;
  const double doubt = 3 * j.exponent.error;
  if (j.exponent.value - doubt > rule.zero_rate) return Verdict::chaotic;
  const bool known = doubt < 2 * rule.zero_rate;
  const bool zero = std::abs(j.exponent.value) <= std::max(doubt, 0.1 * rule.zero_rate);
  if (known && zero) return Verdict::quasi_periodic;
  return Verdict::undecided;
}

}  // namespace

SectionJudgement judge_section(const std::vector<Displacements>& section, double size,
                               const Exponent& exponent, const VerdictRule& rule)
{
  const double whole = extent(section, size);
  SectionJudgement judgement{Verdict::undecided, 1, whole, whole, exponent};
  const int most = std::min(rule.most_period, static_cast<int>(section.size()) / 3);
  for (int k = 2; k <= most && !(judgement.spread_k < rule.periodic); ++k) {
    const double spread = spread_of_order(k, section, size);
    if (spread >= judgement.spread_k) continue;
    judgement.period = k;
    judgement.spread_k = spread;
  }
  judgement.verdict = verdict_of(judgement, rule);
  return judgement;
}

}  // namespace rotor_stator
