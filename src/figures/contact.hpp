/**
# The contact of the balls (Figs 7 and 9, code)

The force of every ball over two periods of rotation: a cage at half the rotor's speed
turns once in this time, and each ball meets a load that turns with the rotor once (D-11,
D-20). */
#pragma once

#include "figures/panels.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::figures {

/** The table before its first panel. */
Table contact_table(const PanelScene& scene);

/** The ball forces of the motion that a panel shows, one row per instant and ball. */
void add_contact(Table& table, const Panel& panel,
                 const motion::ContactEvolution& evolution);

}  // namespace rotor_stator::figures
