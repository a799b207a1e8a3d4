#include "geometry/surfaces/smooth_triangle_surface.h"

#include "geometry/base/error.h"
#include "geometry/collision/narrow_parts.h"
#include "geometry/curved/curved_triangle.h"
#include "geometry/curved/edge_curves.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/triangles/box_tree.h"
#include "geometry/triangles/corner_normals.h"
#include "geometry/triangles/triangle_features.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace billet::geometry {

namespace {

constexpr double inside_surface = -std::numeric_limits<double>::infinity(); // no overshoot
constexpr double least_normal_cosine =
    0.5;                           // of a normal against its facet; below, the patch may fold
constexpr double aligned = 1e-6;   // share of the distance that may lie along the surface
constexpr double rounding = 1e-12; // share of the size of the mesh

enum class Kind {
  facet,     ///< flat with straight sides: what the raw surface has
  flat,      ///< flat with a curved side, sharp or at the border
  curved,    ///< part of a smooth surface
  unchanged, ///< should be curved and cannot be
};

/// Where on a triangle the closest point is.
struct Place {
  enum class On { facet, inside, side };

  double distance2 = std::numeric_limits<double>::infinity(); ///< [mm^2]
  On on = On::facet;
  ClosestFeature feature{};   ///< of a facet
  std::array<double, 2> at{}; ///< (v, w) inside a curved triangle
  std::size_t side = 0;       ///< of the triangle
  double t = 0.0;             ///< parameter on that side
};

class SmoothTriangleSurface final : public RigidSurface {
public:
  SmoothTriangleSurface(const TriangleMesh& mesh, double feature_angle);

  [[nodiscard]] Box bounds() const override { return bounds_; }
  [[nodiscard]] DisplayMesh display(const Box& /*window*/, bool /*planar*/) const override {
    return {features_.mesh().points, {}, features_.mesh().triangles};
  }
  [[nodiscard]] std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const override {
    return geometry::narrow_parts(features_.mesh(), search);
  }
  [[nodiscard]] const Smoothing& smoothing() const { return smoothing_; }

private:
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override;
  [[nodiscard]] Projection project_one(const Vec3& x, double reach, std::int32_t hint) const;

  [[nodiscard]] Kind classify(std::size_t t, const CurvedTriangle& patch);
  [[nodiscard]] std::int32_t nearest_facet(const Vec3& x, double reach) const;
  [[nodiscard]] double rough_distance2(std::int32_t triangle, const Vec3& x) const;
  [[nodiscard]] double least_distance2(std::int32_t triangle, const Vec3& x, double rough2) const;
  [[nodiscard]] Place closest(std::int32_t triangle, const Vec3& x, double least2) const;
  [[nodiscard]] Place closest_on_side(std::size_t t, const Vec3& x) const;
  [[nodiscard]] bool beneath(std::size_t t, const Vec3& x) const;
  [[nodiscard]] std::array<double, 2> start(std::size_t t, const Vec3& x) const;

  [[nodiscard]] Projection project(std::size_t t, const Place& place, const Vec3& x) const;
  [[nodiscard]] Projection on_face(std::size_t t, const Vec3& x) const;
  [[nodiscard]] Projection on_facet(std::size_t t, const Place& place, const Vec3& x) const;
  [[nodiscard]] Projection on_side(std::size_t t, const Place& place, const Vec3& x) const;
  [[nodiscard]] Projection on_sharp_side(std::size_t t, const Place& place, const Vec3& x) const;
  [[nodiscard]] Vec3 side_normal(std::int32_t triangle, std::int32_t edge, double t) const;

  [[nodiscard]] const Vec3& corner(std::size_t t, std::size_t i) const {
    return features_.mesh().points[static_cast<std::size_t>(features_.mesh().triangles[t][i])];
  }
  [[nodiscard]] const EdgeCurve& curve(std::size_t t, std::size_t side) const {
    return edges_.curves[static_cast<std::size_t>(edges_.of_triangle[t][side])];
  }

  TriangleFeatures features_;
  CornerNormals normals_;
  EdgeCurves edges_;
  std::vector<CurvedTriangle> patches_;
  std::vector<Kind> kinds_;
  std::vector<Box> boxes_;    // of the patches
  std::vector<double> rises_; // of the patches off their facets
  std::vector<Quarters> quarters_;
  BoxTree tree_;
  Box bounds_;
  Smoothing smoothing_;
};

SmoothTriangleSurface::SmoothTriangleSurface(const TriangleMesh& mesh, double feature_angle)
    : features_(mesh), normals_(corner_normals(mesh, feature_angle)),
      edges_(edge_curves(mesh, normals_)) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    patches_.push_back(curved_triangle(mesh, edges_, t));
    kinds_.push_back(classify(t, patches_.back()));
    const bool is_facet = kinds_.back() == Kind::facet || kinds_.back() == Kind::unchanged;
    Box box = is_facet ? Box{} : patches_.back().bounds();
    rises_.push_back(is_facet ? 0.0 : patches_.back().rise());
    quarters_.push_back(is_facet ? Quarters{} : patches_.back().quarters());
    for (std::size_t i = 0; i < 3; ++i)
      box.add(corner(t, i));
    bounds_.add(box.low);
    bounds_.add(box.high);
    boxes_.push_back(box);
  }
  tree_ = BoxTree(boxes_, [&](std::int32_t triangle) {
    const auto t = static_cast<std::size_t>(triangle);
    return SlabFacet{{corner(t, 0), corner(t, 1), corner(t, 2)}, rises_[t]};
  });
}

Kind SmoothTriangleSurface::classify(std::size_t t, const CurvedTriangle& patch) {
  const Vec3& face = normals_.faces[t];
  bool flat = true, straight = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeCurve& side = curve(t, i);
    straight = straight && side.straight;
    flat = flat && normals_.corners[t][i] == face && normals_.is_tip[t][i] == 0;
    flat = flat && (side.straight || side.kind != EdgeKind::smooth);
  }
  if (flat) {
    ++smoothing_.flat;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 middle = 0.5 * (corner(t, i) + corner(t, (i + 1) % 3));
      if (!curve(t, i).straight)
        smoothing_.chord_error =
            std::max(smoothing_.chord_error, (curve(t, i).at(0.5).position - middle).norm());
    }
    return straight ? Kind::facet : Kind::flat;
  }
  const CurvedTriangle::Shape shape = patch.shape();
  if (!(shape.least_cosine > least_normal_cosine)) {
    ++smoothing_.kept;
    return Kind::unchanged;
  }
  ++smoothing_.curved;
  smoothing_.chord_error = std::max(smoothing_.chord_error, shape.departure);
  double turn2 = 0.0; // square of the largest angle between two normals along an edge
  for (const CurvedTriangle::Side& side : patch.sides())
    turn2 = std::max(turn2, (side.curve.normals[1] - side.curve.normals[0]).squaredNorm());
  smoothing_.remaining_error = std::max(smoothing_.remaining_error, shape.departure * turn2 / 16.0);
  return Kind::curved;
}

void SmoothTriangleSurface::do_project(std::span<const Vec3> points,
                                       double reach,
                                       std::span<Projection> out) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    out[i] = project_one(points[i], reach, out[i].patch);
}

// Smallest (distance, triangle number), as (G.12) has it. A patch costs thirty times what its facet
// does, so facets tell where to look first, and they and their quarters which patches are too far.
Projection
SmoothTriangleSurface::project_one(const Vec3& x, double reach, std::int32_t hint) const {
  if (hint < 0 || static_cast<std::size_t>(hint) >= patches_.size())
    hint = nearest_facet(x, reach);
  double limit2 = reach * reach;
  Place at_hint, best;
  if (hint >= 0) {
    at_hint = closest(hint, x, least_distance2(hint, x, rough_distance2(hint, x)));
    limit2 = std::min(limit2, at_hint.distance2);
  }
  std::int32_t nearest = -1;
  tree_.walk(x, limit2, [&](std::int32_t triangle) {
    Place place = at_hint;
    if (triangle != hint) {
      const double rough2 = rough_distance2(triangle, x);
      const double least2 = rough2 > limit2 ? rough2 : least_distance2(triangle, x, rough2);
      if (least2 > limit2)
        return limit2;
      place = closest(triangle, x, least2);
    }
    if (place.distance2 < limit2 ||
        (place.distance2 == limit2 && (nearest < 0 || triangle < nearest))) {
      best = place;
      nearest = triangle;
      limit2 = place.distance2;
    }
    return limit2;
  });
  if (nearest < 0)
    return {};
  Projection p = project(static_cast<std::size_t>(nearest), best, x);
  if (p.found())
    p.patch = nearest;
  return p;
}

std::int32_t SmoothTriangleSurface::nearest_facet(const Vec3& x, double reach) const {
  double limit2 = reach * reach;
  std::int32_t nearest = -1;
  tree_.walk(x, limit2, [&](std::int32_t triangle) {
    const double distance2 = features_.closest(triangle, x).distance2;
    if (distance2 < limit2) {
      nearest = triangle;
      limit2 = distance2;
    }
    return limit2;
  });
  return nearest;
}

// A bound of the square of the distance to a patch, by its box and its facet.
double SmoothTriangleSurface::rough_distance2(std::int32_t triangle, const Vec3& x) const {
  const auto t = static_cast<std::size_t>(triangle);
  const double to_facet = std::sqrt(features_.closest(triangle, x).distance2);
  const double beyond = std::max(0.0, to_facet - rises_[t]);
  return std::max(beyond * beyond, distance2(boxes_[t], x));
}

// A better one, by the facets of its quarters. (G.50)
double
SmoothTriangleSurface::least_distance2(std::int32_t triangle, const Vec3& x, double rough2) const {
  const auto t = static_cast<std::size_t>(triangle);
  return kinds_[t] == Kind::curved ? std::max(rough2, quarters_[t].least_distance2(x)) : rough2;
}

// Never less than that bound, whatever the rounding. (G.12)
Place SmoothTriangleSurface::closest(std::int32_t triangle, const Vec3& x, double least2) const {
  const auto t = static_cast<std::size_t>(triangle);
  Place place;
  if (kinds_[t] == Kind::facet || kinds_[t] == Kind::unchanged) {
    place.feature = features_.closest(triangle, x);
    place.distance2 = place.feature.distance2;
  } else if (kinds_[t] == Kind::flat && beneath(t, x)) {
    const double height = (x - corner(t, 0)).dot(normals_.faces[t]);
    place.feature = {height * height, Feature::face, triangle};
    place.distance2 = height * height;
  } else {
    const auto foot = kinds_[t] == Kind::curved ? patches_[t].foot(x, start(t, x)) : std::nullopt;
    if (foot) {
      place.on = Place::On::inside;
      place.at = *foot;
      place.distance2 = (patches_[t].at((*foot)[0], (*foot)[1]).position - x).squaredNorm();
    } else {
      place = closest_on_side(t, x);
    }
  }
  place.distance2 = std::max(place.distance2, least2);
  return place;
}

Place SmoothTriangleSurface::closest_on_side(std::size_t t, const Vec3& x) const {
  Place place;
  place.on = Place::On::side;
  for (std::size_t i = 0; i < 3; ++i) {
    const ClosestOnCurve found = closest_on(curve(t, i), x);
    if (found.distance2 < place.distance2) {
      place.distance2 = found.distance2;
      place.side = i;
      place.t = found.t;
    }
  }
  return place;
}

// Barycentric coordinates of the point of the facet below x, moved into the facet.
std::array<double, 2> SmoothTriangleSurface::start(std::size_t t, const Vec3& x) const {
  const Vec3 a = corner(t, 1) - corner(t, 0), b = corner(t, 2) - corner(t, 0);
  const Vec3 r = x - corner(t, 0), n = a.cross(b);
  const double area2 = n.squaredNorm();
  const double v = std::max(0.0, r.cross(b).dot(n) / area2);
  const double w = std::max(0.0, a.cross(r).dot(n) / area2);
  const double u = std::max(0.0, 1.0 - r.cross(b).dot(n) / area2 - a.cross(r).dot(n) / area2);
  const double sum = u + v + w;
  return {v / sum, w / sum};
}

// Whether the foot of x in the plane of a flat triangle lies within its curved sides: between a
// side and its curve, and in the triangle itself if the curve bulges outwards.
bool SmoothTriangleSurface::beneath(std::size_t t, const Vec3& x) const {
  bool in_triangle = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& a = corner(t, i);
    const Vec3 way = corner(t, (i + 1) % 3) - a, out = way.cross(normals_.faces[t]);
    const double height = (x - a).dot(out), along = (x - a).dot(way) / way.squaredNorm();
    in_triangle = in_triangle && height <= 0.0;
    const std::array<Vec3, 4>& c = patches_[t].sides()[i].curve.control;
    if (curve(t, i).straight || along <= 0.0 || along >= 1.0)
      continue;
    double s = along; // parameter of the curve above that point of the side: a monotone cubic
    for (int k = 0; k < 4; ++k) {
      const CurvePoint p = patches_[t].sides()[i].curve.at(s);
      s = std::clamp(s - ((p.position - a).dot(way) / way.squaredNorm() - along) *
                             way.squaredNorm() / p.d.dot(way),
                     0.0, 1.0);
    }
    const double bulge = (patches_[t].sides()[i].curve.at(s).position - a).dot(out);
    if (height > 0.0 && height <= bulge && (c[1] - a).dot(out) > 0.0)
      return true;
    in_triangle = in_triangle && height <= std::min(0.0, bulge);
  }
  return in_triangle;
}

Projection SmoothTriangleSurface::project(std::size_t t, const Place& place, const Vec3& x) const {
  if (place.on == Place::On::facet)
    return on_facet(t, place, x);
  if (place.on == Place::On::side)
    return on_side(t, place, x);
  const SurfacePoint s = patches_[t].at(place.at[0], place.at[1]);
  Projection p;
  p.normal = s.normal();
  p.gap = (x - s.position).dot(p.normal);
  p.foot = x - p.gap * p.normal;
  p.dnormal_dx = normal_slope(s, p.gap).value_or(Mat3::Zero());
  return p;
}

Projection SmoothTriangleSurface::on_face(std::size_t t, const Vec3& x) const {
  const auto triangle = static_cast<std::int32_t>(t);
  return features_.project({0.0, Feature::face, triangle}, x);
}

// A flat triangle goes over into its neighbours across smooth edges: no edge, no vertex there.
Projection SmoothTriangleSurface::on_facet(std::size_t t, const Place& place, const Vec3& x) const {
  const auto number = static_cast<std::size_t>(place.feature.number);
  if (kinds_[t] == Kind::facet) {
    if (place.feature.feature == Feature::edge && edges_.curves[number].kind == EdgeKind::smooth)
      return on_face(t, x);
    if (place.feature.feature == Feature::vertex && normals_.one_fan[number] != 0)
      return on_face(t, x);
  }
  return features_.project(place.feature, x);
}

Projection SmoothTriangleSurface::on_side(std::size_t t, const Place& place, const Vec3& x) const {
  const std::array<std::int32_t, 3>& corners = features_.mesh().triangles[t];
  const EdgeCurve& edge = curve(t, place.side);
  const std::size_t next = (place.side + 1) % 3;
  const bool at_vertex = place.t == 0.0 || place.t == 1.0;
  const std::int32_t low = std::min(corners[place.side], corners[next]);
  const std::int32_t high = std::max(corners[place.side], corners[next]);
  const std::int32_t vertex = place.t == 0.0 ? low : high;
  if (at_vertex && normals_.one_fan[static_cast<std::size_t>(vertex)] == 0)
    return features_.project({place.distance2, Feature::vertex, vertex}, x);
  if (!at_vertex && edge.kind != EdgeKind::smooth)
    return on_sharp_side(t, place, x);
  const std::array<double, 2> at = patches_[t].on_side(place.side, place.t);
  const SurfacePoint s = patches_[t].at(at[0], at[1]);
  const Vec3 v = x - s.position, n = s.normal();
  Projection p;
  p.normal = n;
  p.gap = v.dot(n);
  p.foot = x - p.gap * n;
  p.dnormal_dx = normal_slope(s, p.gap).value_or(Mat3::Zero());
  if ((v - p.gap * n).norm() <= aligned * v.norm() + rounding * bounds_.size())
    return p;
  if (at_vertex)
    return features_.around(x, v, n, Mat3::Identity(), inside_surface);
  return on_sharp_side(t, place, x);
}

Vec3 SmoothTriangleSurface::side_normal(std::int32_t triangle, std::int32_t edge, double t) const {
  const auto number = static_cast<std::size_t>(triangle);
  if (kinds_[number] != Kind::curved)
    return normals_.faces[number];
  const auto& of = edges_.of_triangle[number];
  const auto side = static_cast<std::size_t>(std::find(of.begin(), of.end(), edge) - of.begin());
  const std::array<double, 2> at = patches_[number].on_side(side, t);
  return patches_[number].at(at[0], at[1]).normal();
}

// The line to a curve turns as the point moves along it, the slower the more it bends. (G.22)
Projection
SmoothTriangleSurface::on_sharp_side(std::size_t t, const Place& place, const Vec3& x) const {
  const std::int32_t number = edges_.of_triangle[t][place.side];
  const EdgeCurve& edge = curve(t, place.side);
  const CurvePoint c = edge.at(place.t);
  const Vec3 v = x - c.position;
  Vec3 normal = side_normal(edge.triangles[0], number, place.t);
  double overshoot = inside_surface;
  if (edge.kind == EdgeKind::border) {
    const double way = patches_[t].sides()[place.side].forward ? 1.0 : -1.0;
    overshoot = v.dot(Vec3(way * c.d.cross(normal)).stableNormalized());
  } else {
    normal = (normal + side_normal(edge.triangles[1], number, place.t)).stableNormalized();
  }
  const double square = c.d.squaredNorm(), bend = square - v.dot(c.dd);
  const Mat3 free = Mat3::Identity() - c.d * c.d.transpose() / (bend > 0.0 ? bend : square);
  return features_.around(x, v, normal, free, overshoot);
}

} // namespace

SmoothSurface make_smooth_triangle_surface(const TriangleMesh& mesh, double feature_angle) {
  std::vector<Complaint> found = complaints(health(mesh), "");
  if (!found.empty())
    throw Error(Fault::geometry, std::move(found));
  auto surface = std::make_unique<const SmoothTriangleSurface>(mesh, feature_angle);
  const Smoothing smoothing = surface->smoothing();
  return {std::move(surface), smoothing};
}

double chord_error(const TriangleMesh& mesh, double feature_angle) {
  const CornerNormals normals = corner_normals(mesh, feature_angle);
  double largest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const Vec3 side = mesh.points[static_cast<std::size_t>(mesh.triangles[t][j])] -
                        mesh.points[static_cast<std::size_t>(mesh.triangles[t][i])];
      const double sagitta = side.dot(normals.corners[t][j] - normals.corners[t][i]) / 8.0;
      largest = std::max(largest, std::abs(sagitta));
      sum += sagitta;
    }
    largest = std::max(largest, std::abs(4.0 / 9.0 * sum)); // in the middle
  }
  return largest;
}

} // namespace billet::geometry
