#include "contact/wear/wear.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

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

/// The point in a list that is sorted by their numbers; null: it is not there.
const ClosedPoint* find(std::span<const ClosedPoint> points, std::size_t point) {
  const auto found =
      std::lower_bound(points.begin(), points.end(), point,
                       [](const ClosedPoint& at, std::size_t p) { return at.point < p; });
  return found != points.end() && found->point == point ? &*found : nullptr;
}

/// How what rests has turned against a tool, as a vector in the tool's frame; 0: not at all.
Vec3 turn_between(const Mat3& tool, const Mat3& tool_before) {
  if (tool == tool_before)
    return Vec3::Zero();
  const Eigen::AngleAxisd turn(Mat3(tool.transpose() * tool_before));
  return turn.angle() * turn.axis();
}

/// Pressure over way in an increment in which a point opens, or closes unpredicted, while it
/// slides: on average half of the way, at half of the pressure. (W.10)
double edge_of_contact(double pressure, const Vec3& way, const Vec3& normal) {
  return 0.25 * pressure * (way - way.dot(normal) * normal).norm();
}

} // namespace

bool Wear::wanted(std::span<const Tool> tools) {
  return std::any_of(tools.begin(), tools.end(),
                     [](const Tool& tool) { return tool.wear.has_value(); });
}

Wear::Wear(const ContactSurface& surface, std::span<const Tool> tools, const Box& body)
    : surface_(&surface), tools_(tools), last_(tools.size()), maps_(tools.size()),
      workpiece_(tools.size()) {
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const Tool& tool = tools[t];
    rotation_.push_back(tool.motion.pose(0.0).rotation);
    if (!tool.wear)
      continue;
    maps_[t].emplace(*tool.surface, surface.analysis(), in_frame(body, tool.motion.pose(0.0)));
    if (tool.wear->workpiece)
      workpiece_[t] = WorkpieceWear{std::vector<double>(surface.n_points(), 0.0), 0.0};
  }
}

void Wear::change_surface(const ContactSurface& surface, std::span<const PointSource> sources) {
  surface_ = &surface;
  for (std::vector<ClosedPoint>& closed : last_)
    closed.clear(); // what the points of the old mesh did cannot be told of those of the new one
  for (std::optional<WorkpieceWear>& worn : workpiece_) {
    if (!worn)
      continue;
    std::vector<double> depth;
    depth.reserve(sources.size());
    for (const PointSource& source : sources) {
      double mean = 0.0;
      for (std::size_t i = 0; i < source.points.size(); ++i)
        mean += source.weights[i] * worn->depth[source.points[i]];
      depth.push_back(mean);
    }
    worn->depth = std::move(depth);
  }
}

void Wear::add(const ContactTerm& contact, std::span<const double> x, double time) {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    if (!maps_[t])
      continue;
    const geometry::Pose pose = contact.pose(t, time, x);
    const Place place{x, pose, turn_between(pose.rotation, rotation_[t])};
    rotation_[t] = pose.rotation;
    const std::vector<ClosedPoint>& closed = contact.closed()[t];
    for (const ClosedPoint& at : closed) {
      if (at.slip == 0.0)
        continue;
      double pressed_way = at.mean_pressure() * at.slip;
      const ClosedPoint* before = find(last_[t], at.point);
      if (before != nullptr && before->touching == 0.0)
        pressed_way += edge_of_contact(before->pressure, before->to - before->from, before->normal);
      wear_off(t, at, pressed_way, place, Vec3::Zero());
    }
    for (const CornerState& corner : corners(contact, t))
      if (corner.press.foot && !corner.press.traction.slip.isZero(0.0))
        wear_off(t, corner.press, place);
    if (contact.acts(t, time))
      leave(t, closed, place);
    last_[t] = closed;
  }
}

void Wear::leave(std::size_t tool, std::span<const ClosedPoint> closed, const Place& place) {
  std::vector<Vec3> positions;
  for (const ClosedPoint& before : last_[tool]) {
    if (before.slip == 0.0 || find(closed, before.point) != nullptr)
      continue;
    if (positions.empty()) {
      positions.resize(surface_->n_points());
      surface_->positions(place.x, positions);
    }
    const Vec3 way = place.pose.to_tool(positions[before.point]) - before.to;
    wear_off(tool, before, edge_of_contact(before.pressure, way, before.normal), place, -way);
  }
}

void Wear::wear_off(std::size_t tool,
                    const ClosedPoint& at,
                    double pressed_way,
                    const Place& place,
                    const Vec3& moved) {
  const PairWear& law = *tools_[tool].wear;
  Footprint footprint = in_frame(surface_->footprint(place.x, at.point), place.pose);
  for (Vec3& corner : footprint.corners)
    corner += moved;
  const double volume = law.tool.depth(pressed_way) * at.area; // (W.2)
  maps_[tool]->add(
      {footprint, at.foot, at.normal, at.to - at.from, volume, place.turn, tools_[tool].reference});
  if (!law.workpiece)
    return;
  const double depth = law.workpiece->depth(pressed_way); // (W.4)
  workpiece_[tool]->depth[at.point] += depth;
  workpiece_[tool]->volume += depth * at.area;
}

// The corner stays where it is on the tool; what it wears off the workpiece is laid where the
// closest contact point is.
void Wear::wear_off(std::size_t tool, const CornerPress& press, const Place& place) {
  const PairWear& law = *tools_[tool].wear;
  const double pressed_way = press.mean_pressure * press.traction.slip.norm();
  const Vec3 foot = place.pose.to_tool(press.place);
  const Vec2& n = press.foot->normal;
  const Vec3 normal = place.pose.rotation.transpose() * Vec3(n.x(), n.y(), 0.0);
  const std::size_t point = nearest_point(*surface_, *press.foot);
  const Footprint beside = in_frame(surface_->footprint(place.x, point), place.pose);
  const Vec3 along = 0.25 * (beside.corners[1] - beside.corners[0]).norm() *
                     Vec3::UnitZ().cross(normal); // half of its piece, on both sides
  const Footprint footprint{{foot - along, foot + along}, 2};
  maps_[tool]->add({footprint, foot, normal, Vec3::Zero(), law.tool.depth(pressed_way) * press.area,
                    Vec3::Zero(), tools_[tool].reference});
  if (!law.workpiece)
    return;
  const double volume = law.workpiece->depth(pressed_way) * press.area;
  std::vector<double> areas(surface_->n_points());
  surface_->areas(place.x, areas);
  workpiece_[tool]->depth[point] += volume / areas[point];
  workpiece_[tool]->volume += volume;
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
