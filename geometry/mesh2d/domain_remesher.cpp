#include "geometry/mesh2d/domain_remesher.h"

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/base/index.h"
#include "geometry/mesh2d/boundary_curve.h"
#include "geometry/mesh2d/boundary_measure.h"
#include "geometry/mesh2d/boundary_sides.h"
#include "geometry/mesh2d/domain_refinement.h"
#include "geometry/mesh2d/long_sides.h"
#include "geometry/mesh2d/plane_smoother.h"
#include "geometry/mesh2d/polygon_widths.h"
#include "geometry/mesh2d/snapped_loops.h"
#include "geometry/size_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace billet::geometry {

namespace {

constexpr double most_triangles = 1e7;

/// A boundary that turns by more at a node may have a corner there, 30 degrees.
constexpr double corner_turn = std::numbers::pi / 6.0;

/// The same where the boundary would touch itself otherwise, 10 degrees.
constexpr double fold_turn = std::numbers::pi / 18.0;

/// Poor angles are improved by boundary edges down to this fraction of the smallest size.
constexpr double least_fraction = 1.0 / 16.0;

/// Chords that stand for the old boundary turn by no more than this [rad].
constexpr double chord_turn = std::numbers::pi / 36.0;

/// Rounds of splitting sides whose triangles turn inside out.
constexpr int most_rounds = 6;

[[noreturn]] void refuse(const std::string& what, const Vec2& x) {
  throw Error(Fault::geometry, "", fmt::format("{} near ({:.6g}, {:.6g})", what, x.x(), x.y()));
}

void require_sound(const SideLoop& loop) {
  const std::size_t n = loop.corners.size();
  if (n < 2 || loop.middles.size() != n || loop.part.size() != n || loop.keep.size() != n ||
      loop.hold.size() != n)
    throw Error(Fault::geometry, "", "a loop of the boundary lacks sides or their data");
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = loop.corners[i], &m = loop.middles[i], &b = loop.corners[(i + 1) % n];
    if (!a.allFinite() || !m.allFinite())
      throw Error(Fault::geometry, "", fmt::format("node {} of the boundary is not finite", i));
    if (a == m || m == b || a == b)
      refuse("a side of the boundary has no length", a);
  }
}

void require_sound(const RemeshSizes& sizes) {
  const bool sound = sizes.min > 0.0 && sizes.max >= sizes.min && std::isfinite(sizes.max) &&
                     sizes.turn > 0.0 && sizes.growth > 0.0 && sizes.across >= 1;
  if (!sound)
    throw Error(Fault::geometry, "",
                fmt::format("sizes of a mesh from {} to {}, turn {}, growth {}, {} across",
                            sizes.min, sizes.max, sizes.turn, sizes.growth, sizes.across),
                "give 0 < min <= max and positive values");
}

/// Whether a quadratic triangle turns left at its corners and middles.
bool is_valid(const std::array<Vec2, 3>& x, const std::array<Vec2, 3>& m) {
  for (const auto& [l0, l1] : std::array<std::array<double, 2>, 6>{
           {{1, 0}, {0, 1}, {0, 0}, {0.5, 0.5}, {0, 0.5}, {0.5, 0}}}) {
    const double l2 = 1.0 - l0 - l1;
    const Vec2 d0 = (4.0 * l0 - 1.0) * x[0] - (4.0 * l2 - 1.0) * x[2] + 4.0 * l1 * m[0] -
                    4.0 * l1 * m[1] + 4.0 * (l2 - l0) * m[2];
    const Vec2 d1 = (4.0 * l1 - 1.0) * x[1] - (4.0 * l2 - 1.0) * x[2] + 4.0 * l0 * m[0] +
                    4.0 * (l2 - l1) * m[1] - 4.0 * l0 * m[2];
    if (!(cross(d0, d1) > 0.0))
      return false;
  }
  return true;
}

/// Flags of the boundary sides of triangles that turn inside out, or of sides that start at one.
std::vector<char> inverted_sides(const PlaneMesh& mesh) {
  std::vector<std::int32_t> next(mesh.points.size(), -1); // side that starts at a corner
  for (std::size_t i = 0; i < mesh.boundary.size(); ++i)
    next[idx(mesh.boundary[i].corners[0])] = static_cast<std::int32_t>(i);
  std::vector<char> flags(mesh.boundary.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec2, 3> x, m;
    std::array<std::int32_t, 3> sides{-1, -1, -1};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangle[k], b = triangle[(k + 1) % 3];
      x[k] = mesh.points[idx(a)];
      m[k] = 0.5 * (mesh.points[idx(a)] + mesh.points[idx(b)]);
      const std::int32_t side = next[idx(a)];
      if (side >= 0 && mesh.boundary[idx(side)].corners[1] == b) {
        sides[k] = side;
        m[k] = mesh.boundary[idx(side)].middle;
      }
    }
    if (is_valid(x, m))
      continue;
    if (std::all_of(sides.begin(), sides.end(), [](std::int32_t side) { return side < 0; }))
      for (std::size_t k = 0; k < 3; ++k)
        sides[k] = next[idx(triangle[k])];
    for (const std::int32_t side : sides)
      if (side >= 0)
        flags[idx(side)] = 1;
  }
  return flags;
}

double longest_over_ripples(const RemeshSizes& sizes, const Vec2& x) {
  const double most = sizes.over_ripples ? std::min(sizes.max, sizes.over_ripples(x)) : sizes.max;
  return sizes.wanted ? std::min(most, std::max(sizes.min, sizes.wanted(x))) : most;
}

/// One remeshing: what its steps share.
class Remesher {
public:
  Remesher(std::span<const SideLoop> loops,
           const RemeshSizes& sizes,
           Measure measure,
           const Snap& snap,
           const CornerRule& rule)
      : sizes_(sizes), rule_(rule), measure_(measure), snap_(snap),
        snapped_(loops, snap, sizes.min) {
    for (std::size_t i = 0; i < loops.size(); ++i) {
      require_sound(snapped_.loops()[i]);
      curves_.emplace_back(snapped_.loops()[i], static_cast<std::int32_t>(i), rule);
    }
    if (measure == Measure::area) // near the domain, for the sake of rounding
      origin_ = loops.front().corners.front();
    else
      origin_ = {0.0, loops.front().corners.front().y()};
    for (const SideLoop& loop : loops) {
      old_measure_ += enclosed(loop, {measure, origin_});
      area_ += enclosed(loop, {Measure::area, origin_});
    }
  }

  [[nodiscard]] RemeshedDomain run() {
    require_within_limit();
    const std::vector<SizeSample> samples = boundary_samples();
    const SizeField field(samples, sizes_.max, sizes_.growth);
    if (!sizes_.wanted)
      return mesh_by(field);
    // What is asked for inside is sampled by a first mesh.
    const auto wanted = [&](const Vec2& x) {
      return std::min(field(x), std::max(sizes_.min, sizes_.wanted(x)));
    };
    require_within_limit(refined(field).mesh, wanted);
    const RefinedDomain first = refined(wanted);
    std::vector<SizeSample> all = samples;
    for (const Vec2& x : first.mesh.points)
      all.push_back({x, wanted(x)});
    return mesh_by(SizeField(std::move(all), sizes_.max, sizes_.growth));
  }

private:
  /// Sizes asked for by the curvature of the boundary and by thin places; checks the boundary.
  [[nodiscard]] std::vector<SizeSample> boundary_samples() const {
    std::vector<SizeSample> samples;
    for (const SizeAt& asked : sizes_.at)
      samples.push_back({asked.at, asked.size});
    std::vector<Polygon> polygons;
    for (const BoundaryCurve& curve : curves_) {
      polygons.emplace_back();
      const std::vector<double> stations = curve.stations(chord_turn, sizes_.max);
      for (const double s : stations)
        polygons.back().push_back(curve.point(s));
      add_bends(curve, {polygons.back(), stations, curve.length()}, samples);
    }
    const double across = sizes_.across;
    for (const Width& width : widths(polygons, across * sizes_.max)) {
      const double size = std::max(sizes_.min, width.width / across);
      samples.push_back({width.from, size});
      samples.push_back({width.to, size});
    }
    return samples;
  }

  /// Sizes asked for by the curvature of a boundary, but for ripples of free sides that longer
  /// ones pass over.
  void
  add_bends(const BoundaryCurve& curve, ClosedWay way, std::vector<SizeSample>& samples) const {
    const LongSides long_sides(way, curve.kept(), sizes_.turn);
    for (std::size_t k = 0; k < way.points.size(); ++k) {
      const double curvature = curve.curvature(way.places[k]);
      if (!(curvature * sizes_.max > sizes_.turn))
        continue;
      const double size = std::max(sizes_.min, sizes_.turn / curvature);
      const bool follow = !rule_.longest_side || curve.is_held(way.places[k]);
      const double longer =
          follow ? 0.0 : long_sides.longest(way.places[k], size, rule_.longest_side(way.points[k]));
      samples.push_back({way.points[k], std::max(size, longer)});
    }
  }

  /// The same for a size that varies, by a mesh that does not follow it yet.
  template <class Field> void require_within_limit(const PlaneMesh& mesh, const Field& size) const {
    double expected = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec2 &x = mesh.points[idx(a)], &y = mesh.points[idx(b)], &z = mesh.points[idx(c)];
      const double h = size((x + y + z) / 3.0);
      expected += cross(y - x, z - x) / (h * h); // twice the area: as below
    }
    require_within_limit(expected);
  }

  void require_within_limit() const {
    // Equilateral ones would be 2.3 for a square of the size.
    require_within_limit(2.0 * area_ / (sizes_.max * sizes_.max));
  }

  static void require_within_limit(double expected) {
    if (!(expected < most_triangles))
      throw Error(Fault::limit, "",
                  fmt::format("triangles would be about {:.3g}; at most {:.0e} are made", expected,
                              most_triangles),
                  "give larger sizes");
  }

  [[nodiscard]] double shortest() const { return least_fraction * sizes_.min; }

  template <class Field> [[nodiscard]] RefinedDomain refined(const Field& field) const {
    const std::function<double(const Vec2&)> size = std::cref(field);
    std::vector<CurveSide> sides = spread_sides(curves_, size, sizes_.min);
    separate(curves_, sides, shortest());
    return refine(curves_, sides, {size, shortest()});
  }

  [[nodiscard]] RemeshedDomain mesh_by(const SizeField& field) const {
    RefinedDomain domain = refined(field);
    for (int round = 0;; ++round) {
      if (snap_)
        snap(domain);
      restore_measure(domain, curves_, {measure_, origin_}, old_measure_);
      smooth(domain.mesh);
      const std::vector<char> flags = inverted_sides(domain.mesh);
      const auto bad = std::find(flags.begin(), flags.end(), 1);
      if (bad == flags.end())
        return finished(std::move(domain));
      if (round == most_rounds)
        refuse("no sound triangles are found",
               domain.mesh.boundary[static_cast<std::size_t>(bad - flags.begin())].middle);
      domain = refine(curves_, halved(domain.sides, flags), {std::cref(field), shortest()});
    }
  }

  void snap(RefinedDomain& domain) const {
    for (std::size_t i = 0; i < domain.sides.size(); ++i) {
      BoundarySide& side = domain.mesh.boundary[i];
      const BoundaryCurve& curve = curves_[idx(domain.sides[i].loop)];
      const auto move = [&](Vec2& x, double s) {
        x = snap_(side.segment, snapped_.original(curve.place(s)), x);
      };
      move(domain.mesh.points[idx(side.corners[0])], domain.sides[i].from);
      move(domain.mesh.points[idx(side.corners[1])], domain.sides[i].to);
      move(side.middle, domain.sides[i].middle());
    }
  }

  [[nodiscard]] RemeshedDomain finished(RefinedDomain domain) const {
    RemeshedDomain result;
    for (const CurveSide& side : domain.sides) {
      const auto place = [&](double s) {
        return snapped_.original(curves_[idx(side.loop)].place(s));
      };
      result.corner_places.push_back(place(side.from));
      result.middle_places.push_back(place(side.middle()));
    }
    result.mesh = std::move(domain.mesh);
    result.old_measure = old_measure_;
    result.measure = enclosed(result.mesh, {measure_, origin_});
    return result;
  }

  const RemeshSizes& sizes_;
  CornerRule rule_;
  Measure measure_;
  const Snap& snap_;
  SnappedLoops snapped_;
  std::vector<BoundaryCurve> curves_;
  Vec2 origin_ = Vec2::Zero();
  double old_measure_ = 0.0;
  double area_ = 0.0;
};

} // namespace

RemeshedDomain remesh_domain(std::span<const SideLoop> loops,
                             const RemeshSizes& sizes,
                             Measure measure,
                             const Snap& snap) {
  if (loops.empty())
    throw Error(Fault::geometry, "", "a domain without a boundary");
  require_sound(sizes);
  for (const SideLoop& loop : loops)
    require_sound(loop);
  // A smooth curve may cut its own corners: at the mouth of a fold that closes, the other lip. Arcs
  // of sides that bulge like half a circle leave their corner backwards, parabolas do not.
  std::vector<CornerRule> rules{
      {corner_turn, sizes.turn, [&sizes](const Vec2& x) { return longest_over_ripples(sizes, x); }},
      {.turn = fold_turn}};
  if (sizes.or_parabolas)
    rules.push_back({.turn = fold_turn, .parabolas = true});
  for (std::size_t i = 0; i + 1 < rules.size(); ++i)
    try {
      return Remesher(loops, sizes, measure, snap, rules[i]).run();
    } catch (const Error& error) {
      if (error.fault() != Fault::geometry)
        throw;
    }
  return Remesher(loops, sizes, measure, snap, rules.back()).run();
}

} // namespace billet::geometry
