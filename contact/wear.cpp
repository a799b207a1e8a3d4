#include "contact/wear.h"

#include <algorithm>

namespace billet::contact {

namespace {

Box in_frame(const Box& box, const geometry::Pose& pose) {
  Box result;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p;
    for (int d = 0; d < 3; ++d)
      p[d] = ((corner >> d) & 1) != 0 ? box.high[d] : box.low[d];
    result.add(pose.to_tool(p));
  }
  return result;
}

Footprint in_frame(Footprint footprint, const geometry::Pose& pose) {
  for (Vec3& corner : footprint.corners)
    corner = pose.to_tool(corner);
  return footprint;
}

} // namespace

bool Wear::wanted(std::span<const Tool> tools) {
  return std::any_of(tools.begin(), tools.end(),
                     [](const Tool& tool) { return tool.wear.has_value(); });
}

Wear::Wear(const ContactSurface& surface, std::span<const Tool> tools, const Box& body)
    : surface_(&surface), tools_(tools), maps_(tools.size()), workpiece_(tools.size()) {
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const Tool& tool = tools[t];
    if (!tool.wear)
      continue;
    maps_[t].emplace(*tool.surface, surface.analysis(), in_frame(body, tool.motion.pose(0.0)));
    if (tool.wear->workpiece)
      workpiece_[t] = WorkpieceWear{std::vector<double>(surface.n_points(), 0.0), 0.0};
  }
}

void Wear::add(const ContactTerm& contact, std::span<const double> x, double time) {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    if (!maps_[t])
      continue;
    const PairWear& law = *tools_[t].wear;
    const geometry::Pose pose = contact.pose(t, time, x);
    for (const ClosedPoint& at : contact.closed()[t]) {
      if (at.slip == 0.0)
        continue;
      const double tool_volume = law.tool.depth(at.mean_pressure(), at.slip) * at.area; // (W.2)
      maps_[t]->add({in_frame(surface_->footprint(x, at.point), pose), at.foot, at.normal,
                     at.to - at.from, tool_volume});
      if (!law.workpiece)
        continue;
      const double depth = law.workpiece->depth(at.mean_pressure(), at.slip); // (W.4)
      workpiece_[t]->depth[at.point] += depth;
      workpiece_[t]->volume += depth * at.area;
    }
  }
}

std::vector<double> Wear::workpiece_depth() const {
  std::vector<double> sum;
  for (const std::optional<WorkpieceWear>& worn : workpiece_) {
    if (!worn)
      continue;
    sum.resize(worn->depth.size(), 0.0);
    for (std::size_t k = 0; k < sum.size(); ++k)
      sum[k] += worn->depth[k];
  }
  return sum;
}

} // namespace billet::contact
