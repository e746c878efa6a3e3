/**
# SUNDIALS CVODE on Equation 7

Variable order and step. Output times are interpolated by CVODE and shorten no step. BDF runs
without its stability limit detection, which made it slower and no more accurate here, and with its
highest order as an argument: order 2, A-stable, is the cheaper one where large errors will do. */
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>

#include "equation7.hpp"

namespace {

int derivative(double t, N_Vector y, N_Vector dydt, void* data)
{
  static_cast<CountedEquation7*>(data)->derivative(t, N_VGetArrayPointer(y),
                                                   N_VGetArrayPointer(dydt));
  return 0;
}

int jacobian(double t, N_Vector y, N_Vector, SUNMatrix dfdy, void* data, N_Vector,
             N_Vector, N_Vector)
{
  static_cast<CountedEquation7*>(data)->jacobian(t, N_VGetArrayPointer(y),
                                                 SM_DATA_D(dfdy));
  return 0;
}

/** CVODE's objects for one integration. */
class Cvode {
public:
  Cvode(CountedEquation7& equation, int bdf_order, double tolerance, double begin,
        const double* start)
  {
    SUNContext_Create(nullptr, &context_);
    y_ = N_VNew_Serial(CountedEquation7::size, context_);
    sizes_ = N_VNew_Serial(CountedEquation7::size, context_);
    std::copy_n(start, CountedEquation7::size, N_VGetArrayPointer(y_));
    equation.sizes(N_VGetArrayPointer(sizes_));
    N_VScale(tolerance, sizes_, sizes_);
    memory_ = CVodeCreate(bdf_order ? CV_BDF : CV_ADAMS, context_);
    CVodeInit(memory_, derivative, begin, y_);
    CVodeSVtolerances(memory_, tolerance, sizes_);
    CVodeSetUserData(memory_, &equation);
    CVodeSetMaxNumSteps(memory_, 100'000'000);
    bdf_order ? solve_by_newton(bdf_order) : solve_by_iteration();
  }

  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  ~Cvode()
  {
    CVodeFree(&memory_);
    if (iteration_) SUNNonlinSolFree(iteration_);
    if (factors_) SUNLinSolFree(factors_);
    if (matrix_) SUNMatDestroy(matrix_);
    N_VDestroy(y_);
    N_VDestroy(sizes_);
    SUNContext_Free(&context_);
  }

  int advance(double time, double* state)
  {
    double reached;
    const int flag = CVode(memory_, time, y_, &reached, CV_NORMAL);
    std::copy_n(N_VGetArrayPointer(y_), CountedEquation7::size, state);
    return flag;
  }

  long steps() const
  {
    long steps = 0;
    CVodeGetNumSteps(memory_, &steps);
    return steps;
  }

private:
  void solve_by_newton(int order)
  {
    matrix_ = SUNDenseMatrix(CountedEquation7::size, CountedEquation7::size, context_);
    factors_ = SUNLinSol_Dense(y_, matrix_, context_);
    CVodeSetLinearSolver(memory_, factors_, matrix_);
    CVodeSetJacFn(memory_, jacobian);
    CVodeSetMaxOrd(memory_, order);
  }

  void solve_by_iteration()
  {
    iteration_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
    CVodeSetNonlinearSolver(memory_, iteration_);
  }

  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr, sizes_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver factors_ = nullptr;
  SUNNonlinearSolver iteration_ = nullptr;
  void* memory_ = nullptr;
};

}  // namespace

int cvode_integrate(CountedEquation7* equation, int bdf_order, double tolerance,
                    double begin, const double* start, int n, const double* times,
                    double* states, long* counts)
{
  equation->evaluations = equation->jacobians = 0;
  Cvode cvode(*equation, bdf_order, tolerance, begin, start);
  for (int k = 0; k < n; ++k, states += CountedEquation7::size, counts += 3) {
    const int flag = cvode.advance(times[k], states);
    if (flag < 0) return flag;
    counts[0] = equation->evaluations;
    counts[1] = equation->jacobians;
    counts[2] = cvode.steps();
  }
  return 0;
}
