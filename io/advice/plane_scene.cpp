// A scene of space that one of the plane would show: solids of revolution and of equal sections.

#include "geometry/base/box.h"
#include "io/advice/advice_parts.h"
#include "io/advice/node_finder.h"
#include "io/advice/part_ends.h"
#include "io/advice/tool_samples.h"
#include "mechanics/mesh/mesh_edges.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace billet::io {

namespace {

using mechanics::Index;
using process::Scene;

/// The two axes across one, so that the three turn to the right.
std::array<int, 2> across(int axis) { return {(axis + 1) % 3, (axis + 2) % 3}; }

// --- Tools ----------------------------------------------------------------------------------

/// Whether tools move along an axis only and rub alike in all directions.
bool are_tools_along(const Scene& scene, int axis) {
  constexpr double same_way = 1e-6;
  const double size = process::body_size(scene.part.mesh);
  for (const contact::Tool& tool : scene.tools) {
    const geometry::Motion& motion = tool.motion;
    if (motion.rotation || motion.torque || tool.friction.tensor ||
        (motion.force && std::abs(motion.force->axis[axis]) < 1.0 - same_way))
      return false;
    for (const Look& look : looks_at(scene)) {
      Vec3 way = motion.translation(look.time);
      way[axis] = 0.0;
      if (way.norm() > same_way * size)
        return false;
    }
  }
  return true;
}

/// Whether tools move across an axis, or turn about it.
bool are_tools_across(const Scene& scene, int axis) {
  constexpr double same_way = 1e-6;
  const double size = process::body_size(scene.part.mesh);
  for (const contact::Tool& tool : scene.tools) {
    const geometry::Motion& motion = tool.motion;
    if (tool.friction.tensor || (motion.force && std::abs(motion.force->axis[axis]) > same_way) ||
        ((motion.rotation || motion.torque) &&
         std::abs(motion.axis()[axis]) < 1.0 - same_way * same_way))
      return false;
    for (const Look& look : looks_at(scene))
      if (std::abs(motion.translation(look.time)[axis]) > same_way * size)
        return false;
  }
  return true;
}

/// Whether the distances of all tools from two lists of points are the same, on their way.
bool are_gaps_the_same(const Scene& scene,
                       std::span<const Vec3> points,
                       std::span<const Vec3> others) {
  const double reach = 2.0 * process::body_size(scene.part.mesh);
  const std::optional<double> tolerance = shape_tolerance(scene);
  if (!tolerance)
    return false;
  for (const contact::Tool& tool : scene.tools)
    for (const double time : four_times(scene))
      if (!are_same_gaps(gaps_of(tool, time, points, reach), gaps_of(tool, time, others, reach),
                         reach, *tolerance))
        return false;
  return true;
}

// --- Revolution -----------------------------------------------------------------------------

/// An axis of revolution and the sector of the whole that is modelled.
struct Revolution {
  int axis;
  Vec3 centre;                              ///< on the axis
  double from, to;                          ///< angles about it from the first axis across [rad]
  std::vector<std::pair<int, double>> cuts; ///< planes x[first] = second that bound a sector

  [[nodiscard]] double radius(const Vec3& x) const {
    const auto [i, j] = across(axis);
    return std::hypot(x[i] - centre[i], x[j] - centre[j]);
  }
  [[nodiscard]] Vec3 at(double radius_there, double angle, double height) const {
    const auto [i, j] = across(axis);
    Vec3 x = centre;
    x[i] += radius_there * std::cos(angle);
    x[j] += radius_there * std::sin(angle);
    x[axis] = height;
    return x;
  }
};

/// The whole turn about the middle, and the halves and quarters about the middles of sides and the
/// corners of the part's box.
std::vector<Revolution> revolutions_about(const Box& box, int axis) {
  constexpr double pi = std::numbers::pi;
  const auto [i, j] = across(axis);
  const Vec3 middle = 0.5 * (box.low + box.high);
  std::vector<Revolution> all{{axis, middle, 0.0, 2.0 * pi, {}}};
  for (const int cut : {i, j})
    for (const bool low : {true, false}) { // halves
      Vec3 centre = middle;
      centre[cut] = low ? box.low[cut] : box.high[cut];
      const double turned = (cut == i ? -0.5 * pi : 0.0) + (low ? 0.0 : pi);
      all.push_back({axis, centre, turned, turned + pi, {{cut, centre[cut]}}});
    }
  for (int quarter = 0; quarter < 4; ++quarter) {
    Vec3 centre = middle;
    centre[i] = quarter == 0 || quarter == 3 ? box.low[i] : box.high[i];
    centre[j] = quarter == 0 || quarter == 1 ? box.low[j] : box.high[j];
    const double turned = 0.5 * pi * quarter;
    all.push_back({axis, centre, turned, turned + 0.5 * pi, {{i, centre[i]}, {j, centre[j]}}});
  }
  return all;
}

/// Whether a component of a place is that normal to a cut on which it lies.
bool is_normal_to_cut(const Revolution& r, const Vec3& x, int component, double tolerance) {
  return std::any_of(r.cuts.begin(), r.cuts.end(), [&](const auto& cut) {
    return cut.first == component && std::abs(x[cut.first] - cut.second) <= tolerance;
  });
}

/// Whether a face lies on a surface of revolution: its normal has no part around the axis, but for
/// what a flat face has of a round one.
bool is_round(const Revolution& r, const Scene& scene, const mechanics::Face& face) {
  constexpr double widest = 46.0 / 180.0 * std::numbers::pi; // an eighth of a turn: no flat sides
  const auto [i, j] = across(r.axis);
  const std::size_t corners = mechanics::corners_per_face(scene.part.mesh.kind);
  const std::vector<Vec3>& points = scene.part.mesh.points;
  Vec3 centroid = Vec3::Zero(), normal = Vec3::Zero();
  for (std::size_t k = 0; k < corners; ++k) {
    const Vec3 &a = points[idx(face.nodes[k])], &b = points[idx(face.nodes[(k + 1) % corners])];
    centroid += a / static_cast<double>(corners);
    normal += (a - r.centre).cross(b - r.centre);
  }
  normal.normalize();
  Vec3 arm = centroid - r.centre;
  arm[r.axis] = 0.0;
  Vec3 around = Vec3::Zero();
  around[i] = -arm[j];
  around[j] = arm[i];
  double width = 0.0; // in angle, about the centroid
  for (std::size_t k = 0; k < corners; ++k) {
    Vec3 lever = points[idx(face.nodes[k])] - r.centre;
    lever[r.axis] = 0.0;
    width = std::max(width, std::atan2(arm.cross(lever).norm(), arm.dot(lever)));
  }
  const bool is_flat_end = std::abs(normal[r.axis]) > 1.0 - 1e-9;
  return is_flat_end || (2.0 * width <= widest && arm.norm() > 0.0 &&
                         std::abs(normal.dot(around.normalized())) <= 0.5 * width);
}

bool is_solid_of_revolution(const Revolution& r, const Scene& scene) {
  const double tolerance = 1e-6 * box_of(scene.part.mesh.points).size();
  const std::vector<mechanics::Face> faces = mechanics::boundary_faces(scene.part.mesh);
  return std::all_of(faces.begin(), faces.end(), [&](const mechanics::Face& face) {
    const bool is_cut = std::any_of(r.cuts.begin(), r.cuts.end(), [&](const auto& cut) {
      return std::all_of(face.nodes.begin(), face.nodes.end(), [&](Index node) {
        return std::abs(scene.part.mesh.points[idx(node)][cut.first] - cut.second) <= tolerance;
      });
    });
    return is_cut || is_round(r, scene, face);
  });
}

/// Whether supports hold the cuts, whole ends, and nothing else.
bool are_supports_round(const Revolution& r, const Scene& scene) {
  const process::Part& part = scene.part;
  const Box box = box_of(part.mesh.points);
  const double tolerance = 1e-6 * box.size();
  for (const auto& [axis, level] : r.cuts) {
    const End end = std::abs(level - box.low[axis]) <= tolerance ? End::low : End::high;
    const TimeFunction* const hold = hold_of(part, axis, end, axis);
    if (hold == nullptr || !rests(*hold))
      return false;
  }
  const auto is_whole_end = [&](int component) {
    for (const End end : {End::low, End::high})
      if (hold_of(part, r.axis, end, component) != nullptr)
        return true;
    return false;
  };
  for (const process::Support& support : part.supports)
    for (const Index node : support.nodes) {
      const Vec3& x = part.mesh.points[idx(node)];
      const bool is_end = std::abs(x[r.axis] - box.low[r.axis]) <= tolerance ||
                          std::abs(x[r.axis] - box.high[r.axis]) <= tolerance;
      const bool is_of_end = is_end && is_whole_end(support.component) &&
                             (support.component == r.axis || rests(support.displacement));
      const bool is_of_cut = is_normal_to_cut(r, x, support.component, tolerance);
      const bool is_of_axis = support.component != r.axis && r.radius(x) <= tolerance;
      if (!is_of_end && !is_of_cut && !is_of_axis)
        return false;
    }
  return true;
}

bool are_tools_round(const Revolution& r, const Scene& scene) {
  constexpr int angles = 9, radii = 7, heights = 8;
  constexpr double margin = 0.1;
  if (!are_tools_along(scene, r.axis))
    return false;
  const Box box = box_of(scene.part.mesh.points);
  double outer = 0.0;
  for (const Vec3& x : scene.part.mesh.points)
    outer = std::max(outer, r.radius(x));
  const double height = box.high[r.axis] - box.low[r.axis];
  std::vector<Vec3> first, turned;
  for (int n = 0; n < radii; ++n)
    for (int k = 0; k < heights; ++k)
      for (int a = 0; a < angles; ++a) {
        const double rho = outer * (1.0 + margin) * n / (radii - 1);
        const double z =
            box.low[r.axis] + height * (-margin + (1.0 + 2.0 * margin) * k / (heights - 1));
        const double share = (a + 0.3 * std::sin(5.0 * a)) / angles;
        first.push_back(r.at(rho, r.from + 0.5 * (r.to - r.from) / angles, z));
        turned.push_back(r.at(rho, r.from + (r.to - r.from) * std::abs(share), z));
      }
  return are_gaps_the_same(scene, first, turned);
}

/// Nodes on the half plane from the axis where the sector begins: those of a meridian.
std::size_t nodes_of_meridian(const Revolution& r, const Scene& scene) {
  const double tolerance = 1e-6 * box_of(scene.part.mesh.points).size();
  std::size_t count = 0;
  for (const Vec3& x : scene.part.mesh.points)
    if ((x - r.at(r.radius(x), r.from, x[r.axis])).norm() <= tolerance)
      ++count;
  return count;
}

// --- Equal sections -------------------------------------------------------------------------

/// Whether all nodes stand over nodes of one end, supports hold whole rows along the axis, and both
/// ends rest.
bool is_prism(const Scene& scene, int axis) {
  const process::Part& part = scene.part;
  for (const End end : {End::low, End::high}) {
    const TimeFunction* const hold = hold_of(part, axis, end, axis);
    if (hold == nullptr || !rests(*hold))
      return false;
  }
  const Box box = box_of(part.mesh.points);
  std::vector<Vec3> section;
  for (const Index node : nodes_at(part, axis, End::low))
    section.push_back(part.mesh.points[idx(node)]);
  const NodeFinder finder(section, 1e-6 * box.size());
  std::vector<std::size_t> row(part.mesh.points.size());
  for (std::size_t n = 0; n < row.size(); ++n) {
    Vec3 foot = part.mesh.points[n];
    foot[axis] = box.low[axis];
    const std::optional<std::size_t> found = finder.at(foot);
    if (!found)
      return false;
    row[n] = *found;
  }
  if (nodes_at(part, axis, End::high).size() != section.size())
    return false;
  std::vector<std::size_t> in_row(section.size(), 0);
  for (const std::size_t at : row)
    ++in_row[at];
  for (const process::Support& support : part.supports) {
    std::map<std::size_t, std::size_t> held;
    for (const Index node : support.nodes)
      ++held[row[idx(node)]];
    if (support.component != axis && std::any_of(held.begin(), held.end(), [&](const auto& rows) {
          return rows.second != in_row[rows.first];
        }))
      return false;
  }
  return true;
}

bool are_tools_prismatic(const Scene& scene, int axis) {
  constexpr int sections = 4;
  if (!are_tools_across(scene, axis))
    return false;
  const Box box = box_of(scene.part.mesh.points);
  std::vector<Vec3> first, shifted;
  for (const Vec3& x : grid_about(scene, 7))
    for (int k = 0; k < sections; ++k) {
      Vec3 place = x;
      place[axis] = box.low[axis];
      first.push_back(place);
      place[axis] += (box.high[axis] - box.low[axis]) * (k + 0.9) / sections;
      shifted.push_back(place);
    }
  return are_gaps_the_same(scene, first, shifted);
}

} // namespace

std::optional<PlaneScene> plane_scene(const Case& content, const Scene& scene) {
  if (scene.part.analysis != mechanics::Analysis::solid || !scene.part.loads.empty() ||
      scene.tools.empty() || content.contact.surface) // a part of the surface: whose sections?
    return std::nullopt;
  const std::size_t unknowns = 3 * scene.part.mesh.points.size();
  for (int axis = 0; axis < 3; ++axis) {
    for (const Revolution& r : revolutions_about(box_of(scene.part.mesh.points), axis))
      if (is_solid_of_revolution(r, scene) && are_supports_round(r, scene) &&
          are_tools_round(r, scene))
        return PlaneScene{
            {Advice::Kind::axisymmetric,
             fmt::format("part, tools and supports are bodies of revolution about an axis along "
                         "{}: analysis = \"axisymmetric\" with the same elements has about {} "
                         "unknowns in place of {}",
                         "xyz"[axis], 2 * nodes_of_meridian(r, scene), unknowns)},
            axis};
    if (is_prism(scene, axis) && are_tools_prismatic(scene, axis))
      return PlaneScene{
          {Advice::Kind::plane_strain,
           fmt::format(
               "part and tools have the same section all along {0}, and both ends are held "
               "in {0}: analysis = \"plane-strain\" with the same elements has {1} unknowns "
               "in place of {2}; its forces are per {3} of thickness",
               "xyz"[axis], 2 * nodes_at(scene.part, axis, End::low).size(), unknowns,
               content.units.length)},
          axis};
  }
  return std::nullopt;
}

} // namespace billet::io
