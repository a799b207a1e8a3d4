#include "geometry/curved/edge_curves.h"

#include "geometry/triangles/edge_table.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace billet::geometry {

namespace {

constexpr double least_crease = 0.05; // sine between two tangent planes that fixes their line
constexpr double least_handle_cosine =
    0.25;                                // between a handle and its chord; below, a straight edge
constexpr double close_on_curve = 1e-3;  // steps of the parameter that are Newton's without a check
constexpr double found_on_curve = 1e-14; // step that ends the search
constexpr double least_share_of_step = 1e-3;             // of a step
constexpr double exact = 1e-12;                          // share of the length that is rounding
constexpr double straight_offset = same_direction / 6.0; // share of the length, of a handle

// Handle at the end with normal n0: in its tangent plane, exact to sixth order on circles and
// unchanged by any extrusion. (G.17)
Vec3 smooth_handle(const Vec3& e, const Vec3& n0, const Vec3& n1) {
  const double cosine = n0.dot(n1);
  if (cosine < least_handle_cosine)
    return e / 3.0;
  const Vec3 turn = n1 - n0;
  const double half = 1.0 + std::sqrt(0.5 * (1.0 + cosine));
  const Vec3 along = e - e.dot(turn) / (4.0 * half * half) * turn;
  return (along - along.dot(n0) / (1.0 + cosine) * (n0 + n1)) / 3.0;
}

// Handle along the line in which the tangent planes of both sides meet. (G.18)
Vec3 sharp_handle(const Vec3& e, const Vec3& n, const Vec3& m) {
  const Vec3 line = n.cross(m);
  if (line.norm() < least_crease)
    return e / 3.0;
  const double sine = line.norm(), length = e.norm();
  const double cosine = std::abs(line.dot(e)) / (sine * length);
  if (cosine < least_handle_cosine)
    return e / 3.0;
  const double sign = line.dot(e) < 0.0 ? -1.0 : 1.0;
  return 2.0 / 3.0 * length / (1.0 + cosine) * sign / sine * line;
}

/// Normals that the two sides of an edge have at one of its ends.
struct EndNormals {
  std::array<Vec3, 2> sides;
  bool tip;
  bool split; ///< the sides differ
};

EndNormals end_normals(const TriangleMesh& mesh,
                       const CornerNormals& normals,
                       std::span<const EdgeUse> uses,
                       std::int32_t vertex) {
  EndNormals end{{Vec3::Zero(), Vec3::Zero()}, false, false};
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto t = static_cast<std::size_t>(uses[i].triangle);
    const auto& corners = mesh.triangles[t];
    const auto c = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) -
                                            corners.begin());
    end.sides[i] = normals.corners[t][c];
    end.tip = end.tip || normals.is_tip[t][c] != 0;
  }
  if (uses.size() == 1)
    end.sides[1] = end.sides[0];
  end.split = end.sides[0].cross(end.sides[1]).norm() > same_direction ||
              end.sides[0].dot(end.sides[1]) < 0.0;
  return end;
}

// Both sides keep their direction along the edge. Offsets alone do not tell: those of a long
// diagonal over a narrow curved strip are a tiny share of its length.
bool same_sides(const EndNormals& a, const EndNormals& b) {
  return a.sides[0].cross(b.sides[0]).norm() < same_direction &&
         a.sides[1].cross(b.sides[1]).norm() < same_direction;
}

Vec3 handle(EdgeKind kind, const Vec3& e, const EndNormals& here, const EndNormals& there) {
  if (kind == EdgeKind::sharp && here.tip)
    return e / 3.0;
  if (kind == EdgeKind::sharp && here.split)
    return sharp_handle(e, here.sides[0], here.sides[1]);
  const Vec3 n0 = (here.sides[0] + here.sides[1]).normalized();
  const Vec3 n1 = (there.sides[0] + there.sides[1]).normalized();
  return smooth_handle(e, n0, n1);
}

EdgeCurve
curve_over(const TriangleMesh& mesh, const CornerNormals& normals, std::span<const EdgeUse> uses) {
  const auto t = static_cast<std::size_t>(uses[0].triangle);
  const auto s = static_cast<std::size_t>(uses[0].side);
  EdgeCurve curve{};
  curve.kind = normals.is_border[t][s] != 0  ? EdgeKind::border
               : normals.is_sharp[t][s] != 0 ? EdgeKind::sharp
                                             : EdgeKind::smooth;
  curve.ends = {uses[0].low, uses[0].high};
  curve.triangles = {uses[0].triangle, uses.size() > 1 ? uses[1].triangle : -1};
  const Vec3& a = mesh.points[static_cast<std::size_t>(uses[0].low)];
  const Vec3& b = mesh.points[static_cast<std::size_t>(uses[0].high)];
  const EndNormals at_a = end_normals(mesh, normals, uses, uses[0].low);
  const EndNormals at_b = end_normals(mesh, normals, uses, uses[0].high);
  curve.normals = {(at_a.sides[0] + at_a.sides[1]).normalized(),
                   (at_b.sides[0] + at_b.sides[1]).normalized()};
  const Vec3 e = b - a;
  Vec3 from_a = handle(curve.kind, e, at_a, at_b), from_b = handle(curve.kind, -e, at_b, at_a);
  const double offset = std::max((from_a - e / 3.0).norm(), (from_b + e / 3.0).norm());
  curve.straight = offset <= (same_sides(at_a, at_b) ? straight_offset : exact) * e.norm();
  if (curve.straight) {
    from_a = e / 3.0;
    from_b = -e / 3.0;
  }
  curve.control = {a, a + from_a, b + from_b, b};
  return curve;
}

double distance2_at(const EdgeCurve& curve, double t, const Vec3& x) {
  return (curve.at(t).position - x).squaredNorm();
}

} // namespace

CurvePoint EdgeCurve::at(double t) const {
  const double s = 1.0 - t;
  const auto& c = control;
  return {s * s * s * c[0] + 3.0 * s * s * t * c[1] + 3.0 * s * t * t * c[2] + t * t * t * c[3],
          3.0 * (s * s * (c[1] - c[0]) + 2.0 * s * t * (c[2] - c[1]) + t * t * (c[3] - c[2])),
          6.0 * (s * (c[2] - 2.0 * c[1] + c[0]) + t * (c[3] - 2.0 * c[2] + c[1]))};
}

// Newton's method; far from the solution the distance must fall, close_on_curve to it differences
// of distances are rounding and the plain step is taken.
ClosestOnCurve closest_on(const EdgeCurve& curve, const Vec3& x) {
  const Vec3 chord = curve.control[3] - curve.control[0];
  double t = std::clamp((x - curve.control[0]).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
  constexpr int most = 30;
  for (int i = 0; i < most && !curve.straight; ++i) {
    const CurvePoint c = curve.at(t);
    const Vec3 v = c.position - x;
    const double slope = v.dot(c.d), square = c.d.squaredNorm(), bend = square + v.dot(c.dd);
    const bool convex = bend > 0.1 * square;
    const double next = std::clamp(t - slope / (convex ? bend : square), 0.0, 1.0);
    double share = convex && std::abs(next - t) < close_on_curve ? 0.0 : 1.0;
    while (share > least_share_of_step &&
           distance2_at(curve, t + share * (next - t), x) > v.squaredNorm())
      share *= 0.5;
    const double step = (share > 0.0 ? share : 1.0) * (next - t);
    t += step;
    if (std::abs(step) < found_on_curve)
      break;
  }
  ClosestOnCurve best{t, distance2_at(curve, t, x)};
  for (const double end : {0.0, 1.0}) {
    const double distance2 = (curve.control[end > 0.5 ? 3 : 0] - x).squaredNorm();
    if (distance2 <= best.distance2)
      best = {end, distance2};
  }
  return best;
}

EdgeCurves edge_curves(const TriangleMesh& mesh, const CornerNormals& normals) {
  EdgeCurves result;
  result.of_triangle.resize(mesh.triangles.size());
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses)
      result
          .of_triangle[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.side)] =
          static_cast<std::int32_t>(result.curves.size());
    result.curves.push_back(curve_over(mesh, normals, uses));
  });
  return result;
}

} // namespace billet::geometry
