/**
# Benchmarks: what an iteration is made of

Run: make bench.  Google Benchmark; tests/bench/table.py makes a table of its output and of the
ratios that say how near the code is to what the machine can do: a force evaluation against as many
vectorised square roots as there are balls and samples, and a Newton iteration against Eigen's LU of
the same matrix. Everything on data set 1, at its solution at 30 Hz, with the default samples. */
#include <benchmark/benchmark.h>

#include <Eigen/LU>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "continuation/sweep.hpp"
#include "io/toml_file.hpp"
#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;

namespace {

const Parameters& parameters()
{
  static const Parameters read = read_parameters(SOURCE_DIR "/data/set1.toml");
  return read;
}

const double omega = angular(30);

/** A balance at its solution with m harmonics. */
struct Solved {
  int harmonics;
  Balance balance;
  Eigen::VectorXd x;

  explicit Solved(benchmark::State& state)
      : harmonics(static_cast<int>(state.range(0))),
        balance(bearing_problem(parameters(), default_samples(harmonics)), harmonics),
        x(find_periodic({parameters(), omega, harmonics}).x)
  {
  }
  Eigen::MatrixXd samples() const
  {
    Eigen::MatrixXd samples;
    FourierTransform(balance.problem().samples)
        .to_samples(x.reshaped(2, 2 * harmonics + 1), samples);
    return samples;
  }
  long ball_samples() const
  {
    return static_cast<long>(parameters().bearing.balls) * balance.problem().samples;
  }
};

/** As many square roots as a force evaluation has balls and samples. */
void square_roots(benchmark::State& state)
{
  const Solved solved(state);
  const Eigen::ArrayXd numbers = Eigen::ArrayXd::LinSpaced(solved.ball_samples(), 0, 1);
  Eigen::ArrayXd roots(numbers.size());
  for (auto _ : state) {
    roots = numbers.sqrt();
    benchmark::DoNotOptimize(roots.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * solved.ball_samples());
}

void evaluate(benchmark::State& state, bool with_stiffness)
{
  const Solved solved(state);
  const Eigen::MatrixXd u = solved.samples();
  Eigen::MatrixXd force, stiffness;
  for (auto _ : state) {
    solved.balance.problem().force(u, force, with_stiffness ? &stiffness : nullptr);
    benchmark::DoNotOptimize(force.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * solved.ball_samples());
}
void force(benchmark::State& state)
{
  evaluate(state, false);
}
void force_and_stiffness(benchmark::State& state)
{
  evaluate(state, true);
}

/** Γ⁻¹ of the motion and Γ of the force. */
void transforms(benchmark::State& state)
{
  Solved solved(state);
  FourierTransform transform(solved.balance.problem().samples);
  Eigen::MatrixXd series = solved.x.reshaped(2, 2 * solved.harmonics + 1), samples;
  for (auto _ : state) {
    transform.to_samples(series, samples);
    transform.to_series(samples, series);
    benchmark::DoNotOptimize(series.data());
  }
}

void factorisation(benchmark::State& state)
{
  Solved solved(state);
  const Eigen::MatrixXd jacobian = solved.balance.jacobian(solved.x, omega);
  Eigen::PartialPivLU<Eigen::MatrixXd> factors(jacobian.rows());
  for (auto _ : state) {
    factors.compute(jacobian);
    benchmark::DoNotOptimize(factors.matrixLU().data());
  }
}

/** Residual, step and nothing else: with new factors, or as `solve` goes on with old ones. */
void iterate(benchmark::State& state, bool fresh)
{
  Solved solved(state);
  BalanceSolver solver(solved.balance);
  const double scale = solved.balance.problem().residual_scale;
  const Eigen::VectorXd points[] = {(1 + 1e-6) * solved.x, (1 + 2e-6) * solved.x};
  Eigen::VectorXd residual, step;
  long k = 0;
  for (auto _ : state) {
    const Eigen::VectorXd& x = points[++k % 2];
    if (fresh) solver.refresh();
    residual = solved.balance.residual(x, omega);
    solver.solve(x, omega, residual, 1e-4 * scale, step);
    benchmark::DoNotOptimize(step.data());
  }
}
void newton_iteration(benchmark::State& state)
{
  iterate(state, true);
}
void kept_factors_iteration(benchmark::State& state)
{
  iterate(state, false);
}

/** The whole solution from the one with 6 harmonics. */
void solution(benchmark::State& state)
{
  Solved solved(state);
  const auto start = find_periodic({parameters(), omega, 6}).x;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        solve(solved.balance, omega, resize_harmonics(start, 2, solved.harmonics)));
  }
}

/** 1 to 60 Hz in equal steps: plans, tables and the bodies' motions included. */
void sweep_of_speeds(benchmark::State& state)
{
  const auto speeds = state.range(1);
  const int harmonics = static_cast<int>(state.range(0));
  std::vector<double> omegas;
  for (long k = 0; k < speeds; ++k)
    omegas.push_back(
        angular(1 + 59.0 * static_cast<double>(k) / static_cast<double>(speeds - 1)));
  for (auto _ : state) {
    const auto motions = sweep(parameters(), omegas, harmonics);
    benchmark::DoNotOptimize(motions.data());
  }
}

}  // namespace

BENCHMARK(square_roots)->Arg(6)->Arg(64);
BENCHMARK(force)->Arg(6)->Arg(64);
BENCHMARK(force_and_stiffness)->Arg(6)->Arg(64);
BENCHMARK(transforms)->Arg(6)->Arg(10)->Arg(64)->Arg(1024);
BENCHMARK(factorisation)->Arg(6)->Arg(10)->Arg(64);
BENCHMARK(newton_iteration)->Arg(6)->Arg(10)->Arg(64);
BENCHMARK(kept_factors_iteration)->Arg(6)->Arg(10)->Arg(64)->Arg(1024);
BENCHMARK(solution)->Arg(6)->Arg(16)->Arg(64)->Arg(256)->Arg(1024);
BENCHMARK(sweep_of_speeds)->Args({6, 119})->Args({6, 240})->Args({10, 240});
BENCHMARK_MAIN();
