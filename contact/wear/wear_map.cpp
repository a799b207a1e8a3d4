#include "contact/wear/wear_map.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace billet::contact {

namespace {

/// Where a shape without end is cut off, in sizes of the workpiece: farther than any slides, and
/// rounding there is still negligible compared with a cell.
constexpr double farthest = 1e6;

/// Edges of cells beneath a footprint, in its sizes.
constexpr double fineness = 0.5;

/// Cells are not cut beyond this number of them.
constexpr std::size_t max_nodes = 4'000'000;

/// Length in the plane, square root of the area in space [mm].
double size(const Footprint& footprint) {
  const auto& c = footprint.corners;
  if (footprint.n_corners == 2)
    return (c[1] - c[0]).norm();
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < footprint.n_corners; ++i)
    twice += (c[i] - c[0]).cross(c[i + 1] - c[0]);
  return std::sqrt(0.5 * twice.norm());
}

/// A cut may add a corner, and so may each side of a footprint.
bool can_be_cut(const geometry::ConvexPolygon& shape, std::size_t n_nodes) {
  return n_nodes < max_nodes && shape.corners().size() + 6 < geometry::ConvexPolygon::most_corners;
}

/// Out of the tool, of any length: of a line its right, as in a profile.
Vec3 normal(const geometry::ConvexPolygon& shape) {
  const auto corners = shape.corners();
  if (corners.size() > 2)
    return shape.area_vector();
  const Vec3 along = corners[1] - corners[0];
  return {along[1], -along[0], 0.0};
}

} // namespace

WearMap::WearMap(const geometry::RigidSurface& surface,
                 mechanics::Analysis analysis,
                 const Box& body)
    : analysis_(analysis) {
  Box window = body;
  window.low.array() -= farthest * body.size();
  window.high.array() += farthest * body.size();
  set_roots(surface, window);
  std::vector<Box> boxes;
  for (const Node& node : nodes_)
    boxes.push_back(box_of(corners(node)));
  roots_ = geometry::BoxTree(boxes);
}

void WearMap::set_roots(const geometry::RigidSurface& surface, const Box& window) {
  const bool planar = analysis_ != mechanics::Analysis::solid;
  const geometry::DisplayMesh drawn = surface.display(window, planar);
  const auto add = [&](const geometry::ConvexPolygon& shape) {
    if (!shape.empty() && area(shape) > 0.0)
      add_node(shape, 0.0);
  };
  for (const auto& t : drawn.triangles)
    add(geometry::ConvexPolygon(
        std::array{drawn.points[idx(t[0])], drawn.points[idx(t[1])], drawn.points[idx(t[2])]}));
  for (const auto& l : drawn.lines)
    add(line(surface, drawn.points[idx(l[0])], drawn.points[idx(l[1])], window.size()));
}

geometry::ConvexPolygon
WearMap::line(const geometry::RigidSurface& surface, Vec3 a, Vec3 b, double reach) const {
  a[2] = b[2] = 0.0;
  std::array<geometry::Projection, 1> middle;
  surface.project(std::array{Vec3(0.5 * (a + b))}, reach, middle);
  geometry::ConvexPolygon line(std::array{a, b});
  if (middle[0].normal.dot(normal(line)) < 0.0) // drawn the other way round
    line = geometry::ConvexPolygon(std::array{b, a});
  if (analysis_ == mechanics::Analysis::axisymmetric)
    line.cut(Vec3::Zero(), Vec3::UnitX()); // beyond the axis lies the mirror image
  return line;
}

void WearMap::add_node(const geometry::ConvexPolygon& shape, double volume) {
  nodes_.push_back({corners_.size(), shape.corners().size(), volume});
  corners_.insert(corners_.end(), shape.corners().begin(), shape.corners().end());
}

double WearMap::area(const geometry::ConvexPolygon& shape) const {
  const auto c = shape.corners();
  if (c.size() > 2)
    return shape.area_vector().norm();
  const double length = (c[1] - c[0]).norm();
  return analysis_ == mechanics::Analysis::axisymmetric
             ? std::numbers::pi * (c[0][0] + c[1][0]) * length
             : length;
}

WearMap::Imprint WearMap::imprint(const WornPatch& patch, double size) {
  // Cells are met in the foot's neighbourhood; on a curved tool its way is a chord.
  constexpr double reserve = 1.5;
  const auto& corners = patch.footprint.corners;
  const std::size_t n = patch.footprint.n_corners;
  Imprint imprint{{}, n, patch.foot, patch.normal, 0.0, fineness * size};
  Vec3 turn = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    imprint.radius2 =
        std::max(imprint.radius2, reserve * reserve * (corners[i] - patch.foot).squaredNorm());
    turn += (corners[i] - patch.foot).cross(corners[(i + 1) % n] - patch.foot);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 side = corners[(i + 1) % n] - corners[i];
    imprint.sides[i] = {corners[i], n == 2 ? Vec3(side - side.dot(patch.normal) * patch.normal)
                                           : Vec3((turn.dot(patch.normal) > 0.0 ? 1.0 : -1.0) *
                                                  patch.normal.cross(side))};
  }
  return imprint;
}

double WearMap::covered(geometry::ConvexPolygon shape, const Imprint& imprint) const {
  if (!(normal(shape).dot(imprint.normal) > 0.0))
    return 0.0; // the other side of a thin tool
  for (std::size_t i = 0; i < imprint.n_sides && !shape.empty(); ++i)
    shape.cut(imprint.sides[i].point, imprint.sides[i].inward);
  if (shape.empty() || (imprint.n_sides > 2 && shape.corners().size() < 3))
    return 0.0;
  return area(shape);
}

namespace {

/// The piece where it was a share of the increment before its end: a roll carries its surface round
/// beneath it.
WornPatch earlier(WornPatch patch, double share) {
  const double angle = patch.turn.norm();
  const std::span<Vec3> corners(patch.footprint.corners.data(), patch.footprint.n_corners);
  if (angle == 0.0) {
    for (Vec3& corner : corners)
      corner -= share * patch.way;
    patch.foot -= share * patch.way;
    return patch;
  }
  const auto turn = [&](double by) {
    return Eigen::AngleAxisd(-by * angle, patch.turn / angle).toRotationMatrix();
  };
  const auto back = [&](const Vec3& x, const Mat3& turned) -> Vec3 {
    return patch.centre + turned * (x - patch.centre);
  };
  // Its way in addition to the turn.
  const Vec3 rest = share * (patch.foot - patch.way - back(patch.foot, turn(1.0)));
  const Mat3 turned = turn(share);
  for (Vec3& corner : corners)
    corner = back(corner, turned) + rest;
  patch.foot = back(patch.foot, turned) + rest;
  patch.normal = turned * patch.normal;
  return patch;
}

} // namespace

// (W.6)
void WearMap::add(const WornPatch& patch) {
  const double size = contact::size(patch.footprint);
  const double places = size > 0.0 ? std::ceil(patch.way.norm() / (fineness * size)) : 1.0;
  const int n = std::max(1, static_cast<int>(places));
  for (int i = 0; i < n; ++i) {
    const double left = 1.0 - (i + 0.5) / n;
    press(imprint(earlier(patch, left), size), patch.volume / n);
  }
}

// (W.5)
void WearMap::press(const Imprint& imprint, double volume) {
  std::vector<Share> shares;
  roots_.walk(imprint.centre, imprint.radius2, [&](std::int32_t root) {
    gather(root, imprint, shares);
    return imprint.radius2;
  });
  double sum = 0.0;
  for (const Share& share : shares)
    sum += share.area;
  if (!(sum > 0.0)) // a footprint beyond a rim
    shares = {{nearest(imprint.centre), sum = 1.0}};
  for (const Share& share : shares)
    nodes_[idx(share.node)].volume += share.area / sum * volume;
}

void WearMap::gather(std::int32_t node, const Imprint& imprint, std::vector<Share>& shares) {
  if (geometry::distance2(box_of(corners(nodes_[idx(node)])), imprint.centre) > imprint.radius2)
    return;
  if (nodes_[idx(node)].children < 0) {
    const geometry::ConvexPolygon shape = this->shape(nodes_[idx(node)]);
    const double area = covered(shape, imprint);
    if (!(area > 0.0))
      return;
    const auto [a, b] = shape.farthest_corners();
    if ((b - a).norm() <= imprint.longest || !can_be_cut(shape, nodes_.size())) {
      shares.push_back({node, area});
      return;
    }
    cut_in_two(node);
  }
  const std::int32_t children = nodes_[idx(node)].children;
  gather(children, imprint, shares);
  gather(children + 1, imprint, shares);
}

void WearMap::cut_in_two(std::int32_t node) {
  geometry::ConvexPolygon first = shape(nodes_[idx(node)]);
  geometry::ConvexPolygon second = first;
  const auto [a, b] = first.farthest_corners();
  first.cut(0.5 * (a + b), a - b);
  second.cut(0.5 * (a + b), b - a);
  const double volume = nodes_[idx(node)].volume;
  const double part = area(first) / (area(first) + area(second)) * volume;
  nodes_[idx(node)].children = static_cast<std::int32_t>(nodes_.size());
  add_node(first, part);
  add_node(second, volume - part);
}

std::int32_t WearMap::nearest(const Vec3& x) const {
  double limit2 = std::numeric_limits<double>::max();
  std::int32_t best = 0;
  roots_.walk(x, limit2, [&](std::int32_t root) {
    nearest_below(root, x, limit2, best);
    return limit2;
  });
  return best;
}

/// By the distance of a cell's box.
void WearMap::nearest_below(std::int32_t node,
                            const Vec3& x,
                            double& limit2,
                            std::int32_t& best) const {
  const Node& at = nodes_[idx(node)];
  const double d2 = geometry::distance2(box_of(corners(at)), x);
  if (!(d2 < limit2))
    return;
  if (at.children >= 0) {
    nearest_below(at.children, x, limit2, best);
    nearest_below(at.children + 1, x, limit2, best);
    return;
  }
  limit2 = d2;
  best = node;
}

std::vector<WearCell> WearMap::cells() const {
  std::vector<WearCell> cells;
  for (const Node& node : nodes_)
    if (node.children < 0)
      cells.push_back({shape(node), depth(node)});
  return cells;
}

std::optional<WearCell> WearMap::deepest() const {
  std::optional<WearCell> deepest;
  for (const Node& node : nodes_)
    if (node.children < 0 && depth(node) > (deepest ? deepest->depth : 0.0))
      deepest = WearCell{shape(node), depth(node)};
  return deepest;
}

double WearMap::volume() const {
  double sum = 0.0;
  for (const Node& node : nodes_)
    if (node.children < 0)
      sum += node.volume;
  return sum;
}

} // namespace billet::contact
