/** Branches against closed forms: folds, closed and isolated branches, restarts, bounds. The branches of
   set 1 followed both ways and with half the step must have the same folds. */
#include "continuation/arc_length.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

/** f(x) = c(ω) for one constant unknown: solution sets that are known curves. */
Problem curve(double (*f)(double), double (*slope)(double),
              std::function<double(double)> c, std::function<double(double)> c_slope)
{
  return {.dofs = 1,
          .samples = 1,
          .residual_scale = 1,
          .unknown_scale = 1,
          .linear =
              [=](double omega, Harmonic, LinearBlock& block) {
                const SmallMatrix zero = SmallMatrix::Zero(1, 1);
                const SmallMatrix one = SmallMatrix::Identity(1, 1);
                block = {zero, one,  SmallVector::Constant(1, c(omega)),
                         zero, zero, SmallVector::Constant(1, c_slope(omega))};
              },
          .force =
              [=](const Eigen::MatrixXd& q, Eigen::MatrixXd& force,
                  Eigen::MatrixXd* stiffness) {
                force = q.unaryExpr([=](double x) { return f(x); });
                if (stiffness)
                  *stiffness = q.unaryExpr([=](double x) { return slope(x); });
              }};
}

/** x² + (ω - 2)² = r². */
Problem circle(double radius)
{
  return curve([](double x) { return x * x; }, [](double x) { return 2 * x; },
               [=](double w) { return radius * radius - (w - 2) * (w - 2); },
               [](double w) { return -2 * (w - 2); });
}

/** x³ - 3x = top - 4(ω - 2)². The cubic has the values 2 at -1 and -2 at 1: for -2 < top < 2 the
    solutions are a line x < -1 and a closed curve around x = 1; for top > 2, one line. */
Problem island(double top)
{
  return curve([](double x) { return x * x * x - 3 * x; },
               [](double x) { return 3 * x * x - 3; },
               [=](double w) { return top - 4 * (w - 2) * (w - 2); },
               [](double w) { return -8 * (w - 2); });
}

const ArcLengthSettings plain{.newton = {}, .speed_scale = 1, .arc_unknown_scale = 1};

Eigen::VectorXd at(double x)
{
  return Eigen::VectorXd::Constant(1, x);
}

Branch follow(const Parameters& parameters, int harmonics, int samples, double from,
              double to, double most_step)
{
  Balance balance(bearing_problem(parameters, samples), harmonics);
  ArcLengthSettings settings = arc_length_settings(parameters);
  settings.most_step = most_step;
  return follow_branch(balance, hertz(from), hertz(to),
                       find_periodic({parameters, hertz(from), harmonics, samples}).x,
                       settings);
}

/** A circle of radius 1 around the speed 2, once round. */
struct Round {
  Balance balance{circle(1), 0};
  BalanceCurve curve{balance, plain};
  Branch branch = follow_branch(curve, point_of(curve, 2, at(1), true), {0.5, 3.5});
};

std::vector<double> in_order(std::vector<double> folds)
{
  std::sort(folds.begin(), folds.end());
  return folds;
}

}  // namespace

TEST_CASE("A circle is followed once round and recognised as closed, either way")
{
  for (bool upwards : {true, false}) {
    Balance balance(circle(0.7), 0);
    BalanceCurve curve(balance, plain);
    const BranchPoint start = point_of(curve, 2, at(0.7), upwards);
    const Branch branch = follow_branch(curve, start, {0.5, 3.5});
    CHECK(branch.kind == BranchEnd::closed);
    CHECK_FALSE(branch.covered);
    check_same(in_order(branch.folds), {1.3, 2.7}, 1e-8);
    CHECK(branch.points.back().motion.omega == branch.points.front().motion.omega);
    CHECK(branch.points.back().motion.x == branch.points.front().motion.x);
    /** The chords of a circle are shorter than its arcs. */
    CHECK(branch.points.back().arc == Approx(2 * M_PI * 0.7).epsilon(1e-3));
    CHECK(follow_both_ways(curve, start, {0.5, 3.5}).covered);
  }
}

TEST_CASE("A closed branch that leaves the range is followed to both edges")
{
  Balance balance(circle(0.7), 0);
  BalanceCurve curve(balance, plain);
  const BranchPoint start = point_of(curve, 2.2, at(0.6), true);
  const Branch branch = follow_both_ways(curve, start, {2.0, 3.5});
  CHECK(branch.covered);
  CHECK(branch.points.front().motion.omega == 2.0);
  CHECK(branch.points.back().motion.omega == 2.0);
  CHECK(branch.points.front().motion.x[0] == Approx(0.7));
  CHECK(branch.points.back().motion.x[0] == Approx(-0.7));
  check_same(branch.folds, {2.7}, 1e-8);
}

TEST_CASE("An isolated branch is found from starts off the main one, once")
{
  Balance balance(island(1), 0);
  BalanceCurve curve(balance, plain);
  const Branch main = follow_branch(balance, 0.5, 3.5, at(-2), plain);
  REQUIRE(main.covered);
  CHECK(main.folds.empty());
  const std::vector<PeriodicMotion> candidates{
      {.omega = 1.5, .x = at(-1.9), .start = "main"},
      {.omega = 2.2, .x = at(1.5), .start = "first"},
      {.omega = 1.8, .x = at(0.5), .start = "second"}};
  const auto found = isolated_branches(curve, main, candidates, {0.5, 3.5});
  REQUIRE(found.size() == 1);
  CHECK(found[0].candidate.start == "first");
  CHECK(found[0].branch.kind == BranchEnd::closed);
  check_same(in_order(found[0].branch.folds),
             {2 - std::sqrt(3.0) / 2, 2 + std::sqrt(3.0) / 2}, 1e-8);

  /** Where the curve rises above the cubic's upper value the island has joined the line. */
  Balance joined(island(2.5), 0);
  BalanceCurve joined_curve(joined, plain);
  const Branch line = follow_branch(joined, 0.5, 3.5, at(-2), plain);
  REQUIRE(line.covered);
  const double inner = std::sqrt(0.5) / 2, outer = std::sqrt(4.5) / 2;
  check_same(line.folds, {2 - inner, 2 - outer, 2 + outer, 2 + inner}, 1e-8);
  CHECK(isolated_branches(joined_curve, line, {{.omega = 2.0, .x = at(2)}}, {0.5, 3.5})
            .empty());
}

TEST_CASE("Between two points of a branch a quantity's value and a speed are found")
{
  Round round;
  const auto quantity = [](const BranchPoint& p) { return p.motion.x[0] - 0.6; };
  int found = 0, passed = 0;
  for (std::size_t k = 1; k < round.branch.points.size(); ++k) {
    const BranchPoint &a = round.branch.points[k - 1], &b = round.branch.points[k];
    if (quantity(a) * quantity(b) >= 0)
      CHECK_THROWS_AS(locate(round.curve, a, b, quantity, 1e-10), NoSolution);
    else {
      const BranchPoint point = locate(round.curve, a, b, quantity, 1e-10);
      CHECK(std::abs(point.motion.omega - 2) == Approx(0.8).epsilon(1e-9));
      CHECK(point.arc > a.arc);
      CHECK(point.arc < b.arc);
      ++found;
    }
    if ((a.motion.omega - 2.3) * (b.motion.omega - 2.3) >= 0) continue;
    const BranchPoint point = point_between(round.curve, a, b, 2.3);
    CHECK(point.motion.omega == 2.3);
    CHECK(std::abs(point.motion.x[0]) == Approx(std::sqrt(0.91)));
    ++passed;
  }
  CHECK(found == 2);
  CHECK(passed == 2);
}

TEST_CASE("A step that passes an earlier point knows which way it goes")
{
  Round round;
  const Branch& branch = round.branch;
  Corrector corrector(round.curve);
  std::vector<BranchPoint> walked(branch.points.begin(), branch.points.begin() + 12);
  const auto passed_to = [&](const BranchPoint& next) {
    BranchHistory history;
    for (const BranchPoint& point : walked) history.add(point);
    return history.passed(corrector, walked, next);
  };
  CHECK_FALSE(passed_to(branch.points[12]));

  /** Back over the fifth to the fourth point. */
  walked.push_back(reversed(walked[5]));
  walked.back().arc = walked[11].arc + 1;
  BranchPoint next = reversed(walked[3]);
  next.arc = walked.back().arc + 0.1;
  const auto passed = passed_to(next);
  REQUIRE(passed);
  CHECK(passed->index >= 3);
  CHECK(passed->index <= 5);
  CHECK_FALSE(passed->same_direction);
}

TEST_CASE("The bound on work ends a branch, with what was found so far")
{
  const Parameters parameters = set_1();
  Balance balance(bearing_problem(parameters, 50), 6);
  ArcLengthSettings settings = arc_length_settings(parameters);
  settings.most_evaluations = 200;
  const Eigen::VectorXd x = find_periodic({parameters, hertz(1), 6, 50}).x;
  const Branch branch = follow_branch(balance, hertz(1), hertz(60), x, settings);
  CHECK(branch.kind == BranchEnd::work);
  CHECK_FALSE(branch.covered);
  CHECK(branch.points.size() > 10);
  CHECK(branch.evaluations >= 200);
  CHECK(branch.evaluations < 260);
  CHECK(branch.end.find("bound on work") != std::string::npos);
}

/** The same part of the branch whichever way it is followed, from any of its points, and with half the step. */
TEST_CASE("A branch has the same folds upwards and downwards and with half the step")
{
  const Parameters parameters = set_1();
  const Branch up = follow(parameters, 10, 21, 1, 60, 0.05);
  REQUIRE(up.covered);
  CHECK(up.folds.size() > 100);
  const std::vector<double> folds = in_order(up.folds);
  for (const Branch& other : {follow(parameters, 10, 21, 60, 1, 0.05),
                              follow(parameters, 10, 21, 1, 60, 0.025)}) {
    REQUIRE(other.covered);
    check_same(in_order(other.folds), folds, 1e-6);
  }
  Balance balance(bearing_problem(parameters, 21), 10);
  BalanceCurve curve(balance, arc_length_settings(parameters));
  const BranchPoint& middle = up.points[up.points.size() / 2];
  const SpeedRange range{hertz(1), hertz(60)};
  const Branch ahead = follow_branch(curve, middle, range);
  const Branch back = follow_branch(curve, reversed(middle), {range.to, range.from});
  const auto close = [](const BranchPoint& a, const BranchPoint& b) {
    return (a.motion.x - b.motion.x).norm() < 1e-8 * b.motion.x.norm();
  };
  CHECK(close(ahead.points.back(), up.points.back()));
  CHECK(close(back.points.back(), up.points.front()));
  std::vector<double> both = back.folds;
  both.insert(both.end(), ahead.folds.begin(), ahead.folds.end());
  check_same(in_order(both), folds, 1e-6);
}
