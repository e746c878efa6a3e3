/** The part of GSL's interface that the core needs on the way to a verdict, for the browser: one stepper,
    rk8pd, the Runge-Kutta pair of orders 8 and 7 of Prince and Dormand (J. Comput. Appl. Math. 7 (1981) 67), with GSL's
    choice of the step size, so that the steps are the same. The other methods are null: they cannot start. */
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

enum { GSL_SUCCESS = 0, GSL_FAILURE = -1, GSL_EBADFUNC = 9 };

struct gsl_odeiv2_system {
  int (*function)(double t, const double y[], double dydt[], void* params);
  int (*jacobian)(double t, const double y[], double* dfdy, double dfdt[], void* params);
  std::size_t dimension;
  void* params;
};

struct gsl_odeiv2_step_type {};
inline const gsl_odeiv2_step_type prince_dormand{};
inline constexpr const gsl_odeiv2_step_type *gsl_odeiv2_step_rk8pd = &prince_dormand,
                                            *gsl_odeiv2_step_rkf45 = nullptr,
                                            *gsl_odeiv2_step_rkck = nullptr,
                                            *gsl_odeiv2_step_msadams = nullptr,
                                            *gsl_odeiv2_step_msbdf = nullptr,
                                            *gsl_odeiv2_step_bsimp = nullptr;

namespace rk8pd {

constexpr int stages = 13;
using Row = std::array<double, stages>;

constexpr std::array<double, stages> nodes{0,
                                           1.0 / 18,
                                           1.0 / 12,
                                           1.0 / 8,
                                           5.0 / 16,
                                           3.0 / 8,
                                           59.0 / 400,
                                           93.0 / 200,
                                           5490023248.0 / 9719169821.0,
                                           13.0 / 20,
                                           1201146811.0 / 1299019798.0,
                                           1,
                                           1};

constexpr std::array<Row, stages> slopes_before{
    Row{},
    Row{1.0 / 18},
    Row{1.0 / 48, 1.0 / 16},
    Row{1.0 / 32, 0, 3.0 / 32},
    Row{5.0 / 16, 0, -75.0 / 64, 75.0 / 64},
    Row{3.0 / 80, 0, 0, 3.0 / 16, 3.0 / 20},
    Row{29443841.0 / 614563906.0, 0, 0, 77736538.0 / 692538347.0,
        -28693883.0 / 1125000000.0, 23124283.0 / 1800000000.0},
    Row{16016141.0 / 946692911.0, 0, 0, 61564180.0 / 158732637.0,
        22789713.0 / 633445777.0, 545815736.0 / 2771057229.0,
        -180193667.0 / 1043307555.0},
    Row{39632708.0 / 573591083.0, 0, 0, -433636366.0 / 683701615.0,
        -421739975.0 / 2616292301.0, 100302831.0 / 723423059.0, 790204164.0 / 839813087.0,
        800635310.0 / 3783071287.0},
    Row{246121993.0 / 1340847787.0, 0, 0, -37695042795.0 / 15268766246.0,
        -309121744.0 / 1061227803.0, -12992083.0 / 490766935.0,
        6005943493.0 / 2108947869.0, 393006217.0 / 1396673457.0,
        123872331.0 / 1001029789.0},
    Row{-1028468189.0 / 846180014.0, 0, 0, 8478235783.0 / 508512852.0,
        1311729495.0 / 1432422823.0, -10304129995.0 / 1701304382.0,
        -48777925059.0 / 3047939560.0, 15336726248.0 / 1032824649.0,
        -45442868181.0 / 3398467696.0, 3065993473.0 / 597172653.0},
    Row{185892177.0 / 718116043.0, 0, 0, -3185094517.0 / 667107341.0,
        -477755414.0 / 1098053517.0, -703635378.0 / 230739211.0,
        5731566787.0 / 1027545527.0, 5232866602.0 / 850066563.0,
        -4093664535.0 / 808688257.0, 3962137247.0 / 1805957418.0,
        65686358.0 / 487910083.0},
    Row{403863854.0 / 491063109.0, 0, 0, -5068492393.0 / 434740067.0,
        -411421997.0 / 543043805.0, 652783627.0 / 914296604.0,
        11173962825.0 / 925320556.0, -13158990841.0 / 6184727034.0,
        3936647629.0 / 1978049680.0, -160528059.0 / 685178525.0,
        248638103.0 / 1413531060.0}};

constexpr Row order_8{14005451.0 / 335480064.0,
                      0,
                      0,
                      0,
                      0,
                      -59238493.0 / 1068277825.0,
                      181606767.0 / 758867731.0,
                      561292985.0 / 797845732.0,
                      -1041891430.0 / 1371343529.0,
                      760417239.0 / 1151165299.0,
                      118820643.0 / 751138087.0,
                      -528747749.0 / 2220607170.0,
                      1.0 / 4};
constexpr Row order_7{13451932.0 / 455176623.0,
                      0,
                      0,
                      0,
                      0,
                      -808719846.0 / 976000145.0,
                      1757004468.0 / 5645159321.0,
                      656045339.0 / 265891186.0,
                      -3867574721.0 / 1518517206.0,
                      465885868.0 / 322736535.0,
                      53011238.0 / 667516719.0,
                      2.0 / 45};

}  // namespace rk8pd

struct gsl_odeiv2_driver {
  const gsl_odeiv2_system* system;
  double step, tolerance;
  std::vector<double> scales;
  std::array<std::vector<double>, rk8pd::stages> k = {};
  std::vector<double> start = {}, at = {}, error = {},
                      slope = {};  ///< slope: at the state
  bool knows_slope = false;

  int slopes_of(double t, const double* y, std::vector<double>& to) const
  {
    return system->function(t, y, to.data(), system->params);
  }

  /** y + h Σ w_j k_j. */
  void add(const std::vector<double>& y, double h, const rk8pd::Row& w, double* to) const
  {
    const std::size_t n = y.size();
    std::fill_n(to, n, 0.0);
    for (int j = 0; j < rk8pd::stages; ++j)
      for (std::size_t i = 0; w[j] != 0 && i < n; ++i) to[i] += w[j] * k[j][i];
    for (std::size_t i = 0; i < n; ++i) to[i] = y[i] + h * to[i];
  }

  /** One step of length h; its error is order 7's minus order 8's. */
  int apply(double t, double h, double* y)
  {
    k[0] = slope;
    for (int j = 1; j < rk8pd::stages; ++j) {
      add(start, h, rk8pd::slopes_before[j], at.data());
      if (const int status = slopes_of(t + rk8pd::nodes[j] * h, at.data(), k[j]))
        return status;
    }
    add(start, h, rk8pd::order_8, y);
    add(start, h, rk8pd::order_7, error.data());
    for (std::size_t i = 0; i < start.size(); ++i) error[i] -= y[i];
    return slopes_of(t + h, y, slope);
  }

  /** The next step length, from the largest error over what is allowed. */
  double adjusted(double h) const
  {
    double worst = std::numeric_limits<double>::min();
    for (std::size_t i = 0; i < error.size(); ++i)
      worst = std::max(worst, std::abs(error[i]) / (tolerance * scales[i]));
    if (worst > 1.1) return h * std::max(0.2, 0.9 / std::pow(worst, 1.0 / 8));
    if (worst < 0.5) return h * std::clamp(0.9 / std::pow(worst, 1.0 / 9), 1.0, 5.0);
    return h;
  }

  /** One accepted step towards `to`. */
  int evolve(double& t, double to, double* y)
  {
    const std::size_t n = system->dimension;
    for (auto* list : {&start, &at, &error, &slope}) list->resize(n);
    for (auto& stage : k) stage.resize(n);
    std::copy_n(y, n, start.begin());
    if (!knows_slope)
      if (const int status = slopes_of(t, y, slope)) return status;
    knows_slope = true;
    const std::vector<double> slope_at_start = slope;
    for (double h = step;;) {
      const bool is_last = h > to - t;
      if (is_last) h = to - t;
      slope = slope_at_start;
      if (const int status = apply(t, h, y)) return status;
      const double next = adjusted(h);
      if (next < h && t + next != t) {
        h = next;
        continue;
      }
      t = is_last ? to : t + h;
      if (!is_last) step = std::max(h, next);
      return GSL_SUCCESS;
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
inline void gsl_odeiv2_driver_free(gsl_odeiv2_driver* driver)
{
  delete driver;
}
inline int gsl_odeiv2_driver_reset(gsl_odeiv2_driver* driver)
{
  driver->knows_slope = false;
  return GSL_SUCCESS;
}
inline int gsl_odeiv2_driver_apply(gsl_odeiv2_driver* driver, double* t, double to,
                                   double* y)
{
  while (*t < to)
    if (const int status = driver->evolve(*t, to, y)) return status;
  return GSL_SUCCESS;
}
inline void* gsl_set_error_handler_off()
{
  return nullptr;
}
inline const char* gsl_strerror(int)
{
  return "the step became too small or the slopes are not finite";
}
