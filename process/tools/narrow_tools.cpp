#include "process/tools/narrow_tools.h"

#include "geometry/base/limits.h"
#include "geometry/triangles/box_tree.h"
#include "process/scene/scene.h"
#include "process/tools/part_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// What is less deep in the part, in depths of the parent element, is no more than what chords of
/// faces and softness of contact make.
constexpr double noticed = 0.02;

/// Of the longest face: a tool that at this depth has no room for a ball of a third of it, or is a
/// rod of a radius below half of it, may lie in the part without meeting contact points, which are
/// 0.58 of a face apart, and without a face in it. (The edge of a block has room for 0.35.)
constexpr double slender_depth = 0.5, slender_room = 0.325, slender_radius = 0.5;

/// Steps of the way of a tool, in depths of the thinnest parent element of a face.
constexpr double step_of_way = 0.25;

/// Longest faces: a larger tool is looked at near the part only, like one without an end.
constexpr double largest_looked_at = 1000.0;

/// Adds the part's box as it is seen from a tool.
void add_seen(const Box& box, const geometry::Pose& pose, Box& seen) {
  for (int corner = 0; corner < 8; ++corner)
    seen.add(pose.to_tool(Vec3((corner & 1) != 0 ? box.high.x() : box.low.x(),
                               (corner & 2) != 0 ? box.high.y() : box.low.y(),
                               (corner & 4) != 0 ? box.high.z() : box.low.z())));
}

/// Longest chord of a face.
double
longest_chord(const contact::ContactSurface& surface, std::span<const double> x, Index face) {
  const std::vector<Vec3> corners = surface.samples(x, face, 1);
  double longest = 0.0;
  for (const Vec3& a : corners)
    for (const Vec3& b : corners)
      longest = std::max(longest, (b - a).norm());
  return longest;
}

/// Whether a tool as a whole has no room for a ball, in two directions at least: behind an open
/// surface there is nothing to tell it by.
bool is_slender(const Box& tool, double width) {
  Vec3 sides = tool.high - tool.low;
  std::sort(sides.begin(), sides.end());
  return sides[1] < 2.0 * slender_room * width;
}

/// Whether a tool is slender behind places of its surface: there is no room for a ball.
std::vector<char>
slender_behind(const geometry::RigidSurface& tool, const std::vector<Vec3>& places, double width) {
  std::vector<geometry::Projection> feet(places.size());
  tool.project(places, width, feet);
  std::vector<Vec3> behind(places);
  for (std::size_t i = 0; i < places.size(); ++i)
    behind[i] -= slender_depth * width * feet[i].normal;
  std::vector<geometry::Projection> there(places.size());
  tool.project(behind, width, there);
  std::vector<char> slender(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) // an open surface may have nothing behind it
    slender[i] = feet[i].found() && there[i].found() && -there[i].gap < slender_room * width;
  return slender;
}

} // namespace

NarrowTools::NarrowTools(const mechanics::Mesh& mesh,
                         std::span<const contact::Tool> tools,
                         const contact::ContactSurface& surface,
                         std::span<const double> x)
    : mesh_(&mesh), tools_(tools), surface_(&surface), thinnest_(infinity), endless_(tools.size()),
      parts_(tools.size()) {
  for (Index f = 0; f < surface.n_faces(); ++f) {
    lengths_.push_back(longest_chord(surface, x, f));
    width_ = std::max(width_, lengths_.back());
    thinnest_ = std::min(thinnest_, surface.depth(f));
  }
  if (surface.n_faces() == 0)
    return;
  for (std::size_t t = 0; t < parts_.size(); ++t) {
    const Box bounds = tools[t].surface->bounds();
    // Not finite, or too many balls.
    endless_[t] = bounds.size() <= largest_looked_at * width_ ? 0 : 1;
    if (endless_[t] == 0)
      parts_[t] = parts_of(*tools[t].surface, bounds);
  }
}

std::vector<NarrowTools::Part> NarrowTools::parts_of(const geometry::RigidSurface& tool,
                                                     const Box& window) const {
  std::vector<Part> parts;
  std::vector<Vec3> sharp;
  for (const geometry::InnerBall& ball : tool.narrow_parts({window, width_})) {
    parts.push_back({ball, ball.radius < slender_radius * width_});
    if (ball.radius == 0.0)
      sharp.push_back(ball.centre);
  }
  const std::vector<char> slender = slender_behind(tool, sharp, width_);
  const bool as_a_whole = is_slender(tool.bounds(), width_);
  std::size_t next = 0;
  for (Part& part : parts)
    if (part.ball.radius == 0.0)
      part.slender = slender[next++] != 0 || as_a_whole;
  return parts;
}

std::span<const NarrowTools::Part>
NarrowTools::parts(std::size_t tool, const Box& window, std::vector<Part>& endless) const {
  if (endless_[tool] == 0)
    return parts_[tool];
  endless = parts_of(*tools_[tool].surface, window);
  return endless;
}

bool NarrowTools::none() const {
  for (std::size_t t = 0; t < parts_.size(); ++t)
    if (endless_[t] != 0 || !parts_[t].empty())
      return false;
  return true;
}

DeepTool
NarrowTools::in_part(PartDepth& part, const Part& narrow, const geometry::Pose& pose) const {
  const Vec3 centre = pose.to_space(narrow.ball.centre);
  const double radius = narrow.ball.radius;
  Box here;
  here.add(centre);
  if (!part.bounds().overlaps(here, radius))
    return {};
  const PlaceInPart at = part.at(centre, radius);
  const double depth = at.depth + radius;
  if (at.face < 0 || !(depth > noticed * surface_->depth(at.face)))
    return {};
  return {depth, depth / surface_->depth(at.face), 0, centre, at.face, radius};
}

DeepTool NarrowTools::deepest(const contact::ContactTerm& contact,
                              const mechanics::Trial& trial,
                              double faces) const {
  DeepTool worst;
  if (none())
    return worst;
  std::optional<PartDepth> part;
  std::vector<Part> endless;
  const Box box = box_of_nodes(*mesh_, trial.x);
  for (std::size_t t = 0; t < parts_.size(); ++t) {
    if (!contact.acts(t, trial.time) || contact::draws_back(contact, t))
      continue;
    const geometry::Pose pose = contact.pose(t, trial.time, trial.x);
    Box window;
    add_seen(box, pose, window);
    for (const Part& narrow : parts(t, window, endless)) {
      if (!narrow.slender && faces < noticed)
        continue;
      Box here;
      here.add(pose.to_space(narrow.ball.centre));
      if (!box.overlaps(here, narrow.ball.radius))
        continue;
      if (!part)
        part.emplace(*mesh_, *surface_, trial.x);
      DeepTool found = in_part(*part, narrow, pose);
      found.tool = t;
      if (found.share > worst.share)
        worst = found;
    }
  }
  return worst;
}

/// A tool's way in an increment, and the part's, both at constant speed.
class NarrowTools::Way {
public:
  Way(const NarrowTools& narrow, const contact::ContactTerm& contact, const mechanics::Trial& trial)
      : narrow_(narrow), contact_(contact), trial_(trial) {
    const auto dim = static_cast<std::size_t>(narrow.mesh_->dimension());
    const std::size_t n_dofs = dim * narrow.mesh_->points.size();
    for (std::size_t i = 0; i < n_dofs; i += dim) {
      double square = 0.0;
      for (std::size_t d = i; d < i + dim; ++d)
        square += (trial.x[d] - trial.x_old[d]) * (trial.x[d] - trial.x_old[d]);
      of_part_ = std::max(of_part_, std::sqrt(square));
    }
    for (const std::span<const double> x : {trial.x_old, trial.x}) {
      const Box box = box_of_nodes(*narrow.mesh_, x);
      swept_.add(box.low);
      swept_.add(box.high);
    }
  }

  std::optional<DeepTool> meets(std::size_t tool) {
    const geometry::Motion& motion = narrow_.tools_[tool].motion;
    const geometry::Driven from = contact_.driven(tool, trial_.x_old);
    const geometry::Driven to = contact_.driven(tool, trial_.x);
    shift_ = {motion.translation(trial_.time_old, from), motion.translation(trial_.time, to)};
    angle_ = {motion.angle(trial_.time_old, from), motion.angle(trial_.time, to)};
    start_ = pose(motion, 0.0);
    Box window;
    for (const double share : {0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0})
      add_seen(swept_, pose(motion, share), window);
    std::vector<Part> endless;
    for (const Part& part : narrow_.parts(tool, window, endless))
      if (part.slender)
        if (std::optional<DeepTool> found = follow(motion, part)) {
          found->tool = tool;
          return found;
        }
    return std::nullopt;
  }

private:
  [[nodiscard]] geometry::Pose pose(const geometry::Motion& motion, double share) const {
    return motion.pose_at(shift_[0] + share * (shift_[1] - shift_[0]),
                          angle_[0] + share * (angle_[1] - angle_[0]));
  }

  /// The way of a ball relative to the part, at most [mm].
  [[nodiscard]] double length(const geometry::Motion& motion, const Vec3& start) const {
    const Vec3 from_axis = start - motion.axis_point() - motion.offset - shift_[0];
    return (shift_[1] - shift_[0]).norm() +
           std::abs(angle_[1] - angle_[0]) * motion.axis().cross(from_axis).norm() + of_part_;
  }

  [[nodiscard]] std::optional<DeepTool> follow(const geometry::Motion& motion, const Part& part) {
    const Vec3 start = start_.to_space(part.ball.centre);
    const double way = length(motion, start);
    const double step = step_of_way * narrow_.thinnest_;
    Box path;
    path.add(start);
    if (!(way > step) || !swept_.overlaps(path, way + part.ball.radius))
      return std::nullopt;
    const auto steps = static_cast<std::int64_t>(std::ceil(way / step));
    for (std::int64_t i = 0; i < steps;) {
      const double share = static_cast<double>(i) / static_cast<double>(steps);
      const geometry::Pose now = pose(motion, share);
      PartDepth& there = part_at(share);
      const Vec3 centre = now.to_space(part.ball.centre);
      const DeepTool found = narrow_.in_part(there, part, now);
      if (found.share > deepest_unfelt) {
        if (i == 0) // from the start
          return std::nullopt;
        return found;
      }
      // No step can meet the part before the way to it is gone.
      const double clear =
          std::sqrt(geometry::distance2(there.bounds(), centre)) - part.ball.radius;
      i += std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(clear / step)));
    }
    return std::nullopt;
  }

  [[nodiscard]] PartDepth& part_at(double share) {
    const auto known = parts_.find(share);
    if (known != parts_.end())
      return known->second.depth;
    std::vector<double> x(trial_.x_old.begin(), trial_.x_old.end());
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += share * (trial_.x[i] - x[i]);
    return parts_.try_emplace(share, narrow_, std::move(x)).first->second.depth;
  }

  /// The part at a share of the way.
  struct PartThen {
    PartThen(const NarrowTools& narrow, std::vector<double> at)
        : x(std::move(at)), depth(*narrow.mesh_, *narrow.surface_, x) {}
    std::vector<double> x;
    PartDepth depth;
  };

  const NarrowTools& narrow_;
  const contact::ContactTerm& contact_;
  const mechanics::Trial& trial_;
  double of_part_ = 0.0; ///< longest way of a node [mm]
  Box swept_;            ///< of the part on its way [mm]
  std::array<Vec3, 2> shift_;
  std::array<double, 2> angle_{};
  geometry::Pose start_;
  std::map<double, PartThen> parts_; ///< by the share of the way
};

std::optional<DeepTool> NarrowTools::met_on_the_way(const contact::ContactTerm& contact,
                                                    const mechanics::Trial& trial) const {
  if (none())
    return std::nullopt;
  Way way(*this, contact, trial);
  for (std::size_t t = 0; t < parts_.size(); ++t)
    if (contact.acts(t, trial.time) && !contact::draws_back(contact, t))
      if (std::optional<DeepTool> found = way.meets(t))
        return found;
  return std::nullopt;
}

} // namespace billet::process
