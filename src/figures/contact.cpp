#include "figures/contact.hpp"

#include "motion/contact.hpp"

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

Table contacts(SceneFile& file, Find find)
{
  const PanelScene scene = read_panels(file);
  Table table(scene.title, contact_fields);
  describe(table, scene);
  table.note(
      "modelled: the force of every ball over two periods, of the harmonic-balance "
      "solution or of the integrated motion, as the column `shown` says");
  each_panel(scene, find, [&](const Panel& panel) {
    const PanelRow row{panel, panel.shows_balance() ? 1 : 2};
    const auto all = motion::contact_evolution(scene.parameters, panel.shown());
    for (std::size_t k = 0; k < all.t_over_period.size(); ++k)
      for (std::size_t j = 0; j < all.ball_force[k].size(); ++j)
        table.row(contact_fields,
                  {row, all.t_over_period[k], j + 1, all.ball_force[k][j]});
    table.note(panel.ending);
  });
  return table;
}

}  // namespace rotor_stator::figures
