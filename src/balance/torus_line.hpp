/**
# Two frequencies: samples along a closed line of the torus

The bearing's force depends on the rotor's angle θ_1 = ωt and on the passing of the balls,
θ_2 = n ω_cage t, with the period 2π in both (Eqs 3 to 6). Where n ω_cage/ω is not a whole
number, the motion is sought as

$$x = \sum_{(k_1, k_2)} x_{k_1 k_2}\, e^{i (k_1 \theta_1 + k_2 \theta_2)}.$$

The coefficients of the force at a motion do not depend on the two frequencies, so that
samples may be taken along any closed line θ_2 = z θ_1 with z whole: there the harmonic
(k_1, k_2) is the harmonic k_1 + z k_2 of one real transform (artificial frequency
mapping: Kundert 1990; a rank-1 lattice: Kämmerer, Potts and Volkmer 2015). The true
frequencies enter the linear blocks alone. N samples tell two harmonics apart unless one
is an image of the other: h' = ±h modulo N. A motion that has doubled also has halves of
k_1 and k_2: the line then closes after two turns. */
#pragma once

#include "balance/periodic_motion.hpp"
#include "model/base_period.hpp"

namespace rotor_stator {

/** The bearing whose cage turns so that samples at equal steps of ωt lie on the line;
    itself where the line is that of one frequency. */
Bearing bearing_along(const TorusLine& line, Bearing bearing);

/** k_1 + k_2 n ω_cage/ω, the frequency over the speed. */
double order_of(Harmonic h, const Bearing& bearing);

/** All (k_1, k_2) with |k_1| + |k_2| ≤ m; of each pair of opposite ones that of positive
    order, ascending. */
Harmonics orders_up_to(int m, const Bearing& bearing);

/** All up to an order, with |k_2| ≤ `passages`: whole numbers and, where `half` is not
    (0, 0), those moved by it. */
Harmonics up_to(double order, int passages, const Bearing& bearing, Harmonic half = {});

/** `first`, then what else `others` have. */
Harmonics joined(const Harmonics& first, const Harmonics& others);

/** A line with few samples, at least so many, on which no image of any of the `others`
    falls on one of the `kept`, nor of one of these on another. Kept ones among the others
    do no harm. */
TorusLine line_without_images(const Harmonics& kept, const Harmonics& others,
                              int least_samples = 32, int turns = 1);

}  // namespace rotor_stator
