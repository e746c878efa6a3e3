/**
# A periodic motion

One method passes it to the next: a speed, the coefficients of the relative motion at a
list of harmonics, and how they were found. */
#pragma once

#include <Eigen/Core>
#include <compare>
#include <memory>
#include <string>
#include <vector>

namespace rotor_stator {

/** Where the harmonics of a list stand among those of N samples, |p| ≤ N/2; the harmonic
    of frequency -p for p < 0. */
using Images = std::vector<int>;

/** One frequency of a motion, k_1 ω + k_2 n ω_cage; halves where it repeats itself after
    two turns and two passages only. */
struct Harmonic {
  double k_1, k_2;

  auto operator<=>(const Harmonic&) const = default;
};

/** With two frequencies the samples lie on the line θ_2 = z θ_1 (torus_line.hpp), which
    closes after so many turns. */
struct TorusLine {
  int z = 0, samples = 0, turns = 1;
};

/** The frequencies of a motion, the mean first. Motions with the same ones share the
    list. */
class Harmonics {
public:
  Harmonics() = default;  ///< none

  /** Those of Eq. 9: (0, 0), (1, 0), … (m, 0). */
  Harmonics(int m);

  /** Chosen ones, (0, 0) first, none of them twice nor with its negative. */
  explicit Harmonics(std::vector<Harmonic> list);

  const std::vector<Harmonic>& list() const { return *list_; }

  /** How many they are beside the mean: m where they are those of Eq. 9. */
  int count() const { return list_ ? static_cast<int>(list_->size()) - 1 : 0; }

  /** h = k_1 + z k_2 times the line's turns, modulo N, for each of them. */
  Images images(const TorusLine& line, int samples) const;

  /** Coefficients of one displacement: the mean, and a cosine and a sine of each other
      frequency. */
  Eigen::Index coefficients() const
  {
    return list_ ? 2 * static_cast<Eigen::Index>(list_->size()) - 1 : 0;
  }

private:
  std::shared_ptr<const std::vector<Harmonic>> list_;
};

/** How Newton's iteration ended. */
enum class NewtonEnd {
  converged,
  too_many_iterations,
  no_decrease,
  not_finite,
  shorter_period  ///< converged, on a motion that repeats itself sooner
};

struct NewtonReport {
  NewtonEnd end = NewtonEnd::too_many_iterations;
  int iterations = 0;
  double delta_1 = 0;  ///< Eq. 17 [-], over the residual's scale
  double delta_2 = 0;  ///< Eq. 18 [-], over the unknown's scale

  bool converged() const { return end == NewtonEnd::converged; }
  std::string reason() const;
};

/** A solution, or a start for one: then Newton has not converged and `x` is a guess. */
struct PeriodicMotion {
  double omega = 0;  ///< [rad/s]
  Harmonics harmonics = {};
  int samples = 0;              ///< N
  TorusLine line = {};          ///< with two frequencies
  Eigen::VectorXd x = {};       ///< coefficients of u [m], d for each one of Eq. 9
  Eigen::MatrixXd force = {};   ///< those of the nonlinear force at u [N], d × (2m+1)
  Eigen::MatrixXd bodies = {};  ///< series of x_s, y_s, x_r, y_r [m], where asked for
  NewtonReport newton = {};
  long force_samples = 0;  ///< what Newton cost: evaluations of the force times N
  std::string start = {};  ///< what Newton started from

  bool found() const { return newton.converged(); }
};

/** The coefficients x of one set of harmonics on another one: zero where it has none. */
Eigen::VectorXd project(const Eigen::VectorXd& x, int dofs, const Harmonics& from,
                        const Harmonics& to);

/** The coefficients x with m = `harmonics`: cut, or filled with zeros. */
Eigen::VectorXd resize_harmonics(Eigen::VectorXd x, int dofs, int harmonics);

}  // namespace rotor_stator
