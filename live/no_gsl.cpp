/** GSL's steppers are for comparison with ours: the page has none of them. */
#include "io/errors.hpp"
#include "time/gsl.hpp"

namespace rotor_stator {

std::vector<std::string> gsl_methods()
{
  return {};
}

std::unique_ptr<Flow> gsl_flow(const Parameters&, double, const StepSettings& settings)
{
  throw BadInput("--method " + settings.method + ": needs the program explore");
}

}  // namespace rotor_stator
