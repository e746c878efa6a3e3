#include "figures/contact.hpp"

namespace rotor_stator::figures {

namespace {

struct ContactRow : PanelRow {
  double t_over_period;
  std::size_t ball;
  double force;
};

const auto contact_fields = with_panel_fields<ContactRow>({
    {"t_over_T", "-", "time over the period, 0 to 2", &ContactRow::t_over_period},
    {"ball", "-", "j of Eq. 3", &ContactRow::ball},
    {"Q", "N", "Eq. 5, force of the ball", &ContactRow::force},
});

}  // namespace

Table contact_table(const PanelScene& scene)
{
  Table table(scene.title, contact_fields);
  describe(table, scene);
  table.note(
      "modelled: the force of every ball over two periods, of the harmonic-balance "
      "solution or of the integrated motion, as the column `shown` says");
  return table;
}

void add_contact(Table& table, const Panel& panel,
                 const motion::ContactEvolution& evolution)
{
  table.note(panel.ending);
  const PanelRow row{panel, panel.shows_balance() ? 1 : 2};
  for (std::size_t k = 0; k < evolution.t_over_period.size(); ++k)
    for (std::size_t j = 0; j < evolution.ball_force[k].size(); ++j)
      table.row(contact_fields,
                {row, evolution.t_over_period[k], j + 1, evolution.ball_force[k][j]});
}

}  // namespace rotor_stator::figures
