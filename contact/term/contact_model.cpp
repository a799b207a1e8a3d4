#include "contact/term/contact_model.h"

#include <Eigen/Geometry>

namespace billet::contact {

std::vector<DriveUnknown> drive_unknowns(std::span<const Tool> tools) {
  std::vector<DriveUnknown> drives;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (tools[t].motion.force)
      drives.push_back({t, false});
    if (tools[t].motion.torque)
      drives.push_back({t, true});
  }
  return drives;
}

ContactModel::ContactModel(const ContactSurface& its_surface,
                           const mechanics::Bulk& its_bulk,
                           const mechanics::BlockPattern& its_pattern,
                           std::span<const Tool> all_tools,
                           double its_reach,
                           const DriveScale& its_scale)
    : surface(&its_surface), bulk(&its_bulk), pattern(&its_pattern), tools(all_tools),
      reach(its_reach), drives(drive_unknowns(all_tools)), scale(its_scale) {
  for (const Tool& tool : tools)
    corners.emplace_back(*surface, *tool.surface);
}

geometry::Driven ContactModel::driven(std::size_t tool, std::span<const double> x) const {
  const auto n = idx(pattern->n_dofs());
  geometry::Driven driven;
  for (std::size_t j = 0; j < drives.size(); ++j)
    if (drives[j].tool == tool)
      (drives[j].turns ? driven.turn : driven.travel) =
          drives[j].turns ? x[n + j] / scale.length : x[n + j];
  return driven;
}

DriveRate ContactModel::drive_rate(const DriveUnknown& drive,
                                   double time,
                                   std::span<const double> x,
                                   const Vec3& position) const {
  const geometry::Motion& motion = tools[drive.tool].motion;
  if (!drive.turns)
    return {motion.force->axis, Vec3::Zero()};
  const Vec3 on_axis =
      motion.torque->point + motion.offset + motion.translation(time, driven(drive.tool, x));
  const Vec3 spin = motion.torque->axis / scale.length;
  return {spin.cross(position - on_axis), spin};
}

} // namespace billet::contact
