/** The page knows machines of two masses only: bodies given by matrices come from files, which a page cannot read,
    and their code is a fifth of the module. */
#include <cstdlib>

#include "balance/large_problem.hpp"
#include "time/gauss.hpp"
#include "io/errors.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator {

void read_large_machine(StrictToml& root, Parameters&, const ModelRange&)
{
  throw BadInput(root.file() + ": bodies given by matrices need the program explore");
}

/** Without such bodies none of these is called. */
void put_large_bodies(const Parameters&, const TorusLine&, Problem&) { abort(); }
Eigen::MatrixXd large_start_samples(const Parameters&, double, int) { abort(); }
Eigen::MatrixXd shown_series(const Parameters&, const PeriodicMotion&) { abort(); }
Eigen::MatrixXd coordinate_series(const Parameters&, const PeriodicMotion&) { abort(); }
void fit_receptances(const Parameters&, double, int) { abort(); }
State large_static_start(const Parameters&) { abort(); }
Eigen::VectorXd large_state_scales(const Parameters&) { abort(); }
GaussStepper::GaussStepper(const Parameters&, double, int, double,
                           OperationBudget)
{
  abort();
}
void GaussStepper::advance(long, State&) { abort(); }
Eigen::MatrixXd GaussStepper::derivative(long, const State&) { abort(); }

}  // namespace rotor_stator
