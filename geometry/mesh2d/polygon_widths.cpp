#include "geometry/mesh2d/polygon_widths.h"

#include "geometry/base/angle.h"
#include "geometry/base/box.h"
#include "geometry/base/error.h"
#include "geometry/mesh2d/triangulation_walk.h"
#include "geometry/triangles/box_pairs.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace billet::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Faces = CGAL::Triangulation_face_base_with_info_2<int, Kernel, FaceBase>;
using Structure =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>, Faces>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;

/// Walls face each other if the way along the normal of one meets the other within 30 degrees of
/// its normal.
constexpr double facing = 0.5 * std::numbers::sqrt3;

/// Rays at a corner that points inwards are no farther apart.
constexpr double fan = std::numbers::pi / 12.0;

/// Most rays from one side.
constexpr double most_rays = 64.0;

Point point(const Vec2& x) { return {x.x(), x.y()}; }
Vec2 vec(const Point& p) { return {p.x(), p.y()}; }
Vec2 left_of(const Vec2& way) { return Vec2(-way.y(), way.x()).normalized(); }

struct Chord {
  Vec2 from, to;
  std::size_t polygon;
  std::size_t next; ///< number of the chord that follows it
};

std::vector<Chord> chords(std::span<const Polygon> polygons) {
  std::vector<Chord> result;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const std::size_t first = result.size(), n = polygons[k].size();
    for (std::size_t i = 0; i < n; ++i)
      result.push_back({polygons[k][i], polygons[k][(i + 1) % n], k, first + (i + 1) % n});
  }
  return result;
}

[[noreturn]] void refuse(const Vec2& x, const std::string& what) {
  throw Error(Fault::geometry, "", fmt::format("{} near ({:.6g}, {:.6g})", what, x.x(), x.y()));
}

/// Whether a chord and the one that follows it share more than their corner.
bool folds_back(const Chord& a, const Chord& b) {
  return CGAL::orientation(point(a.from), point(a.to), point(b.to)) == CGAL::COLLINEAR &&
         (a.to - a.from).dot(b.to - b.from) < 0.0;
}

void require_simple(const std::vector<Chord>& all) {
  std::vector<Box> boxes(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const Vec2& x : {all[i].from, all[i].to})
      boxes[i].add({x.x(), x.y(), 0.0});
  auto first = std::pair<std::int32_t, std::int32_t>(-1, -1);
  visit_box_pairs(boxes, [&](std::int32_t i, std::int32_t j) {
    const Chord &a = all[static_cast<std::size_t>(i)], &b = all[static_cast<std::size_t>(j)];
    const bool a_first = a.next == static_cast<std::size_t>(j);
    const bool b_first = b.next == static_cast<std::size_t>(i);
    const bool wrong = a_first ? folds_back(a, b)
                       : b_first
                           ? folds_back(b, a)
                           : CGAL::do_intersect(Kernel::Segment_2(point(a.from), point(a.to)),
                                                Kernel::Segment_2(point(b.from), point(b.to)));
    if (wrong && (first.first < 0 || std::pair(i, j) < first)) // the order of visits is not ours
      first = {i, j};
    return true;
  });
  if (first.first >= 0)
    refuse(all[static_cast<std::size_t>(first.first)].to,
           "the boundary of the domain crosses or touches itself");
}

/// The polygons and what they bound.
class Domain {
public:
  explicit Domain(const std::vector<Chord>& all) : all_(all) {
    Face near;
    for (const Chord& chord : all) {
      corners_.push_back(triangulation_.insert(point(chord.from), near));
      near = corners_.back()->face();
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      triangulation_.insert_constraint(corners_[i], corners_[all[i].next]);
    mark_domain(triangulation_);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (edge_of(i).first->info() != 1)
        refuse(all[i].from, "the domain does not lie on the left of its boundary");
  }

  /// Ways from a side along its normal; more of them where they are shorter than it.
  void add_from_side(std::size_t i, double most, std::vector<Width>& result) const {
    const Chord& chord = all_[i];
    const double length = (chord.to - chord.from).norm();
    const std::size_t before = result.size();
    add_ray(i, 0.5, most, result);
    if (result.size() == before || result.back().width > length)
      return;
    const double rays = std::min(most_rays, std::ceil(length / result.back().width));
    for (std::size_t k = 0; k < static_cast<std::size_t>(rays); ++k)
      add_ray(i, (static_cast<double>(k) + 0.5) / rays, most, result);
  }

  /// Ways from the end of side i, if it points into the domain, between the normals of both sides.
  void add_from_corner(std::size_t i, double most, std::vector<Width>& result) const {
    const Vec2 in = all_[i].to - all_[i].from;
    const Vec2 out = all_[all_[i].next].to - all_[i].to;
    const double turn = std::atan2(cross(in, out), in.dot(out));
    if (turn > -fan)
      return;
    const double rays = std::ceil(-turn / fan);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(rays); ++k) {
      const double angle = turn * (static_cast<double>(k) / rays);
      const double c = std::cos(angle), s = std::sin(angle);
      const Vec2 normal = left_of(in);
      const Vec2 direction(c * normal.x() - s * normal.y(), s * normal.x() + c * normal.y());
      add_from_vertex(corners_[all_[i].next], direction, most, result);
    }
  }

private:
  /// The face left of a side, and the side's number in it.
  [[nodiscard]] std::pair<Face, int> edge_of(std::size_t i) const {
    const Vertex a = corners_[i], b = corners_[all_[i].next];
    Face face;
    int edge = 0;
    triangulation_.is_edge(a, b, face, edge);
    if (face->vertex(Triangulation::ccw(edge)) == a)
      return {face, edge};
    return {face->neighbor(edge), triangulation_.tds().mirror_index(face, edge)};
  }

  void add_ray(std::size_t i, double at, double most, std::vector<Width>& result) const {
    const Chord& chord = all_[i];
    const Vec2 from = chord.from + at * (chord.to - chord.from);
    const Vec2 direction = left_of(chord.to - chord.from);
    const auto [face, entry] = edge_of(i);
    const Point p = point(from), q = point(from + most * direction);
    add_way(face, exit_of(triangulation_, face, entry, p, q), from, direction, most, result);
  }

  void add_from_vertex(Vertex vertex,
                       const Vec2& direction,
                       double most,
                       std::vector<Width>& result) const {
    const Vec2 from = vec(vertex->point());
    const Point q = point(from + most * direction);
    auto face = triangulation_.incident_faces(vertex);
    const auto start = face;
    do {
      const int own = face->index(vertex);
      if (face->info() == 1 &&
          triangulation_.orientation(vertex->point(), q,
                                     face->vertex(Triangulation::ccw(own))->point()) <= 0 &&
          triangulation_.orientation(vertex->point(), q,
                                     face->vertex(Triangulation::cw(own))->point()) >= 0)
        return add_way(face, own, from, direction, most, result);
    } while (++face != start);
  }

  void add_way(Face face,
               int exit,
               const Vec2& from,
               const Vec2& direction,
               double most,
               std::vector<Width>& result) const {
    const auto end = walk(triangulation_, face, exit, point(from), point(from + most * direction));
    if (end.edge < 0)
      return;
    const Vec2 a = vec(end.face->vertex(Triangulation::ccw(end.edge))->point());
    const Vec2 b = vec(end.face->vertex(Triangulation::cw(end.edge))->point());
    const double across = -left_of(b - a).dot(direction);
    if (across < facing)
      return;
    const double width = left_of(b - a).dot(from - a) / across;
    result.push_back({from, from + width * direction, width});
  }

  const std::vector<Chord>& all_;
  Triangulation triangulation_;
  std::vector<Vertex> corners_; ///< first ones of the chords
};

} // namespace

std::vector<Width> widths(std::span<const Polygon> polygons, double most) {
  const std::vector<Chord> all = chords(polygons);
  require_simple(all);
  const Domain domain(all);
  std::vector<Width> result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    domain.add_from_side(i, most, result);
    domain.add_from_corner(i, most, result);
  }
  return result;
}

} // namespace billet::geometry
