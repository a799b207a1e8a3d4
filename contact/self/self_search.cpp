#include "contact/self/self_search.h"

#include "geometry/triangles/box_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace billet::contact {

namespace {

/// Cosine between two outer normals above which faces do not meet.
constexpr double least_facing = -0.2;
/// Of the parent element: so deep a point may already lie inside a face ahead of it, ...
constexpr double most_inside = 0.05;
/// ... one that it has not met so far, or a neighbour: metal ends in wedges as thin as can be.
constexpr double rounding_inside = 1e-6;
/// Of the parent element: a point that is no farther off the edge of a face, where its coordinates
/// end, than its gap and this is still above it.
constexpr double beside = 1e-3;

/// An arc bulges from the chord between two of its nodes by no more than this share of its box.
double bulge_of(const ContactSurface& surface) { return surface.linear() ? 0.0 : 0.125; }

/// Holds a face with these nodes.
Box box_of(std::span<const Vec3> nodes, double bulge) {
  Box box;
  for (const Vec3& node : nodes)
    box.add(node);
  const double margin = bulge * box.size();
  box.low.array() -= margin;
  box.high.array() += margin;
  return box;
}

/// The points and normals of all faces. It is made before every increment, whether or not anything
/// meets: no more than sums over nodes.
struct Outline {
  std::vector<Vec3> nodes;   ///< of each face in turn
  std::size_t nodes_of_face; ///< each has as many
  std::vector<Vec3> points;  ///< contact points
  std::vector<Vec3> normals; ///< of the faces at them, outward
  std::vector<Box> boxes;
  double bulge;

  Outline(const ContactSurface& surface, std::span<const double> x) {
    const auto n = idx(surface.n_faces());
    const bool plane = surface.analysis() != mechanics::Analysis::solid;
    const std::size_t dim = plane ? 2 : 3;
    std::vector<FaceShapes> shapes;
    for (const Vec2& xi : coordinates(surface))
      shapes.emplace_back(surface.kind(), xi);
    nodes_of_face = shapes.front().nodes;
    nodes.resize(n * nodes_of_face, Vec3::Zero());
    points.resize(surface.n_points());
    normals.resize(surface.n_points());
    boxes.resize(n);
    bulge = bulge_of(surface);
    for (std::size_t f = 0; f < n; ++f) {
      const std::span<const Index> numbers = surface.scatter().nodes(static_cast<Index>(f));
      for (std::size_t a = 0; a < nodes_of_face; ++a) {
        Vec3& node = nodes[f * nodes_of_face + a];
        for (std::size_t d = 0; d < dim; ++d)
          node[static_cast<Index>(d)] = x[idx(numbers[a]) * dim + d];
      }
      boxes[f] = box_of(face(f), bulge);
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        const std::size_t k = f * shapes.size() + i;
        points[k] = shapes[i].sum(shapes[i].N, face(f));
        const Vec3 a1 = shapes[i].sum(shapes[i].d1, face(f));
        const Vec3 a2 = plane ? Vec3(Vec3::UnitZ()) : shapes[i].sum(shapes[i].d2, face(f));
        normals[k] = a1.cross(a2).normalized();
      }
    }
  }

  /// Whether a face has any place before the plane of a point, or no more than `inside` behind it:
  /// where it has none, as the other side of a wall, the closest place need not be known.
  [[nodiscard]] bool may_lie_ahead(std::size_t point, std::size_t f, double inside) const {
    const std::span<const Vec3> at = face(f);
    return std::any_of(at.begin(), at.end(), [&](const Vec3& node) {
      return (node - points[point]).dot(normals[point]) >= -inside - bulge * boxes[f].size();
    });
  }
  [[nodiscard]] std::span<const Vec3> face(std::size_t f) const {
    return std::span(nodes).subspan(f * nodes_of_face, nodes_of_face);
  }
  /// Coordinates of the points of a face.
  static std::vector<Vec2> coordinates(const ContactSurface& surface) {
    if (surface.analysis() == mechanics::Analysis::solid)
      return surface.face_coordinates();
    std::vector<Vec2> at;
    for (const double xi : surface.line_coordinates())
      at.emplace_back(xi, 0.0);
    return at;
  }
};

/// Where a point is against a face.
struct Against {
  ClosestPlace place;
  Vec3 normal = Vec3::Zero();
  double gap = 0.0;      ///< along the normal [mm]
  double beside = 0.0;   ///< across it [mm]
  double distance = 0.0; ///< [mm]
};

Against against(const ContactSurface& surface, std::span<const Vec3> face, const Vec3& point) {
  Against at;
  at.place = closest_place(surface.kind(), face, point);
  const bool plane = surface.analysis() != mechanics::Analysis::solid;
  const FaceFrame frame(FaceShapes(surface.kind(), at.place.xi), face, plane);
  at.normal = frame.normal();
  const Vec3 off = point - frame.position;
  at.gap = at.normal.dot(off);
  at.distance = off.norm();
  at.beside = std::sqrt(std::max(0.0, off.squaredNorm() - at.gap * at.gap));
  return at;
}

/// Calls `visit(point, face)` for every point and face that turn to each other, their faces' boxes
/// within a distance, and the face not wholly behind the point. Where nothing meets that leaves
/// hardly any.
template <class Visit>
void visit_facing(const ContactSurface& surface,
                  const Outline& outline,
                  double distance,
                  const Visit& visit) {
  std::vector<Box> boxes = outline.boxes;
  for (Box& box : boxes) {
    box.low.array() -= 0.5 * distance;
    box.high.array() += 0.5 * distance;
  }
  const auto points = idx(surface.points());
  const auto faces_turn = [&](std::size_t f, std::size_t g) {
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t j = 0; j < points; ++j)
        if (outline.normals[f * points + i].dot(outline.normals[g * points + j]) < least_facing)
          return true;
    return false;
  };
  constexpr double safety = 2.0; // what touches may lie a little deeper than it began
  const auto may_meet = [&](std::size_t k, std::size_t g) {
    return outline.may_lie_ahead(k, g, safety * most_inside * surface.depth(static_cast<Index>(g)));
  };
  const auto any_may_meet = [&](std::size_t f, std::size_t g) {
    for (std::size_t i = 0; i < points; ++i)
      if (may_meet(f * points + i, g))
        return true;
    return false;
  };
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  geometry::visit_box_pairs(boxes, [&](std::int32_t f, std::int32_t g) {
    if (faces_turn(idx(f), idx(g)) &&
        (any_may_meet(idx(f), idx(g)) || any_may_meet(idx(g), idx(f))))
      pairs.emplace_back(std::min(f, g), std::max(f, g));
    return true;
  });
  std::sort(pairs.begin(), pairs.end()); // the order of the visits is not specified
  for (const auto& [first, second] : pairs)
    for (const auto& [f, g] : {std::pair{first, second}, std::pair{second, first}})
      for (std::size_t k = idx(f) * points; k < (idx(f) + 1) * points; ++k)
        if (may_meet(k, idx(g)))
          visit(k, static_cast<Index>(g));
}

/// No place of a face is nearer to a point than this: a bound that costs next to nothing [mm].
double
least_distance(const ContactSurface& surface, const std::vector<Vec3>& nodes, const Vec3& point) {
  const Box box = box_of(nodes, bulge_of(surface));
  return (point - point.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

bool have_a_node_in_common(const ContactSurface& surface, Index a, Index b) {
  const std::span<const Index> first = surface.scatter().nodes(a),
                               second = surface.scatter().nodes(b);
  return std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) !=
         first.end();
}

} // namespace

void look_ahead(const ContactSurface& surface,
                std::span<const double> x,
                double distance,
                bool first,
                SelfContactState& state) {
  const Outline outline(surface, x);
  const std::vector<std::vector<Index>> before =
      std::exchange(state.ahead, std::vector<std::vector<Index>>(surface.n_points()));
  state.any_ahead = false;
  state.looked = true;
  state.look_ahead = distance;
  visit_facing(surface, outline, distance, [&](std::size_t k, Index face) {
    const Index own = static_cast<Index>(k / idx(surface.points()));
    const SelfPoint& point = state.points[k];
    const double depth = std::min(surface.depth(own), surface.depth(face));
    const Against at = against(surface, outline.face(idx(face)), outline.points[k]);
    const bool met = first || point.closed() ||
                     std::find(before[k].begin(), before[k].end(), face) != before[k].end();
    const double inside = met && !(first && have_a_node_in_common(surface, own, face))
                              ? most_inside
                              : rounding_inside;
    if (point.face != face && (at.distance > distance || at.gap < -inside * depth ||
                               at.normal.dot(outline.normals[k]) >= least_facing))
      return;
    state.ahead[k].push_back(face);
    state.any_ahead = true;
  });
}

SelfFoot find_foot(const ContactSurface& surface,
                   std::span<const double> x,
                   const std::vector<Index>& ahead,
                   const Vec3& point) {
  SelfFoot best;
  double least = HUGE_VAL;
  for (const Index face : ahead) {
    const std::vector<Vec3> nodes = nodes_of_face(surface, x, face);
    if (least_distance(surface, nodes, point) >= least)
      continue;
    const Against at = against(surface, nodes, point);
    if (at.beside > std::abs(at.gap) + beside * surface.depth(face) || at.distance >= least)
      continue;
    least = at.distance;
    best = {face, at.place, at.gap, at.normal};
  }
  return best;
}

std::optional<SelfPassage> find_passage(const ContactSurface& surface,
                                        std::span<const double> x_old,
                                        std::span<const double> x,
                                        double distance,
                                        const SelfContactState& state) {
  const Outline before(surface, x_old);
  const Outline now(surface, x);
  std::optional<SelfPassage> found;
  visit_facing(surface, before, distance, [&](std::size_t k, Index face) {
    const std::vector<Index>& known = state.ahead[k];
    if (found || std::find(known.begin(), known.end(), face) != known.end())
      return;
    const Against was = against(surface, before.face(idx(face)), before.points[k]);
    if (was.gap < 0.0 || was.normal.dot(before.normals[k]) >= least_facing)
      return;
    const Against is = against(surface, now.face(idx(face)), now.points[k]);
    if (is.gap < 0.0 && is.beside <= std::abs(is.gap) && is.distance <= distance)
      found = SelfPassage{now.points[k]};
  });
  return found;
}

double relative_way(const ContactSurface& surface,
                    std::span<const double> x_old,
                    std::span<const double> x) {
  std::vector<Vec3> before(surface.n_points()), now(surface.n_points());
  if (before.empty())
    return 0.0;
  surface.positions(x_old, before);
  surface.positions(x, now);
  Vec3 mean = Vec3::Zero();
  for (std::size_t k = 0; k < now.size(); ++k)
    mean += (now[k] - before[k]) / static_cast<double>(now.size());
  double most = 0.0;
  for (std::size_t k = 0; k < now.size(); ++k)
    most = std::max(most, (now[k] - before[k] - mean).norm());
  return most;
}

} // namespace billet::contact
