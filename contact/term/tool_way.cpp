#include "contact/term/tool_way.h"

#include <Eigen/Geometry>

namespace billet::contact {

std::array<ToolWay, 2>
tool_ways(const ContactModel& model, std::size_t tool, const mechanics::Trial& trial) {
  const geometry::Motion& motion = model.tools[tool].motion;
  const geometry::Driven before = model.driven(tool, trial.x_old);
  const geometry::Driven now = model.driven(tool, trial.x);
  const Vec3 from = motion.translation(trial.time_old, before);
  const Vec3 to = motion.translation(trial.time, now);
  const double angle = motion.angle(trial.time, now) - motion.angle(trial.time_old, before);
  const Vec3 axis = motion.axis_point() + motion.offset;
  const Vec3 turn = angle * motion.axis();
  return {ToolWay{to - from, turn, axis + from}, ToolWay{to - from, turn, axis + to}};
}

} // namespace billet::contact
