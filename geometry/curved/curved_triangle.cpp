#include "geometry/curved/curved_triangle.h"

#include "geometry/triangles/nearest_in_triangle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace billet::geometry {

namespace {

using Parameters = std::array<double, 2>;

constexpr double close = 1e-3;        // steps of the parameters that are Newton's without a check
constexpr double converged = 1e-8;    // step after which there is nothing but rounding
constexpr double rough = 1e-3;        // step that ends the search on the cubic alone
constexpr double least_share = 1e-3;  // of a step
constexpr double overrun = 0.1;       // of the barycentric coordinates
constexpr double overlap = 1e-13;     // of two triangles: a foot on their edge is never lost
constexpr int intervals = 8;          // along an edge, for bounds and shape
constexpr double least_convex = 0.05; // of the squared distance against the metric

/// Barycentric coordinates as functions of (v, w).
std::array<Taylor2, 3> coordinates(double v, double w) {
  return {Taylor2{1.0 - v - w, -1.0, -1.0, 0.0, 0.0, 0.0}, Taylor2{v, 1.0, 0.0, 0.0, 0.0, 0.0},
          Taylor2{w, 0.0, 1.0, 0.0, 0.0, 0.0}};
}

/// Largest share of the step that stays within the triangle and a margin around it, over which the
/// search may pass.
double share_inside(const Parameters& p, double dv, double dw) {
  double share = 1.0;
  for (const auto& [b, d] : {std::pair{1.0 - p[0] - p[1], -dv - dw}, {p[0], dv}, {p[1], dw}})
    if (d < 0.0 && b + share * d < -overrun)
      share = std::max(0.0, -(b + overrun) / d);
  return share;
}

/// Gradient and second derivatives of half the squared distance, and the metric.
struct Distance {
  double gv, gw;        ///< gradient
  double hvv, hvw, hww; ///< second derivatives
  double mvv, mvw, mww; ///< metric of the surface
  [[nodiscard]] bool convex() const {
    return hvv + hww > 0.0 &&
           hvv * hww - hvw * hvw > least_convex * least_convex * (mvv * mww - mvw * mvw);
  }
};

Distance distance(const SurfacePoint& s, const Vec3& x) {
  const Vec3 r = s.position - x;
  Distance d{};
  d.gv = r.dot(s.v);
  d.gw = r.dot(s.w);
  d.mvv = s.v.squaredNorm();
  d.mvw = s.v.dot(s.w);
  d.mww = s.w.squaredNorm();
  d.hvv = d.mvv + r.dot(s.vv);
  d.hvw = d.mvw + r.dot(s.vw);
  d.hww = d.mww + r.dot(s.ww);
  return d;
}

/// Of `Quarters::points`: at each corner, and the one in the middle.
constexpr std::array<std::array<std::size_t, 3>, 4> quarter_corners{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

Parameters solve(double a, double b, double c, double p, double q) {
  const double det = a * c - b * b;
  return {(p * c - q * b) / det, (q * a - p * b) / det};
}

} // namespace

Vec3 SurfacePoint::normal() const { return v.cross(w).stableNormalized(); }

std::optional<Mat3> normal_slope(const SurfacePoint& at, double gap) {
  const Vec3 n = at.normal();
  Mat2 metric, bend;
  metric << at.v.dot(at.v), at.v.dot(at.w), at.v.dot(at.w), at.w.dot(at.w);
  bend << at.vv.dot(n), at.vw.dot(n), at.vw.dot(n), at.ww.dot(n);
  const Mat2 level = metric - gap * bend;
  if (!(level.determinant() > 1e-9 * metric.determinant()) || !(level.trace() > 0.0))
    return std::nullopt;
  const Mat2 slope = metric.inverse() * bend * level.inverse();
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << at.v, at.w;
  const Mat3 result = -tangents * slope * tangents.transpose();
  return Mat3(0.5 * (result + result.transpose()));
}

CurvedTriangle::CurvedTriangle(const std::array<Side, 3>& sides) : sides_(sides) {
  Vec3 corners = Vec3::Zero(), handles = Vec3::Zero();
  for (const Side& side : sides_) {
    corners += side.curve.control[0] / 3.0;
    handles += (side.curve.control[1] + side.curve.control[2]) / 6.0;
  }
  centre_ = 1.5 * handles - 0.5 * corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& c = sides_[i].curve.control;
    const Vec3& from_start = sides_[(i + 2) % 3].curve.control[2];
    const Vec3& from_end = sides_[(i + 1) % 3].curve.control[1];
    across_[i] = {3.0 * from_start - 1.5 * (c[0] + c[1]), 3.0 * centre_ - 1.5 * (c[1] + c[2]),
                  3.0 * from_end - 1.5 * (c[2] + c[3])};
    bends_[i] = false;
    if (sides_[i].curve.kind != EdgeKind::smooth)
      continue;
    for (const double t : {0.0, 0.15, 0.3, 0.5, 0.7, 0.85, 1.0})
      bends_[i] = bends_[i] || bend(i, t).f.norm() > 1e-13 * (c[3] - c[0]).norm();
  }
}

Parameters CurvedTriangle::on_side(std::size_t i, double t) const {
  std::array<double, 3> b{};
  const double s = sides_[i].forward ? t : 1.0 - t;
  b[i] = 1.0 - s;
  b[(i + 1) % 3] = s;
  return {b[1], b[2]};
}

// What the derivative across edge i lacks to be at right angles to the normal of the edge. (G.20)
Taylor1<Vec3> CurvedTriangle::bend(std::size_t side, double t) const {
  const EdgeCurve& curve = sides_[side].curve;
  const auto& c = curve.control;
  const auto& a = across_[side];
  const CurvePoint point = curve.at(t);
  const Taylor1<Vec3> along{point.d, point.dd, 6.0 * (c[3] - 3.0 * c[2] + 3.0 * c[1] - c[0])};
  const double s = 1.0 - t;
  const Taylor1<Vec3> mean{s * curve.normals[0] + t * curve.normals[1],
                           curve.normals[1] - curve.normals[0], Vec3::Zero()};
  const Taylor1<Vec3> normal = mean - dot(mean, along) / dot(along, along) * along;
  const Taylor1<Vec3> across{s * s * a[0] + 2.0 * s * t * a[1] + t * t * a[2],
                             2.0 * (s * (a[1] - a[0]) + t * (a[2] - a[1])),
                             2.0 * (a[2] - 2.0 * a[1] + a[0])};
  const Taylor1<double> share = dot(across, normal) / dot(normal, normal);
  return Taylor1<Vec3>{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()} - share * normal;
}

// Each bend acts on the slope across its own edge only: the blend is 1 there and vanishes with its
// slope on the other two. (G.20)
void CurvedTriangle::add_bends(double v, double w, SurfacePoint& at) const {
  if (!bends_[0] && !bends_[1] && !bends_[2])
    return;
  const std::array<Taylor2, 3> b = coordinates(v, w);
  std::array<Taylor2, 3> weight{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Taylor2 product = b[i] * b[(i + 1) % 3];
    weight[i] = product * product;
  }
  const Taylor2 sum = weight[0] + weight[1] + weight[2];
  if (!(sum.f > 1e-200)) // a corner: blends and their slopes vanish
    return;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!bends_[i])
      continue;
    const Taylor2 blend = b[(i + 2) % 3] * (weight[i] / sum);
    const Taylor2 &from = b[i], &to = b[(i + 1) % 3];
    const double tv = 0.5 * (to.v - from.v), tw = 0.5 * (to.w - from.w);
    const Taylor1<Vec3> k = bend(i, 0.5 * (1.0 + to.f - from.f));
    at.position += blend.f * k.f;
    at.v += blend.v * k.f + blend.f * tv * k.d;
    at.w += blend.w * k.f + blend.f * tw * k.d;
    at.vv += blend.vv * k.f + 2.0 * blend.v * tv * k.d + blend.f * tv * tv * k.dd;
    at.vw += blend.vw * k.f + (blend.v * tw + blend.w * tv) * k.d + blend.f * tv * tw * k.dd;
    at.ww += blend.ww * k.f + 2.0 * blend.w * tw * k.d + blend.f * tw * tw * k.dd;
  }
}

// The cubic is a quadratic in its own derivatives' control points; here by powers. (G.19)
SurfacePoint CurvedTriangle::cubic(double v, double w) const {
  const std::array<double, 3> b{1.0 - v - w, v, w};
  Vec3 position = 6.0 * b[0] * b[1] * b[2] * centre_;
  std::array<Vec3, 3> d;  // by each coordinate
  std::array<Vec3, 3> dd; // twice by each coordinate
  std::array<Vec3, 3> m;  // by coordinates i and i + 1
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    d[i] = 6.0 * b[j] * b[k] * centre_ + 3.0 * b[i] * b[i] * sides_[i].curve.control[0];
    dd[i] = 6.0 * b[i] * sides_[i].curve.control[0];
    m[i] = 6.0 * b[k] * centre_;
    position += b[i] * b[i] * b[i] * sides_[i].curve.control[0];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vec3 &near = sides_[i].curve.control[1], &far = sides_[i].curve.control[2];
    position += 3.0 * b[i] * b[j] * (b[i] * near + b[j] * far);
    d[i] += 6.0 * b[i] * b[j] * near + 3.0 * b[j] * b[j] * far;
    d[j] += 3.0 * b[i] * b[i] * near + 6.0 * b[i] * b[j] * far;
    dd[i] += 6.0 * b[j] * near;
    dd[j] += 6.0 * b[i] * far;
    m[i] += 6.0 * (b[i] * near + b[j] * far);
  }
  return {position,
          d[1] - d[0],
          d[2] - d[0],
          dd[1] - 2.0 * m[0] + dd[0],
          m[1] - m[0] - m[2] + dd[0],
          dd[2] - 2.0 * m[2] + dd[0]};
}

SurfacePoint CurvedTriangle::at(double v, double w) const {
  SurfacePoint point = cubic(v, w);
  add_bends(v, w, point);
  return point;
}

// Sampled. The weights b_k W_ij of the bends add up to 1/3 at most: to the sum of all 1/b over that
// of their squares, while the b add up to 1.
double CurvedTriangle::largest_bend() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k <= intervals && bends_[i]; ++k)
      largest = std::max(largest, bend(i, static_cast<double>(k) / intervals).f.norm());
  return largest / 3.0;
}

// The cubic lies within the hull of its control points.
Box CurvedTriangle::bounds() const {
  Box box;
  box.add(centre_);
  for (const Side& side : sides_)
    for (const Vec3& c : side.curve.control)
      box.add(c);
  const double largest = largest_bend();
  box.low.array() -= largest;
  box.high.array() += largest;
  return box;
}

// De Casteljau's steps with another place in each: the control points are the corners', the edges'
// and the middle's, each known by how many of the three steps go to each corner.
Vec3 CurvedTriangle::blossom(const Corners& at) const {
  const auto control = [&](const std::array<std::size_t, 3>& to) -> const Vec3& {
    if (to[0] == to[1] && to[1] == to[2])
      return sides_[to[0]].curve.control[0];
    if (to[0] != to[1] && to[1] != to[2] && to[2] != to[0])
      return centre_;
    const std::size_t twice = to[0] == to[1] || to[0] == to[2] ? to[0] : to[1];
    const std::size_t once = to[0] != twice ? to[0] : to[1] != twice ? to[1] : to[2];
    return once == (twice + 1) % 3 ? sides_[twice].curve.control[1] : sides_[once].curve.control[2];
  };
  Vec3 point = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        point += at[0][i] * at[1][j] * at[2][k] * control({i, j, k});
  return point;
}

// A cubic in Bernstein form is a mean of its control points, and each of them is at most as far
// from the straight triangle as from the point of it with the same parameters.
double CurvedTriangle::rise_between(const Corners& corners) const {
  std::array<Vec3, 3> places;
  for (std::size_t i = 0; i < 3; ++i)
    places[i] = blossom({corners[i], corners[i], corners[i]});
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      for (std::size_t k = j; k < 3; ++k)
        largest = std::max(largest, (blossom({corners[i], corners[j], corners[k]}) -
                                     (places[i] + places[j] + places[k]) / 3.0)
                                        .norm());
  return largest + largest_bend();
}

double CurvedTriangle::rise() const {
  return rise_between({{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}});
}

// Bends vanish on the edges, so their middles are the cubic's.
Quarters CurvedTriangle::quarters() const {
  constexpr std::array<std::array<double, 3>, 6> places{{{1.0, 0.0, 0.0},
                                                         {0.0, 1.0, 0.0},
                                                         {0.0, 0.0, 1.0},
                                                         {0.5, 0.5, 0.0},
                                                         {0.0, 0.5, 0.5},
                                                         {0.5, 0.0, 0.5}}};
  Quarters quarters{};
  for (std::size_t i = 0; i < places.size(); ++i)
    quarters.points[i] = blossom({places[i], places[i], places[i]});
  for (std::size_t q = 0; q < quarter_corners.size(); ++q) {
    const auto& [a, b, c] = quarter_corners[q];
    quarters.rises[q] = rise_between({places[a], places[b], places[c]});
  }
  return quarters;
}

double Quarters::least_distance2(const Vec3& x) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t q = 0; q < quarter_corners.size(); ++q) {
    const auto& [a, b, c] = quarter_corners[q];
    const auto [u, v, w] = nearest_in_triangle(points[a], points[b], points[c], x);
    const double distance = (u * points[a] + v * points[b] + w * points[c] - x).norm();
    least = std::min(least, std::max(0.0, distance - rises[q]));
  }
  return least * least;
}

CurvedTriangle::Shape CurvedTriangle::shape() const {
  const Vec3& a = sides_[0].curve.control[0];
  const Vec3 n =
      (sides_[1].curve.control[0] - a).cross(sides_[2].curve.control[0] - a).stableNormalized();
  Shape shape{0.0, 1.0};
  for (int i = 0; i <= intervals; ++i)
    for (int k = 0; i + k <= intervals; ++k) {
      const SurfacePoint s =
          at(static_cast<double>(i) / intervals, static_cast<double>(k) / intervals);
      shape.departure = std::max(shape.departure, std::abs((s.position - a).dot(n)));
      shape.least_cosine = std::min(shape.least_cosine, s.normal().dot(n));
    }
  return shape;
}

namespace {

/// Where a search for the foot has led, and whether that is a foot, inside the triangle or outside
/// of it.
struct Approach {
  Parameters at;
  bool converged;
};

/// Newton's method for (G.21) until a step is no longer than `shortest`, which it still takes.
///
/// @param surface  point of the surface at (v, w)
template <class Surface>
Approach approach(const Surface& surface, const Vec3& x, Parameters p, double shortest) {
  SurfacePoint s = surface(p);
  constexpr int most = 40;
  for (int i = 0; i < most; ++i) {
    const Distance d = distance(s, x);
    const bool convex = d.convex();
    const Parameters step = convex ? solve(d.hvv, d.hvw, d.hww, -d.gv, -d.gw)
                                   : solve(d.mvv, d.mvw, d.mww, -d.gv, -d.gw);
    const double size = std::max(std::abs(step[0]), std::abs(step[1]));
    if (!(size < std::numeric_limits<double>::infinity()))
      return {p, false};
    if (convex && size < shortest)
      return {{p[0] + step[0], p[1] + step[1]}, true};
    double share = share_inside(p, step[0], step[1]);
    if (share * size < shortest)
      return {p, false}; // pushed against the margin
    const double before = (s.position - x).squaredNorm();
    for (;; share *= 0.5) {
      const Parameters next{p[0] + share * step[0], p[1] + share * step[1]};
      s = surface(next);
      if ((convex && size < close) || (s.position - x).squaredNorm() <= before) {
        p = next;
        break;
      }
      if (share < least_share)
        return {p, false};
    }
  }
  return {p, false};
}

} // namespace

// The cubic alone leads near the foot, or out of the triangle, for a quarter of the work.
std::optional<Parameters> CurvedTriangle::foot(const Vec3& x, Parameters p) const {
  if (bends_[0] || bends_[1] || bends_[2]) {
    const auto [led_to, near_foot] =
        approach([this](const Parameters& q) { return cubic(q[0], q[1]); }, x, p, rough);
    if (near_foot)
      p = led_to;
  }
  const auto [at, is_foot] =
      approach([this](const Parameters& q) { return this->at(q[0], q[1]); }, x, p, converged);
  const bool inside = std::min({at[0], at[1], 1.0 - at[0] - at[1]}) > -overlap;
  return is_foot && inside ? std::optional(at) : std::nullopt;
}

CurvedTriangle curved_triangle(const TriangleMesh& mesh, const EdgeCurves& edges, std::size_t t) {
  std::array<CurvedTriangle::Side, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i) {
    const bool forward = mesh.triangles[t][i] < mesh.triangles[t][(i + 1) % 3];
    EdgeCurve curve = edges.curves[static_cast<std::size_t>(edges.of_triangle[t][i])];
    if (!forward) {
      std::reverse(curve.control.begin(), curve.control.end());
      std::swap(curve.normals[0], curve.normals[1]);
    }
    sides[i] = {curve, forward};
  }
  return CurvedTriangle(sides);
}

} // namespace billet::geometry
