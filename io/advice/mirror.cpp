// A plane of symmetry of the whole scene: part, supports, loads, tools and their motions.

#include "geometry/base/box.h"
#include "io/advice/advice_parts.h"
#include "io/advice/node_finder.h"
#include "io/advice/part_ends.h"
#include "io/advice/tool_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <variant>

namespace billet::io {

namespace {

using process::Scene;

/// Reflection in the plane x[axis] = level.
struct Mirror {
  int axis;
  double level; ///< [mm]

  [[nodiscard]] Vec3 of_vector(Vec3 v) const {
    v[axis] = -v[axis];
    return v;
  }
  [[nodiscard]] Vec3 of_point(Vec3 x) const {
    x[axis] = 2.0 * level - x[axis];
    return x;
  }
  /// What turns one way turns the other way in a mirror.
  [[nodiscard]] Vec3 of_turn(const Vec3& w) const { return -of_vector(w); }
};

using Images = std::vector<std::size_t>; ///< shape (n_points): the node in the mirror

std::optional<Images> images_of(const Scene& scene, const Mirror& mirror) {
  constexpr double same_place = 1e-6; // of the part's size
  const std::vector<Vec3>& points = scene.part.mesh.points;
  const NodeFinder finder(points, same_place * box_of(points).size());
  Images images;
  for (const Vec3& x : points) {
    const std::optional<std::size_t> image = finder.at(mirror.of_point(x));
    if (!image)
      return std::nullopt;
    images.push_back(*image);
  }
  return images;
}

std::set<std::size_t> image_of_face(std::span<const mechanics::Index> nodes, const Images* images) {
  std::set<std::size_t> image;
  for (const mechanics::Index node : nodes)
    image.insert(images != nullptr ? (*images)[idx(node)] : idx(node));
  return image;
}

/// Whether faces are their own image.
bool are_mirrored(const std::vector<mechanics::Face>& faces, const Images& images) {
  std::set<std::set<std::size_t>> all;
  for (const mechanics::Face& face : faces)
    all.insert(image_of_face(face.nodes, nullptr));
  return std::all_of(faces.begin(), faces.end(), [&](const mechanics::Face& face) {
    return all.contains(image_of_face(face.nodes, &images));
  });
}

bool are_supports_mirrored(const Scene& scene, const Mirror& mirror, const Images& images) {
  std::map<std::pair<std::size_t, int>, const TimeFunction*> holds;
  for (const process::Support& support : scene.part.supports)
    for (const mechanics::Index node : support.nodes)
      holds.emplace(std::pair(idx(node), support.component), &support.displacement);
  return std::all_of(holds.begin(), holds.end(), [&](const auto& hold) {
    const auto& [node, component] = hold.first;
    const auto image = holds.find(std::pair(images[node], component));
    return image != holds.end() &&
           is_multiple(*image->second, *hold.second, component == mirror.axis ? -1.0 : 1.0);
  });
}

bool are_forces_mirrored(const process::DeadForces& load,
                         const Scene& scene,
                         const Mirror& mirror,
                         const Images& images) {
  constexpr double rounding = 1e-6;
  const auto dim = static_cast<std::size_t>(scene.part.mesh.dimension());
  double largest = 0.0;
  for (const double force : load.forces)
    largest = std::max(largest, std::abs(force));
  for (std::size_t node = 0; node < images.size(); ++node)
    for (std::size_t i = 0; i < dim; ++i) {
      const double sign = i == idx(mirror.axis) ? -1.0 : 1.0;
      if (std::abs(load.forces[dim * images[node] + i] - sign * load.forces[dim * node + i]) >
          rounding * largest)
        return false;
    }
  return true;
}

/// Whether each load is its own image.
bool are_loads_mirrored(const Scene& scene, const Mirror& mirror, const Images& images) {
  return std::all_of(
      scene.part.loads.begin(), scene.part.loads.end(), [&](const process::LoadSpec& load) {
        if (const auto* const pressure = std::get_if<process::PressureOn>(&load))
          return are_mirrored(pressure->faces, images);
        return are_forces_mirrored(std::get<process::DeadForces>(load), scene, mirror, images);
      });
}

bool is_same_drive(const std::optional<geometry::Drive>& a,
                   const std::optional<geometry::Drive>& b,
                   const Vec3& image_of_axis) {
  constexpr double rounding = 1e-9;
  if (!a || !b)
    return a.has_value() == b.has_value();
  const bool is_same_blow =
      a->blow.has_value() == b->blow.has_value() &&
      (!a->blow || (a->blow->mass == b->blow->mass && a->blow->speed == b->blow->speed));
  return is_same_blow && is_multiple(a->load, b->load, 1.0) &&
         (image_of_axis - b->axis).norm() < rounding;
}

/// Tools that are each other's images, or their own. The plane may travel with the part: between a
/// punch that moves and a die that rests, halfway.
class TwinTools {
public:
  TwinTools(const Case& content, const Scene& scene, const Mirror& mirror)
      : content_(content), scene_(scene), mirror_(mirror), times_(four_times(scene)),
        size_(process::body_size(scene.part.mesh)), tolerance_(shape_tolerance(scene)),
        points_(grid_about(scene, 7)) {
    for (const Vec3& x : contact_nodes(scene, 200))
      points_.push_back(x);
  }

  /// How the plane travels, shape (times) [mm].
  using Travel = std::vector<double>;

  /// A travel with which every tool has its image among all; none: there is none.
  ///
  /// @param may_travel  nothing but tools holds the part along the normal
  [[nodiscard]] std::optional<Travel> travel(bool may_travel) const {
    const Travel rest(times_.size(), 0.0);
    if (!tolerance_)
      return std::nullopt;
    if (are_all_paired(rest))
      return rest;
    for (std::size_t b = 0; may_travel && b < scene_.tools.size(); ++b)
      if (const Travel halfway = between(0, b); are_all_paired(halfway))
        return halfway;
    return std::nullopt;
  }

private:
  static constexpr double same_way = 1e-6; // of the part's size

  [[nodiscard]] bool are_all_paired(const Travel& travel) const {
    for (std::size_t a = 0; a < scene_.tools.size(); ++a) {
      bool is_paired = false;
      for (std::size_t b = 0; b < scene_.tools.size() && !is_paired; ++b)
        is_paired =
            is_same_deal(a, b) && is_same_motion(a, b, travel) && is_same_shape(a, b, travel);
      if (!is_paired)
        return false;
    }
    return true;
  }
  /// The way of the plane half-way between two tools, from where it is at the start.
  [[nodiscard]] Travel between(std::size_t a, std::size_t b) const {
    Travel halfway;
    for (const double t : times_)
      halfway.push_back(0.5 * (scene_.tools[a].motion.translation(t) +
                               scene_.tools[b].motion.translation(t))[mirror_.axis]);
    return halfway;
  }
  [[nodiscard]] bool is_same_deal(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool is_same_motion(std::size_t a, std::size_t b, const Travel& travel) const;
  [[nodiscard]] bool is_same_shape(std::size_t a, std::size_t b, const Travel& travel) const;

  const Case& content_;
  const Scene& scene_;
  Mirror mirror_;
  std::vector<double> times_;
  double size_;
  std::optional<double> tolerance_;
  std::vector<Vec3> points_;
};

/// Friction, wear, and when they act.
bool TwinTools::is_same_deal(std::size_t a, std::size_t b) const {
  const Tool &one = content_.tools[a], &other = content_.tools[b];
  return !one.friction.tensor && one.friction == other.friction && one.wear == other.wear &&
         one.active == other.active &&
         std::all_of(scene_.stages.begin(), scene_.stages.end(),
                     [&](const process::Stage& stage) { return stage.tools[a] == stage.tools[b]; });
}

bool TwinTools::is_same_motion(std::size_t a, std::size_t b, const Travel& travel) const {
  constexpr double same_angle = 1e-6; // [rad]
  const geometry::Motion &one = scene_.tools[a].motion, &other = scene_.tools[b].motion;
  if (!is_same_drive(one.force, other.force,
                     one.force ? mirror_.of_vector(one.force->axis) : Vec3::Zero()) ||
      !is_same_drive(one.torque, other.torque,
                     one.torque ? mirror_.of_turn(one.torque->axis) : Vec3::Zero()))
    return false;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const double t = times_[k];
    const Vec3 turned = mirror_.of_turn(one.angle(t) * one.axis());
    if ((turned - other.angle(t) * other.axis()).norm() > same_angle)
      return false;
    Vec3 way = other.translation(t) - mirror_.of_vector(one.translation(t));
    way[mirror_.axis] -= 2.0 * travel[k];
    if (way.norm() > same_way * size_)
      return false;
  }
  return true;
}

bool TwinTools::is_same_shape(std::size_t a, std::size_t b, const Travel& travel) const {
  const double reach = 2.0 * size_;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    std::vector<Vec3> places, images;
    for (const Vec3& x : points_) {
      Vec3 place = x;
      place[mirror_.axis] += travel[k]; // with the part
      places.push_back(place);
      images.push_back(Mirror{mirror_.axis, mirror_.level + travel[k]}.of_point(place));
    }
    if (!are_same_gaps(gaps_of(scene_.tools[a], times_[k], places, reach),
                       gaps_of(scene_.tools[b], times_[k], images, reach), reach, *tolerance_))
      return false;
  }
  return true;
}

bool is_held_along(const process::Part& part, int axis) {
  return !part.loads.empty() ||
         std::any_of(part.supports.begin(), part.supports.end(),
                     [&](const process::Support& support) { return support.component == axis; });
}

/// Unknowns of the half above the plane, with the nodes on it.
std::size_t unknowns_of_half(const Scene& scene, const Mirror& mirror) {
  const double size = process::body_size(scene.part.mesh);
  const auto nodes =
      std::count_if(scene.part.mesh.points.begin(), scene.part.mesh.points.end(),
                    [&](const Vec3& x) { return x[mirror.axis] >= mirror.level - 1e-6 * size; });
  return static_cast<std::size_t>(nodes) * static_cast<std::size_t>(scene.part.mesh.dimension());
}

} // namespace

std::optional<Advice> mirror_advice(const Case& content, const Scene& scene, int axis) {
  const Box box = box_of(scene.part.mesh.points);
  const Mirror mirror{axis, 0.5 * (box.low[axis] + box.high[axis])};
  const std::optional<Images> images = images_of(scene, mirror);
  if (!images || !are_mirrored(scene.part.contact_faces, *images) ||
      !are_supports_mirrored(scene, mirror, *images) || !are_loads_mirrored(scene, mirror, *images))
    return std::nullopt;
  const TwinTools twins(content, scene, mirror);
  const std::optional<TwinTools::Travel> travel = twins.travel(!is_held_along(scene.part, axis));
  if (!travel)
    return std::nullopt;
  const bool travels = std::any_of(travel->begin(), travel->end(),
                                   [&](double way) { return std::abs(way) > 1e-6 * box.size(); });
  const double level = std::abs(mirror.level) < 1e-9 * box.size() ? 0.0 : mirror.level;
  const std::size_t whole =
      scene.part.mesh.points.size() * static_cast<std::size_t>(scene.part.mesh.dimension());
  const std::string travelling =
      travels ? fmt::format(" if that plane goes along with the part (by {:.4g} {} until the end)",
                            travel->back(), content.units.length)
              : "";
  return Advice{
      Advice::Kind::symmetry,
      fmt::format("the scene is symmetric about {0} = {1:.6g} {2}{3}: half of it, with a "
                  "[[support]] there (where = \"{0} = {1:.6g}\", fix = [\"{0}\"]){4}, has {5} "
                  "unknowns in place of {6}",
                  "xyz"[axis], level, content.units.length, travelling,
                  travels ? " and motions as seen from it" : "", unknowns_of_half(scene, mirror),
                  whole)};
}

} // namespace billet::io
