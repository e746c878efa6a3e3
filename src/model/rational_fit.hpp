/**
# A rational function through samples

Receptances of a linear body are rational functions of the speed. Several of them, f(x),
are fitted with common poles in barycentric form by the AAA algorithm (Nakatsukasa, Sète
and Trefethen, SIAM J. Sci. Comput. 40 (2018) A1494):

$$r(x) = \sum_j \frac{w_j f_j}{x - x_j} \Big/ \sum_j \frac{w_j}{x - x_j}.$$

The support points x_j are those samples at which the fit is worst, one after the other;
the weights w minimise the linearised error at all other samples. Samples are added
between two others wherever the fit misses the one between. */
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <mutex>

namespace rotor_stator {

class RationalFit {
public:
  using Function = std::function<Eigen::VectorXcd(double)>;

  /** On [from, to]; `tolerance` of each component's largest, or a tenth of all's. */
  RationalFit(const Function& f, double from, double to, double tolerance);

  /** False where it needs too many samples, and outside [from, to]. */
  bool covers(double x) const { return is_good_ && x >= from_ && x <= to_; }

  struct At {
    Eigen::VectorXcd value, slope;
  };
  At at(double x) const;

private:
  void sample(const Function& f, double x);
  void fit(double tolerance);
  void find_weights();
  double miss(Eigen::Index sample) const;

  double from_, to_;
  bool is_good_ = false;
  Eigen::VectorXd points_, support_;
  Eigen::MatrixXcd values_, supported_;  ///< a column for each point
  Eigen::VectorXcd weights_;
  Eigen::VectorXd largest_;  ///< of each component
  Eigen::ArrayXd sizes_;     ///< the same, none below a tenth of the largest one
};

/** Fits that are made when they are first needed. */
struct RationalFits {
  std::mutex guard;
  std::map<double, RationalFit> fits;

  const RationalFit& of(double key, const std::function<RationalFit()>& made)
  {
    const std::lock_guard lock(guard);
    const auto known = fits.find(key);
    return known != fits.end() ? known->second : fits.emplace(key, made()).first->second;
  }
};

}  // namespace rotor_stator
