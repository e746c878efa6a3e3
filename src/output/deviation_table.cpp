#include "output/deviation_table.hpp"

namespace rotor_stator
{

Table deviation_table(const DeviationScene& scene)
{
  Table table("Evidence for the deviations from the printed paper (paper/deviations.md)",
              {{"key", "-", "entry and name"},
               {"value", "-", "in the unit of its row"},
               {"unit", "-", "of the value"},
               {"meaning", "-", "what the value is"}});
  table.describe(scene.parameters);
  table.describe(scene.printed_parameters);
  for (const Evidence& e : compute_deviations(scene))
    table.row({e.key, e.value, e.unit, e.meaning});
  return table;
}

}  // namespace rotor_stator
