/**
# The motion after a start

Eq. 7 is integrated from a state, together with a neighbour (trajectory_pair.hpp). A
transient that decays is over when their distance has shrunk to 1e-9 of its largest value;
to the square of that, while there is time, if it grew like chaos before.
The mean growth rate λ of the distance, the largest Lyapunov exponent, and the Poincaré
section decide the kind of the motion, the first of these that holds:

- `rest`: half of the range of every displacement, and speed times base period, are below
  1e-12 of clearance plus static deflection.
- `periodic`: the section, one point in each base period, repeats itself to 1e-6 of the
  vibration after K ≤ 16 of them, the smallest such K; where two frequencies drive, K = 1
  turn, as of a rotor that touches nothing.
- `chaotic`: λ > 2d, or λ > d after half of `longest`, and the growth does not fade: in
  the last quarter it is at least e⁵, and more than the root of that in the quarter
  before.
- `quasi-periodic`: two frequencies drive, λ + d < 0 and the transient is over (the motion
  follows them); or one drives, and |λ| ≤ d < 0.1/s after half of `longest`.
- `undecided`: everything else, with the reason.

λ comes with its standard error s, from ten batches of the later half of all that was
integrated; d is 3s plus the error of λ by the step. `chaotic` and `quasi-periodic` are
decided after 4 to 50 s at the earliest.

Integration starts at or before t = 0. It ends before t = 0 only if one frequency drives,
neighbours have converged by 1e-9 and the motion is at rest or closes; a periodic motion
then begins at t = 0. The state of a motion that two frequencies drive belongs to its
instant. If it is quasi-periodic and reached after t = 0, the state is assigned to an
instant so early that the difference decays by t = 0, and integrated from there, if that
takes at most 1e8 evaluations and the budget has them. Every other motion begins where the
integration ended.

    const BasePeriod base = base_period(parameters);
    const auto [machine, omega] = over(base, parameters, angular(25));
    const Settled settled =
        settle(machine, omega, base, from_rest(machine, omega), {}, budget);

An impact may make the contact vibrate too fast for the step: the integration then
diverges, or sustains a motion that Eq. 7 does not have. The motion found is therefore
followed for one base period with a quarter of the step, for 32 where it is said to be
quasi-periodic though one frequency drives. If that leads elsewhere, or if integration
diverged, it is repeated once with such steps; with a fixed step the motion is
`undecided`, or lost. It goes on with such steps of rk4 if one frequency drives and
neighbours meet on a motion that does not close, or if they part so slowly that chaos is
found after half of `longest` only, and not at the first look: longer steps may lock a
torus to many turns, or keep up the growth.

A `Settling` does the same side by side with others (side_by_side.hpp). The machine is
that of `over`, whose angles are counted per base period; where two frequencies drive, per
turn. */
#pragma once

#include <string>

#include "model/base_period.hpp"
#include "time/side_by_side.hpp"
#include "time/trajectory_pair.hpp"

namespace rotor_stator {

enum class Kind { undecided, rest, periodic, quasi_periodic, chaotic };
const char* word(Kind kind);

struct SettleRule {
  std::string method = "auto";  ///< or "rk4"
  double step = 0;              ///< longest of rk4 [s]; 0: `step_at`; at most T/32
  bool is_fixed = false;        ///< the step is kept where it is too long
  double longest = 0;  ///< after t = 0 [s]; 0: 40 over the slowest decay rate, 60 to 1000
};

struct Settled {
  Kind kind = Kind::undecided;
  int period = 0;          ///< K of a closed section, else 0
  Exponent lyapunov{0};    ///< λ and its standard error [1/s]
  double doubt = 0;        ///< d [1/s]
  bool contracts = false;  ///< λ + d < 0, by 1 % of the distance at least
  double remainder = 1;    ///< what the contraction has left of any distance [-]
  Instant at;              ///< a state on the motion: see above
  double step = 0;         ///< longest of rk4 that was taken, or of the same error [s]
  Instant before;      ///< since this one distances shrank by 1e-7: other steps forget it
  double seconds = 0;  ///< integrated with these steps
  double evaluations = 0;   ///< of Eq. 7
  std::string reason = {};  ///< why it is undecided
};

class Settling : public Traveller {
public:
  /** Throws NoSolution when a period would need too many steps. */
  Settling(const Parameters& machine, double omega, const BasePeriod& base,
           const Instant& start, const SettleRule& rule = {},
           const OperationBudget& budget = {});

  void next(std::vector<Passage>& all) override;
  void arrived() override;
  void lost(std::exception_ptr why) override;

  /** What it came to. Throws NoSolution when the integration broke down or the motion
      grows without bound. A budget that ended leaves what is known, undecided. */
  const Settled& settled() const;

private:
  std::unique_ptr<Flow> flow_of(double step, int intervals) const;
  TrajectoryPair pair_from_start() const;
  void look();
  template <class See>
  void follow_by_both(int periods, const See& see);
  bool is_resolved();
  bool wobble_is_resolved();
  bool is_over() const;
  bool is_subtle() const;
  void begin_anew();
  Settled seen() const;
  bool is_at_rest() const;
  bool closes(Settled& s) const;
  bool grows_throughout() const;
  bool can_be_put_on_zero() const;
  void put_on_zero();

  Parameters machine_;
  double omega_;
  BasePeriod base_;
  SettleRule rule_;
  OperationBudget budget_;
  double length_, least_;  ///< [m], [s]
  Instant start_;
  TrajectoryPair pair_;
  double spent_beside_ = 0;                  ///< evaluations that are not of the pair
  std::size_t periods_ = 0;                  ///< until the pair is looked at again
  double began_ = -1;                        ///< seconds that it had when looked at first
  std::unique_ptr<Flow> to_zero_ = nullptr;  ///< on the way to t = 0
  Instant at_ = {}, before_ = {};            ///< then
  Settled settled_ = {};
  bool has_ended_ = false;
  std::exception_ptr lost_ = nullptr;
};

/** One alone. */
Settled settle(const Parameters& machine, double omega, const BasePeriod& base,
               const Instant& start, const SettleRule& rule = {},
               const OperationBudget& budget = {});

/** Eigenvalues [1/s] of the four free modes of both bodies joined in one direction by a
    linear stiffness [N/m]: decay rates and frequencies. None where they overflow. */
Eigen::VectorXcd free_modes(const Parameters& machine, double joint_stiffness);

/** The largest difference of two states, over the sizes of their components [-]. */
double apart(const Parameters& machine, const State& a, const State& b);

/** At rest in static equilibrium with ball 1 at the angle that it has there, so long
    before t = 0 that a linear machine has forgotten its start: 25 over its slowest decay
    rate, 4 to 25 s, in whole turns. */
Instant from_rest(const Parameters& machine, double omega);

}  // namespace rotor_stator
