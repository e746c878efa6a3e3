/**
# What every unit test needs

And cases that others defined: small oscillators of public harmonic-balance tools (NLvib
examples 01 to 03), set up through the seam of balance/balance.hpp.
M q̈ + D q̇ + K q + f(q) = F cos Ωt. */
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "motion/find_periodic.hpp"
#include "support/catch.hpp"
#include "time/period_map.hpp"

namespace rotor_stator::tests {

/** A force on each mass from the masses' displacements, with its derivative (row i,
    column j). */
struct LocalForce {
  Eigen::VectorXd force;
  Eigen::MatrixXd stiffness;
};
using ForceLaw = std::function<LocalForce(const Eigen::VectorXd& q)>;

struct Oscillator {
  Eigen::MatrixXd mass, damping, stiffness;
  Eigen::VectorXd load;
  ForceLaw law;

  Problem problem(int samples) const;
};

Oscillator duffing();
Oscillator two_masses_cubic();
Oscillator two_masses_unilateral();

/** The multipliers along the series `x` of an oscillator with a smooth stiffness, by RK4, and their change from half as
    many steps. */
Floquet floquet(const Oscillator& oscillator, const Eigen::VectorXd& x, double omega);

/** The amplitude of harmonic `h` of variable `row` in the coefficients `x` with d
    variables. */
double harmonic_amplitude(const Eigen::VectorXd& x, int dofs, int row, int h);

/** Root mean square of variable `row`. */
double rms(const Eigen::VectorXd& x, int dofs, int row);

/** data/set1.toml. */
Parameters set_1();

/** 2π times a frequency. */
double hertz(double frequency);

/** At most these registers are used from now on. */
inline void use_registers(Registers widest)
{
  widest_registers() = std::min(widest, registers_of_processor());
}

/** Equally many numbers, each within a relative tolerance. */
void check_same(const std::vector<double>& found, const std::vector<double>& known,
                double tolerance);

using Bits = std::array<std::uint64_t, 8>;

/** The bits of a state: what must be the same to the last one. */
inline Bits bits(const State& state)
{
  return std::bit_cast<Bits>(std::array{state.position, state.velocity});
}

}  // namespace rotor_stator::tests
