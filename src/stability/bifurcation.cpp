#include "stability/bifurcation.hpp"

#include <algorithm>
#include <limits>

namespace rotor_stator
{

namespace
{

using Complex = std::complex<double>;

double through_plus_one(const Multipliers& multipliers)
{
  Complex product = 1;
  for (const Complex& mu : multipliers) product *= 1.0 - mu;
  return product.real();
}

double through_minus_one(const Multipliers& multipliers)
{
  Complex product = 1;
  for (const Complex& mu : multipliers) product *= 1.0 + mu;
  return product.real();
}

double through_the_circle(const Multipliers& multipliers)
{
  Complex product = 1;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) product *= 1.0 - multipliers[i] * multipliers[j];
  return product.real();
}

}  // namespace

const std::array<BifurcationTest, 3> bifurcation_tests{
    {{Bifurcation::plus_one, through_plus_one},
     {Bifurcation::period_doubling, through_minus_one},
     {Bifurcation::neimark_sacker, through_the_circle}}};

bool is_complex_pair(const Multipliers& multipliers)
{
  double least = std::numeric_limits<double>::infinity();
  bool complex = false;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double off = std::abs(1.0 - multipliers[i] * multipliers[j]);
      if (off >= least) continue;
      least = off;
      complex = multipliers[i].imag() != 0;
    }
  return complex;
}

const char* name_of(Bifurcation bifurcation)
{
  switch (bifurcation) {
    case Bifurcation::fold:
      return "fold";
    case Bifurcation::plus_one:
      return "plus-one";
    case Bifurcation::period_doubling:
      return "period-doubling";
    case Bifurcation::neimark_sacker:
      return "neimark-sacker";
    default:
      return "-";
  }
}

int unstable_count(const Multipliers& multipliers)
{
  return static_cast<int>(std::count_if(multipliers.begin(), multipliers.end(),
                                        [](Complex mu) { return std::abs(mu) > 1; }));
}

}  // namespace rotor_stator
