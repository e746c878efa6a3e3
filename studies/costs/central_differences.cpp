#include "costs/central_differences.hpp"

#include "io/errors.hpp"
#include "time/fixed_step.hpp"
#include "time/turns.hpp"

namespace rotor_stator::costs {

namespace {

/** q at a whole step; v half a step before it, or at its beginning. */
struct Leap {
  Equation7<double> equation;
  BallRing ring;
  ContactLaw<double> law;
  Angles at, by;
  double h;
  Bodies q, v;

  /** The speeds go on by `length`, half of it before and half behind q: the damping acts
      on their mean. */
  IN_PLACE void kick(double length)
  {
    const Vec2 f = bearing_force<false>(ring, law, at.cage, q.relative(), Vec2{0, 0});
    const Bodies a = equation.acceleration(q, {}, at.rotor, f);
    const double stator = 0.5 * length * equation.c_s * equation.per_m_s;
    const double rotor = 0.5 * length * equation.c_r * equation.per_m_r;
    v = {1 / (1 + stator) * ((1 - stator) * v.stator + length * a.stator),
         1 / (1 + rotor) * ((1 - rotor) * v.rotor + length * a.rotor)};
  }
  IN_PLACE void drift()
  {
    q = q + h * v;
    at = turned(at, by);
  }

  /** So many drifts, kicked between them; by half a kick the speeds leave a whole step
      and come to one. */
  void advance(long steps)
  {
    in_registers(
        widest_registers(), [&]() __attribute__((always_inline)) {
          kick(0.5 * h);
          for (long k = 1; k < steps; ++k) {
            drift();
            kick(h);
          }
          drift();
          kick(0.5 * h);
        });
  }
};

class CentralDifferences : public Flow {
public:
  CentralDifferences(const Parameters& parameters, double omega, int intervals,
                     double longest_step)
      : system_(parameters, omega), turns_(Turns::of(parameters)), intervals_(intervals),
        steps_(steps_in_interval(system_.period(), intervals, longest_step)),
        h_(system_.period() / (static_cast<double>(intervals) * steps_))
  {
  }

  void advance(long interval, State& state) override
  {
    const long part = ((interval % intervals_) + intervals_) % intervals_;
    const double all = static_cast<double>(intervals_) * steps_;
    Leap one{system_.equation(),
             system_.bearing().ring(),
             system_.bearing().law(),
             turns_.at(static_cast<double>((interval - part) / intervals_),
                       static_cast<double>(part) / intervals_),
             turns_.by(1 / all),
             h_,
             state.position,
             state.velocity};
    one.advance(steps_);
    state.position = one.q;
    state.velocity = one.v;
    evaluations_ += steps_ + 1;
  }

  long evaluations() const override { return evaluations_; }

private:
  RotorStator system_;
  Turns turns_;
  int intervals_, steps_;
  double h_;
  long evaluations_ = 0;
};

}  // namespace

std::unique_ptr<Flow> central_differences(const Parameters& parameters, double omega,
                                          int intervals, double longest_step)
{
  if (!parameters.bearing.is_elastic_hertz())
    throw BadInput("central: knows no contact damping and no defect");
  return std::make_unique<CentralDifferences>(parameters, omega, intervals, longest_step);
}

}  // namespace rotor_stator::costs
