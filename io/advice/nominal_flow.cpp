#include "io/advice/nominal_flow.h"

#include "geometry/base/box.h"
#include "io/advice/backing.h"
#include "io/advice/part_ends.h"
#include "io/advice/tool_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace billet::io {

namespace {

constexpr double touching_share = 1e-4; // of the part's size, as process/tool_reach has it

/// Whether motions are given and straight.
bool is_pressed_by_ways(const process::Scene& scene) {
  return scene.part.loads.empty() &&
         std::none_of(scene.tools.begin(), scene.tools.end(), [](const contact::Tool& tool) {
           return tool.motion.force || tool.motion.torque || tool.motion.rotation;
         });
}

/// The node that lies deepest in a tool, and all that lie half as deep.
struct DeepestNode {
  double depth = 0.0;         ///< [mm]; 0: none lies in it
  Vec3 normal = Vec3::Zero(); ///< of the tool there, in space
  std::vector<Vec3> nodes;
};

DeepestNode
deepest_in(const contact::Tool& tool, double time, std::span<const Vec3> nodes, double reach) {
  const geometry::Pose pose = tool.motion.pose(time);
  std::vector<Vec3> places;
  for (const Vec3& x : nodes)
    places.push_back(pose.to_tool(x));
  std::vector<geometry::Projection> feet(places.size());
  tool.surface->project(places, reach, feet);
  DeepestNode deepest;
  for (const geometry::Projection& foot : feet)
    if (foot.found() && -foot.gap > deepest.depth)
      deepest = {-foot.gap, pose.rotation * foot.normal, {}};
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (feet[n].found() && deepest.depth > 0.0 && -feet[n].gap >= 0.5 * deepest.depth)
      deepest.nodes.push_back(nodes[n]);
  return deepest;
}

/// Where a tool was when it came to the part, and how it came.
struct Arrival {
  int axis;
  std::size_t end;         ///< it comes from, 0: low
  double at;               ///< way along the axis at which it touches [mm], rising as it goes in
  std::vector<Vec3> nodes; ///< that it comes to first
};

/// The way that both ends of the part have been pushed in along the axes.
struct Closing {
  std::array<std::array<double, 2>, 3> by_tools = {}; ///< shape (axis, end) [mm]
  std::array<double, 3> by_supports = {};             ///< may be negative [mm]

  [[nodiscard]] double sum(int axis) const {
    return by_tools[idx(axis)][0] + by_tools[idx(axis)][1] + by_supports[idx(axis)];
  }
};

/// One tool's motion in a step: the axis it goes along and the end it comes from; none: it rests or
/// goes across.
struct Push {
  int axis;
  std::size_t end; ///< 0: low
};
std::optional<Push> push_of(const contact::Tool& tool, double from, double to) {
  constexpr double mostly = 0.95;
  const Vec3 way = tool.motion.translation(to) - tool.motion.translation(from);
  int axis = 0;
  const double along = way.cwiseAbs().maxCoeff(&axis);
  if (along == 0.0 || along < mostly * way.norm())
    return std::nullopt;
  return Push{axis, way[axis] < 0.0 ? std::size_t{1} : std::size_t{0}};
}

/// The part under its tools, look by look.
class PressedPart {
public:
  explicit PressedPart(const process::Scene& scene)
      : scene_(scene), nodes_(contact_nodes(scene, most_nodes)),
        size_(process::body_size(scene.part.mesh)), looks_(looks_at(scene)) {
    follow();
  }

  /// What the looks tell of an axis; none: its height stays.
  [[nodiscard]] std::optional<NominalFlow> along(int axis) const;
  /// Whether the part is held at both ends of an axis, by whole ends or where it lies between
  /// tools.
  [[nodiscard]] bool is_between(int axis) const;

private:
  static constexpr std::size_t most_nodes = 300;

  void follow();
  void push(std::size_t tool, const Look& from, const Look& to, Closing& closing);
  [[nodiscard]] double moved_ends(int axis, double time) const;

  const process::Scene& scene_;
  std::vector<Vec3> nodes_;
  double size_;
  std::vector<Look> looks_;
  std::vector<Closing> closings_;                  ///< shape (looks)
  std::vector<std::optional<Arrival>> arrivals_;   ///< shape (tools)
  std::array<std::vector<char>, 3> pressing_ = {}; ///< shape (axis, tools)
  double first_touch_ = std::numeric_limits<double>::infinity();
  double last_touch_ = 0.0;
};

/// How far supports have brought the ends together [mm].
double PressedPart::moved_ends(int axis, double time) const {
  double closing = 0.0;
  if (const TimeFunction* const high = hold_of(scene_.part, axis, End::high, axis))
    closing -= (*high)(time);
  if (const TimeFunction* const low = hold_of(scene_.part, axis, End::low, axis))
    closing += (*low)(time);
  return closing;
}

void PressedPart::push(std::size_t t, const Look& from, const Look& to, Closing& closing) {
  constexpr double facing = 0.3; // else it goes along the surface
  const contact::Tool& tool = scene_.tools[t];
  const std::optional<Push> way = push_of(tool, from.time, to.time);
  if (!to.acts(scene_, t))
    return;
  std::optional<Arrival>& arrival = arrivals_[t];
  if (arrival)
    last_touch_ = std::max(last_touch_, to.time);
  if (!way)
    return;
  const double sign = way->end == 0 ? 1.0 : -1.0;
  const double gone = sign * tool.motion.translation(to.time)[way->axis];
  if (!arrival) {
    DeepestNode deepest = deepest_in(tool, to.time, nodes_, 10.0 * size_);
    if (deepest.depth < touching_share * size_ || sign * deepest.normal[way->axis] < facing)
      return;
    arrival = Arrival{way->axis, way->end, gone - deepest.depth, std::move(deepest.nodes)};
    first_touch_ = std::min(first_touch_, from.time);
    last_touch_ = std::max(last_touch_, to.time);
  }
  if (arrival->axis != way->axis || arrival->end != way->end)
    return;
  double& in = closing.by_tools[idx(way->axis)][way->end];
  if (gone - arrival->at > in) {
    in = gone - arrival->at;
    pressing_[idx(way->axis)][t] = 1;
  }
}

void PressedPart::follow() {
  arrivals_.resize(scene_.tools.size());
  for (std::vector<char>& tools : pressing_)
    tools.assign(scene_.tools.size(), 0);
  closings_.resize(looks_.size());
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    if (k > 0) {
      closings_[k] = closings_[k - 1];
      for (std::size_t t = 0; t < scene_.tools.size(); ++t)
        push(t, looks_[k - 1], looks_[k], closings_[k]);
    }
    for (int axis = 0; axis < scene_.part.mesh.dimension(); ++axis)
      closings_[k].by_supports[idx(axis)] = moved_ends(axis, looks_[k].time);
  }
}

bool PressedPart::is_between(int axis) const {
  std::array<std::vector<Vec3>, 2> backed;
  bool is_whole_end = false;
  for (const End end : {End::low, End::high}) {
    const std::size_t side = end == End::low ? 0 : 1;
    backed[side] = nodes_at_tools(scene_, axis, end, nodes_);
    for (const std::optional<Arrival>& arrival : arrivals_)
      if (arrival && arrival->axis == axis && arrival->end == side)
        backed[side].insert(backed[side].end(), arrival->nodes.begin(), arrival->nodes.end());
    if (hold_of(scene_.part, axis, end, axis) != nullptr)
      is_whole_end = true;
    else if (backed[side].empty())
      return false;
  }
  const Box box = box_of(scene_.part.mesh.points);
  return is_whole_end || are_opposite(backed[0], backed[1], axis, box.high[axis] - box.low[axis]);
}

std::optional<NominalFlow> PressedPart::along(int axis) const {
  constexpr double least_left = 0.03, hardly = 1e-9; // of the height
  const Box box = box_of(scene_.part.mesh.points);
  NominalFlow flow;
  flow.axis = axis;
  flow.height = box.high[axis] - box.low[axis];
  double before = flow.height;
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    const double height = flow.height - closings_[k].sum(axis);
    if (height < least_left * flow.height)
      return std::nullopt;
    const double strain = std::abs(std::log(flow.height / height));
    if (strain > flow.strain) {
      flow.strain = strain;
      flow.compresses = height < flow.height;
      flow.deepest = looks_[k].time;
    }
    const double change = std::abs(height - before);
    const double dt = k > 0 ? looks_[k].time - looks_[k - 1].time : 0.0;
    if (dt > 0.0 && change > hardly * flow.height) {
      flow.duration += dt;
      flow.rate = std::max(flow.rate, change / (dt * height));
      flow.speed = std::max(flow.speed, change / dt);
    }
    before = height;
  }
  if (flow.strain == 0.0)
    return std::nullopt;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t)
    if (pressing_[idx(axis)][t] != 0)
      flow.pressing.push_back(t);
  flow.contact_time = std::max(0.0, last_touch_ - first_touch_);
  return flow;
}

/// Extent along an axis, of the whole part where a plane of symmetry cuts it [mm].
double whole_extent(const process::Part& part, int axis) {
  const Box box = box_of(part.mesh.points);
  const double extent = box.high[axis] - box.low[axis];
  const bool is_half = is_mirror(part, axis, End::low) || is_mirror(part, axis, End::high);
  return is_half ? 2.0 * extent : extent;
}

} // namespace

double width_across(const process::Part& part, int axis) {
  constexpr double on_axis = 1e-6;
  const Box box = box_of(part.mesh.points);
  if (part.analysis == mechanics::Analysis::axisymmetric && axis == 1)
    return box.low[0] > on_axis * box.size() ? box.high[0] - box.low[0] : 2.0 * box.high[0];
  double width = std::numeric_limits<double>::infinity();
  for (int other = 0; other < part.mesh.dimension(); ++other)
    if (other != axis && (hold_of(part, other, End::low, other) == nullptr ||
                          hold_of(part, other, End::high, other) == nullptr))
      width = std::min(width, whole_extent(part, other));
  return width;
}

std::optional<NominalFlow> nominal_flow(const process::Scene& scene) {
  constexpr double least_solid = 0.4; // a ring, a frame or a bent sheet is not pressed as a whole
  if (!is_pressed_by_ways(scene) || solid_share(scene.part) < least_solid)
    return std::nullopt;
  const PressedPart pressed(scene);
  std::optional<NominalFlow> most;
  for (int axis = 0; axis < scene.part.mesh.dimension(); ++axis) {
    if (scene.part.analysis == mechanics::Analysis::axisymmetric && axis == 0)
      continue; // tools do not move along the radius
    std::optional<NominalFlow> flow = pressed.along(axis);
    if (!flow || (most && most->strain >= flow->strain) || !pressed.is_between(axis))
      continue;
    most = std::move(flow);
  }
  if (!most)
    return std::nullopt;
  most->width = width_across(scene.part, most->axis);
  most->thickness = std::min(most->width, whole_extent(scene.part, most->axis));
  return most;
}

} // namespace billet::io
