/** The part of GSL's interface that the core needs on the way to a verdict, for the browser: one stepper,
    rk8pd, the Runge-Kutta pair of orders 8 and 7 of Prince and Dormand (J. Comput. Appl. Math. 7 (1981) 67), with GSL's
    choice of the step size, so that the steps are the same. The other methods are null: they cannot start. */
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

enum { GSL_SUCCESS = 0, GSL_EBADFUNC = 9 };

struct gsl_odeiv2_system {
  int (*function)(double t, const double y[], double dydt[], void* params);
  int (*jacobian)(double t, const double y[], double* dfdy, double dfdt[], void* params);
  std::size_t dimension;
  void* params;
};

struct gsl_odeiv2_step_type {};
inline constexpr gsl_odeiv2_step_type prince_dormand{};
inline constexpr const gsl_odeiv2_step_type *gsl_odeiv2_step_rk8pd = &prince_dormand,
                                            *gsl_odeiv2_step_rkf45 = nullptr,
                                            *gsl_odeiv2_step_rkck = nullptr,
                                            *gsl_odeiv2_step_msadams = nullptr,
                                            *gsl_odeiv2_step_msbdf = nullptr,
                                            *gsl_odeiv2_step_bsimp = nullptr;

/** Row j: the weights of the slopes before stage j, whose sum is its node; the last two rows: orders 8 and 7. */
constexpr int rk8pd_stages = 13;
constexpr double rk8pd_weights[rk8pd_stages + 2][rk8pd_stages]{
    {},
    {1 / 18.},
    {1 / 48., 1 / 16.},
    {1 / 32., 0, 3 / 32.},
    {5 / 16., 0, -75 / 64., 75 / 64.},
    {3 / 80., 0, 0, 3 / 16., 3 / 20.},
    {29443841 / 614563906., 0, 0, 77736538 / 692538347., -28693883 / 1125000000.,
     23124283 / 1800000000.},
    {16016141 / 946692911., 0, 0, 61564180 / 158732637., 22789713 / 633445777.,
     545815736 / 2771057229., -180193667 / 1043307555.},
    {39632708 / 573591083., 0, 0, -433636366 / 683701615., -421739975 / 2616292301.,
     100302831 / 723423059., 790204164 / 839813087., 800635310 / 3783071287.},
    {246121993 / 1340847787., 0, 0, -37695042795 / 15268766246., -309121744 / 1061227803.,
     -12992083 / 490766935., 6005943493 / 2108947869., 393006217 / 1396673457.,
     123872331 / 1001029789.},
    {-1028468189 / 846180014., 0, 0, 8478235783 / 508512852., 1311729495 / 1432422823.,
     -10304129995 / 1701304382., -48777925059 / 3047939560., 15336726248 / 1032824649.,
     -45442868181 / 3398467696., 3065993473 / 597172653.},
    {185892177 / 718116043., 0, 0, -3185094517 / 667107341., -477755414 / 1098053517.,
     -703635378 / 230739211., 5731566787 / 1027545527., 5232866602 / 850066563.,
     -4093664535 / 808688257., 3962137247 / 1805957418., 65686358 / 487910083.},
    {403863854 / 491063109., 0, 0, -5068492393 / 434740067., -411421997 / 543043805.,
     652783627 / 914296604., 11173962825 / 925320556., -13158990841 / 6184727034.,
     3936647629 / 1978049680., -160528059 / 685178525., 248638103 / 1413531060.},
    {14005451 / 335480064., 0, 0, 0, 0, -59238493 / 1068277825., 181606767 / 758867731.,
     561292985 / 797845732., -1041891430 / 1371343529., 760417239 / 1151165299.,
     118820643 / 751138087., -528747749 / 2220607170., 1 / 4.},
    {13451932 / 455176623., 0, 0, 0, 0, -808719846 / 976000145., 1757004468 / 5645159321.,
     656045339 / 265891186., -3867574721 / 1518517206., 465885868 / 322736535.,
     53011238 / 667516719., 2 / 45.}};

struct gsl_odeiv2_driver {
  const gsl_odeiv2_system* system;
  double step, tolerance;
  std::vector<double> scales;
  bool knows_slope = false;
  std::size_t n = system->dimension;
  std::vector<double> start = scales, at = scales, error = scales, slope = scales;
  std::vector<std::vector<double>> k{rk8pd_stages, scales};

  int slopes_of(double t, const double* y, std::vector<double>& to) const
  {
    return system->function(t, y, to.data(), system->params);
  }

  /** Σ w_j k_j. */
  void sum(const double* w, std::vector<double>& to) const
  {
    std::fill(to.begin(), to.end(), 0.0);
    for (int j = 0; j < rk8pd_stages; ++j)
      for (std::size_t i = 0; w[j] != 0 && i < n; ++i) to[i] += w[j] * k[j][i];
  }

  /** One step of length h; its error is order 7's minus order 8's. */
  int apply(double t, double h, double* y)
  {
    for (int j = 1; j < rk8pd_stages; ++j) {
      const double* row = rk8pd_weights[j];
      sum(row, at);
      for (std::size_t i = 0; i < n; ++i) at[i] = start[i] + h * at[i];
      const double node = std::accumulate(row, row + j, 0.0);
      if (const int bad = slopes_of(t + node * h, at.data(), k[j])) return bad;
    }
    sum(rk8pd_weights[rk8pd_stages], at);
    sum(rk8pd_weights[rk8pd_stages + 1], error);
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = start[i] + h * at[i];
      error[i] = h * (error[i] - at[i]);
    }
    return slopes_of(t + h, y, slope);
  }

  /** The next step length, from the largest error over what is allowed. */
  double adjusted(double h) const
  {
    double worst = std::numeric_limits<double>::min();
    for (std::size_t i = 0; i < n; ++i)
      worst = std::max(worst, std::abs(error[i]) / (tolerance * scales[i]));
    if (worst > 1.1) return h * std::max(0.2, 0.9 / std::pow(worst, 1.0 / 8));
    if (worst < 0.5) return h * std::clamp(0.9 / std::pow(worst, 1.0 / 9), 1.0, 4.9);
    return h;
  }

  /** One accepted step towards `to`. */
  int evolve(double& t, double to, double* y)
  {
    std::copy_n(y, n, start.begin());
    if (!knows_slope)
      if (const int bad = slopes_of(t, y, slope)) return bad;
    knows_slope = true;
    k[0] = slope;
    for (double h = step;;) {
      const bool is_last = h > to - t;
      if (is_last) h = to - t;
      if (const int bad = apply(t, h, y)) return bad;
      const double next = adjusted(h);
      if (next >= h || t + next == t) {
        if (!is_last) step = std::max(h, next);
        t = is_last ? to : t + h;
        return GSL_SUCCESS;
      }
      h = next;
    }
  }
};

inline gsl_odeiv2_driver* gsl_odeiv2_driver_alloc_scaled_new(
    const gsl_odeiv2_system* system, const gsl_odeiv2_step_type* type, double first_step,
    double tolerance, double, double, double, const double scales[])
{
  if (!type || !(first_step > 0)) return nullptr;
  return new gsl_odeiv2_driver{
      system, first_step, tolerance, {scales, scales + system->dimension}};
}
inline void gsl_odeiv2_driver_free(gsl_odeiv2_driver* driver) { delete driver; }
inline void gsl_odeiv2_driver_reset(gsl_odeiv2_driver* driver) { driver->knows_slope = false; }
inline int gsl_odeiv2_driver_apply(gsl_odeiv2_driver* driver, double* t, double to,
                                   double* y)
{
  while (*t < to)
    if (const int bad = driver->evolve(*t, to, y)) return bad;
  return GSL_SUCCESS;
}
inline int gsl_set_error_handler_off() { return 0; }
inline const char* gsl_strerror(int) { return "the step became too small or the slopes are not finite"; }
