/**
# Evidence on the samples of a period (§3.1)

What Γ takes to harmonics, and what too few samples fold onto them. */
#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "model/errors.hpp"
#include "scenes/evidence.hpp"
#include "scenes/printed_equations.hpp"
#include "scenes/response.hpp"

namespace rotor_stator
{

namespace
{

Branch branch_over_range(const DeviationScene& scene, int harmonics, int samples)
{
  const Parameters& parameters = scene.parameters;
  const double from = angular(scene.range.front()), to = angular(scene.range.back());
  Balance balance(bearing_problem(parameters, samples), harmonics);
  return follow_branch(balance, from, to, quasi_static_start(parameters, from, harmonics),
                       arc_length_settings(parameters));
}

/** What m harmonics with N samples give: folds, and the distance to the true motion. */
void add_sampled(EvidenceList& list, const DeviationScene& scene, int m, int n,
                 const Motion& truth)
{
  const Branch branch = branch_over_range(scene, m, n);
  const std::string where = text("_m%d_N%d", m, n), with = text("m = %d, N = %d", m, n);
  const auto solution = require_periodic(scene.parameters, scene.speed, m, n);
  list.push_back({"D-05.folds" + where, static_cast<double>(branch.folds.size()), "-",
                  "folds of the branch, " + with});
  list.push_back({"D-05.end" + where, branch.points.back().omega / angular(1), "Hz",
                  "speed where the branch ended, " + with + ": " + branch.end});
  list.push_back({"D-05.error" + where,
                  relative_difference(motion_of(solution.bodies, points(scene)), truth),
                  "-", "distance to time integration, " + with});
}

}  // namespace

EvidenceList names_of_gamma(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = 2 * m + 1;
  const Eigen::MatrixXd series =
      require_periodic(scene.parameters, scene.speed, m, default_samples(m)).bodies;
  const Eigen::MatrixXd gamma = gamma_matrix(m, n, Argument::parenthesised);
  const Eigen::MatrixXd truth = gamma_inverse(m, n) * series.transpose();
  const Eigen::MatrixXd as_text = gamma * series.transpose();
  return {{"D-04.speed", scene.speed, "Hz", "speed of the solution"},
          {"D-04.error_text", (as_text - truth).norm() / truth.norm(), "-",
           "samples with gamma taken as frequency to time, over the true ones: distance"},
          {"D-04.error_ours", (sample_series(series, n) - truth).norm() / truth.norm(),
           "-", "the same with our transforms"},
          {"D-04.size_text", as_text.cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff(),
           "-", "largest displacement of the text's samples over the true one"}};
}

EvidenceList samples_as_printed(const DeviationScene& scene)
{
  const Motion truth = integrated(scene, scene.speed);
  EvidenceList list{
      {"D-05.speed", scene.speed, "Hz", "speed of the errors"},
      {"D-05.from", scene.range.front(), "Hz", "first speed of the branches"},
      {"D-05.to", scene.range.back(), "Hz", "last speed of the branches"}};
  for (int m : scene.sampled_harmonics) {
    std::vector<int> counts{2 * m + 1, 4 * m + 1};
    counts.insert(counts.end(), scene.common_samples.begin(), scene.common_samples.end());
    for (int n : counts) add_sampled(list, scene, m, n, truth);
  }
  return list;
}

EvidenceList default_sample_count(const DeviationScene& scene)
{
  const int m = scene.harmonics;
  const auto motion = [&](int n) {
    return motion_of(require_periodic(scene.parameters, scene.speed, m, n).bodies,
                     points(scene));
  };
  const Motion fine = motion(scene.fine_samples), truth = integrated(scene, scene.speed);
  const int n = default_samples(m);
  return {{"D-14.speed", scene.speed, "Hz", "speed of the errors"},
          {"D-14.samples", static_cast<double>(n), "-", text("our N for m = %d", m)},
          {"D-14.samples_printed", 2.0 * m + 1, "-", "the printed N"},
          {"D-14.samples_fine", static_cast<double>(scene.fine_samples), "-",
           "the N that stands for exact"},
          {"D-14.sampling_ours", relative_difference(motion(n), fine), "-",
           "error of sampling with our N"},
          {"D-14.sampling_printed", relative_difference(motion(2 * m + 1), fine), "-",
           "error of sampling with the printed N"},
          {"D-14.truncation", relative_difference(fine, truth), "-",
           "error of the truncated series, sampled finely"}};
}

EvidenceList parentheses_of_gamma(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = 2 * m + 1;
  const Eigen::MatrixXd inverse = gamma_inverse(m, n);
  const auto defect = [&](Argument argument) {
    const Eigen::MatrixXd product = gamma_matrix(m, n, argument) * inverse;
    return (product - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
  };
  const Eigen::MatrixXd series =
      require_periodic(scene.parameters, scene.speed, m, default_samples(m)).bodies;
  const Eigen::MatrixXd back =
      gamma_matrix(m, n, Argument::printed) * inverse * series.transpose();
  return {
      {"D-21.printed", defect(Argument::printed), "-",
       "largest entry of gamma times its inverse minus one, arguments as printed"},
      {"D-21.ours", defect(Argument::parenthesised), "-", "the same with parentheses"},
      {"D-21.back_printed", (back - series.transpose()).norm() / series.norm(), "-",
       "coefficients after one return trip to samples, as printed: relative distance"}};
}

}  // namespace rotor_stator
