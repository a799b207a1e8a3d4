// Domains meshed anew: what is kept of the boundary, what it encloses, how good the triangles are,
// and what is refused.

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/mesh2d/boundary_curve.h"
#include "geometry/mesh2d/domain_remesher.h"
#include "tests/support/sound_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace billet::geometry::domain_remesher_test {
namespace {

constexpr double pi = std::numbers::pi;

using Way = std::function<Vec2(double)>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Adds `sides` free sides along the way from 0 to 1, without its end.
void add(SideLoop& loop, const Way& way, int sides, std::int32_t part) {
  for (int i = 0; i < sides; ++i) {
    loop.corners.push_back(way(static_cast<double>(i) / sides));
    loop.middles.push_back(way((i + 0.5) / sides));
    loop.part.push_back(part);
    loop.keep.push_back(0);
    loop.hold.push_back(0);
  }
}

Way line(const Vec2& a, const Vec2& b) {
  return [=](double t) { return Vec2(a + t * (b - a)); };
}

Way arc(const Vec2& centre, double radius, double from, double to) {
  return [=](double t) {
    const double angle = from + t * (to - from);
    return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  };
}

SideLoop circle(double radius, int sides, const Vec2& centre = Vec2::Zero()) {
  SideLoop loop;
  add(loop, arc(centre, radius, 0.0, 2.0 * pi), sides, 0);
  return loop;
}

SideLoop reversed(const SideLoop& loop) {
  SideLoop result = loop;
  std::reverse(result.corners.begin(), result.corners.end());
  std::reverse(result.middles.begin(), result.middles.end());
  std::rotate(result.middles.begin(), result.middles.begin() + 1, result.middles.end());
  return result;
}

struct Corner {
  Vec2 x;
  double radius; ///< of its fillet; 0: sharp
};

/// Lines between corners with fillets, in sides of about `size`; each corner and the line after it
/// is a part if `parts`.
SideLoop outline(const std::vector<Corner>& corners, double size, bool parts = false) {
  SideLoop loop;
  const std::size_t n = corners.size();
  const auto x = [&](std::size_t i) -> const Vec2& { return corners[i % n].x; };
  const auto cut = [&](std::size_t i) {
    const Vec2 u = (x(i + n - 1) - x(i)).normalized(), v = (x(i + 1) - x(i)).normalized();
    return corners[i % n].radius * std::sqrt((1.0 + u.dot(v)) / (1.0 - u.dot(v)));
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t part = parts ? static_cast<std::int32_t>(i) : 0;
    const Vec2 u = (x(i + n - 1) - x(i)).normalized(), v = (x(i + 1) - x(i)).normalized();
    const double radius = corners[i].radius, t = radius > 0.0 ? cut(i) : 0.0;
    if (radius > 0.0) {
      const Vec2 c = x(i) + (u + v).normalized() * std::hypot(t, radius);
      const Vec2 a = x(i) + t * u - c, b = x(i) + t * v - c;
      const double from = std::atan2(a.y(), a.x());
      const double sweep = std::atan2(cross(a, b), a.dot(b));
      const double sides = std::max(std::abs(sweep) * radius / size, std::abs(sweep) / 0.4);
      add(loop, arc(c, radius, from, from + sweep), static_cast<int>(std::ceil(sides)), part);
    }
    const Vec2 a = x(i) + t * v;
    const Vec2 b = x(i + 1) - (corners[(i + 1) % n].radius > 0.0 ? cut(i + 1) : 0.0) * v;
    add(loop, line(a, b), static_cast<int>(std::ceil((b - a).norm() / size)), part);
  }
  return loop;
}

SideLoop rectangle(double width, double height, double size) {
  return outline({{{0, 0}, 0}, {{width, 0}, 0}, {{width, height}, 0}, {{0, height}, 0}}, size,
                 true);
}

/// Half section of a forging with a hub 20 mm high, a web, a rim and a flash of 1 mm.
SideLoop forging() {
  return outline({{{0, 0}, 0},
                  {{8, 0}, 2},
                  {{12, 8}, 3},
                  {{22, 8}, 3},
                  {{24, 2}, 2},
                  {{32, 2}, 2},
                  {{33, 6}, 1},
                  {{42, 6}, 0},
                  {{42, 7}, 0},
                  {{33, 7}, 1},
                  {{32, 14}, 2},
                  {{25, 14}, 2},
                  {{22, 11.5}, 3},
                  {{12, 11.5}, 3},
                  {{9, 22}, 2},
                  {{0, 22}, 0}},
                 1.5);
}

/// The boundary of a new mesh as the old one of the next; what was kept by flag stays so.
SideLoop boundary_of(const RemeshedDomain& domain, const SideLoop& old) {
  SideLoop loop;
  for (std::size_t i = 0; i < domain.mesh.boundary.size(); ++i) {
    const BoundarySide& side = domain.mesh.boundary[i];
    const BoundaryPlace& place = domain.corner_places[i];
    loop.corners.push_back(domain.mesh.points[at(side.corners[0])]);
    loop.middles.push_back(side.middle);
    loop.part.push_back(side.segment);
    loop.keep.push_back(place.xi == 0.0 ? old.keep[at(place.side)] : char{0});
    loop.hold.push_back(old.hold[at(domain.middle_places[i].side)]);
  }
  return loop;
}

Vec2 on_parabola(const SideLoop& loop, const BoundaryPlace& place) {
  const Vec2 &a = loop.corners[at(place.side)], &m = loop.middles[at(place.side)];
  const Vec2& b = loop.corners[(at(place.side) + 1) % loop.corners.size()];
  const double t = place.xi;
  return (1.0 - t) * (1.0 - 2.0 * t) * a + 4.0 * t * (1.0 - t) * m + t * (2.0 * t - 1.0) * b;
}

RemeshedDomain remeshed(const SideLoop& loop, const RemeshSizes& sizes, Measure m = Measure::area) {
  return remesh_domain(std::vector<SideLoop>{loop}, sizes, m);
}

/// The complaint, or what else happened.
std::string refusal(const std::vector<SideLoop>& loops, Fault fault, RemeshSizes sizes) {
  try {
    (void)remesh_domain(loops, sizes, Measure::area);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    return error.what();
  }
  return "meshed";
}

TEST(DomainRemesher, KeepsCornersAndNothingElse) {
  SideLoop square = outline({{{0, 0}, 0}, {{4, 0}, 0}, {{4, 4}, 0}, {{0, 4}, 1}}, 1.0);
  std::vector<char> kept = kept_corners(square, {.turn = pi / 6.0});
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 3); // the fourth is round
  square.keep[1] = 1;
  square.part[2] = 7;
  kept = kept_corners(square, {.turn = pi / 6.0});
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 6);
  const RemeshedDomain domain = remeshed(square, {0.2, 1.7});
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto same = std::find_if(
        domain.corner_places.begin(), domain.corner_places.end(),
        [&](const BoundaryPlace& place) { return at(place.side) == i && place.xi == 0.0; });
    ASSERT_EQ(kept[i] != 0, same != domain.corner_places.end()) << i;
    if (kept[i] != 0) {
      const BoundarySide& side =
          domain.mesh.boundary[static_cast<std::size_t>(same - domain.corner_places.begin())];
      EXPECT_EQ(domain.mesh.points[at(side.corners[0])], square.corners[i]);
      EXPECT_EQ(side.segment, square.part[i]);
    }
  }
  for (const int sides : {3, 4, 6, 20}) { // smooth however coarse
    kept = kept_corners(circle(1.0, sides), {.turn = pi / 6.0});
    EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 0) << sides;
  }
}

TEST(DomainRemesher, AFlattenedCornerIsNoneAnyMore) {
  for (const double foot : {4.0, 6.0, 44.0}) { // the free side folds until it is flush with the top
    const SideLoop loop = outline({{{0, 0}, 0}, {{foot, 0}, 0}, {{4, 2}, 0}, {{0, 2}, 0}}, 1.0);
    const std::vector<char> kept = kept_corners(loop, {.turn = pi / 6.0});
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Vec2& x = loop.corners[i];
      const bool end = (x.x() == 0.0 || x.x() == foot) && (x.y() == 0.0 || x.y() == 2.0);
      const bool folding = foot < 44.0 && x == Vec2(4, 2);
      EXPECT_EQ(kept[i] != 0, end || folding) << foot << " " << i;
    }
  }
}

TEST(DomainRemesher, StraightLinesStayWhereTheyAreToTheBit) {
  SideLoop loop =
      outline({{{0.1, 0.3}, 0}, {{3.3, 0.3}, 0}, {{3.3, 2.7}, 0.6}, {{0.1, 2.7}, 0}}, 0.7);
  for (char& hold : loop.hold)
    hold = 1;
  const RemeshedDomain domain = remeshed(loop, {0.05, 0.41});
  int left = 0, bottom = 0;
  for (const BoundarySide& side : domain.mesh.boundary)
    for (const Vec2& x : {domain.mesh.points[at(side.corners[0])], side.middle}) {
      left += x.x() == 0.1 ? 1 : 0;
      bottom += x.y() == 0.3 ? 1 : 0;
      EXPECT_TRUE(x.x() == 0.1 || x.x() > 0.101);
      EXPECT_TRUE(x.y() == 0.3 || x.y() > 0.301);
    }
  EXPECT_EQ(left, 13);   // 2.4 in sides of 0.41
  EXPECT_EQ(bottom, 17); // 3.2
}

TEST(DomainRemesher, NewNodesLieOnTheOldCurveAtTheirPlaces) {
  SideLoop loop = circle(1.0, 24);
  std::fill(loop.hold.begin(), loop.hold.end(), 1);
  const RemeshedDomain domain = remeshed(loop, {0.02, 0.11});
  for (std::size_t i = 0; i < domain.mesh.boundary.size(); ++i) {
    const BoundarySide& side = domain.mesh.boundary[i];
    const Vec2& x = domain.mesh.points[at(side.corners[0])];
    // A cubic over 7.5 degrees is that close to the arc, (G.41).
    EXPECT_NEAR(x.norm(), 1.0, 1e-9);
    EXPECT_NEAR(side.middle.norm(), 1.0, 1e-9);
    // The parabola over an arc of 15 degrees runs ahead of it by up to the cube of that times
    // 1 / (72 sqrt 3).
    const double ahead = 1.01 * std::pow(pi / 12.0, 3) / (72.0 * std::sqrt(3.0));
    EXPECT_LT((on_parabola(loop, domain.corner_places[i]) - x).norm(), ahead);
    EXPECT_LT((on_parabola(loop, domain.middle_places[i]) - side.middle).norm(), ahead);
  }
  EXPECT_NE(domain.measure, domain.old_measure); // nothing may be moved
  EXPECT_NEAR(domain.measure, domain.old_measure, 1e-4 * domain.old_measure);
}

TEST(DomainRemesher, TheMeasureIsRestored) {
  SideLoop ball; // half a disc of radius 2 and the axis
  add(ball, arc({0, 0}, 2.0, -0.5 * pi, 0.5 * pi), 30, 0);
  add(ball, line({0, 2}, {0, -2}), 9, 1);
  for (std::size_t i = 30; i < 39; ++i) {
    ball.hold[i] = 1;
    ball.corners[i].x() = ball.middles[i].x() = 0.0;
  }
  ball.corners[0].x() = 0.0;
  const RemeshedDomain volume = remeshed(ball, {0.05, 0.37}, Measure::revolved);
  EXPECT_NEAR(volume.old_measure, 8.0 * 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(volume.measure, volume.old_measure, 1e-10 * volume.old_measure);
  for (const BoundarySide& side : volume.mesh.boundary) {
    if (side.segment == 1) {
      EXPECT_EQ(volume.mesh.points[at(side.corners[0])].x(), 0.0);
      EXPECT_EQ(side.middle.x(), 0.0);
    }
  }
  const RemeshedDomain area = remeshed(ball, {0.05, 0.37});
  EXPECT_NEAR(area.old_measure, 2.0 * pi, 1e-4);
  EXPECT_NEAR(area.measure, area.old_measure, 1e-10 * area.old_measure);
  expect_sound(volume, "volume");
}

/// RM-01: 40 sides, ten remeshings with sides that do not match.
TEST(DomainRemesher, TenRemeshingsNeitherShrinkNorRoughen) {
  struct Shape {
    std::string name;
    double a, b;
    double most_off; ///< from the ellipse, of a
  };
  // Measured: 1.5e-7 and 5e-5; parabolas instead of the smooth curve: 6e-6 and 5e-5, and 15 degrees
  // of kink where nodes are spaced unevenly.
  for (const Shape& shape : {Shape{"circle", 1.0, 1.0, 1e-6}, Shape{"ellipse", 2.0, 1.0, 1e-4}}) {
    SideLoop loop;
    add(
        loop,
        [&](double t) {
          return Vec2(shape.a * std::cos(2 * pi * t), shape.b * std::sin(2 * pi * t));
        },
        40, 0);
    const double size = shape.a * 2.0 * pi / 40.0;
    double first = 0.0, most = 0.0;
    for (int i = 0; i < 10; ++i) {
      const RemeshedDomain domain = remeshed(loop, {0.1 * size, i % 2 == 0 ? size : 1.07 * size});
      first = i == 0 ? domain.old_measure : first;
      EXPECT_NEAR(domain.measure, domain.old_measure, 1e-10 * first);
      loop = boundary_of(domain, loop);
      most = std::abs(domain.measure / first - 1.0);
    }
    double off = 0.0;
    for (const auto& nodes : {loop.corners, loop.middles})
      for (const Vec2& x : nodes) {
        const Vec2 scaled(x.x() / shape.a, x.y() / shape.b);
        const Vec2 gradient(scaled.x() / shape.a, scaled.y() / shape.b);
        off = std::max(off, 0.5 * std::abs(scaled.squaredNorm() - 1.0) / gradient.norm());
      }
    std::printf("%-8s after ten remeshings: %zu sides, area %+.1e, off by %.1e of a\n",
                shape.name.c_str(), loop.corners.size(), most, off / shape.a);
    EXPECT_LT(most, 1e-10) << shape.name;
    EXPECT_LT(off, shape.most_off * shape.a) << shape.name;
  }
}

TEST(DomainRemesher, SizesFollowFlashAndFillets) {
  const SideLoop loop = forging();
  RemeshSizes sizes{0.1, 2.0};
  sizes.turn = std::numbers::pi / 9.0; // old sides turn by 23 degrees: at ends of fillets their
                                       // curve is up to a quarter steeper than these
  const RemeshedDomain domain = remeshed(loop, sizes, Measure::revolved);
  expect_sound(domain, "forging");
  EXPECT_GE(smallest_angle(domain.mesh), 20.0);
  double flash = 0.0, hub = 0.0, steepest = 0.0;
  for (const auto& triangle : domain.mesh.triangles) {
    double longest = 0.0;
    Vec2 centre = Vec2::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      centre += domain.mesh.points[at(triangle[i])] / 3.0;
      longest = std::max(longest, (domain.mesh.points[at(triangle[i])] -
                                   domain.mesh.points[at(triangle[(i + 1) % 3])])
                                      .norm());
    }
    flash = std::max(flash, centre.x() > 34.0 ? longest : 0.0);
    hub = std::max(hub, centre.x() < 6.0 ? longest : 0.0);
  }
  EXPECT_LT(flash, 1.5 / 3.0); // three across 1 mm
  EXPECT_GT(hub, 1.5);
  EXPECT_LT(hub, 1.5 * 2.0);
  for (const BoundarySide& side : domain.mesh.boundary) {
    const Vec2& a = domain.mesh.points[at(side.corners[0])];
    const Vec2& b = domain.mesh.points[at(side.corners[1])];
    const Vec2 in = 4.0 * side.middle - 3.0 * a - b, out = a + 3.0 * b - 4.0 * side.middle;
    steepest = std::max(steepest, std::abs(std::atan2(cross(in, out), in.dot(out))));
  }
  // A side that is on its way from line to fillet sees the mean of both.
  EXPECT_LT(steepest, 1.1 * sizes.turn);
}

TEST(DomainRemesher, SizesAskedForInsideSpreadGradually) {
  RemeshSizes sizes{0.1, 2.0};
  const Vec2 spot(3.0, 6.0);
  sizes.wanted = [&](const Vec2& x) { return (x - spot).norm() < 1.0 ? 0.15 : 5.0; };
  const RemeshedDomain domain = remeshed(rectangle(10, 10, 1.3), sizes);
  expect_sound(domain, "spot");
  EXPECT_GE(smallest_angle(domain.mesh), 20.0);
  for (const auto& triangle : domain.mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2& a = domain.mesh.points[at(triangle[i])];
      const Vec2& b = domain.mesh.points[at(triangle[(i + 1) % 3])];
      const double way = std::max(0.0, (0.5 * (a + b) - spot).norm() - 1.0);
      // Smoothing may stretch sides beyond the 1.3 of refinement.
      EXPECT_LT((b - a).norm(), 1.6 * std::min(2.0, 0.15 + 0.3 * (way + 0.15)));
      if (way > 6.0) {
        EXPECT_GT((b - a).norm(), 0.5);
      }
    }
}

TEST(DomainRemesher, HolesAndTheirBoundariesStay) {
  const std::vector<SideLoop> loops{circle(5.0, 40), reversed(circle(1.0, 12, {1.5, 0.0})),
                                    reversed(circle(0.5, 12, {-2.0, 1.0}))};
  const RemeshedDomain domain = remesh_domain(loops, {0.05, 0.8}, Measure::area);
  expect_sound(domain, "holes");
  EXPECT_GE(smallest_angle(domain.mesh), 20.0);
  EXPECT_NEAR(domain.measure, pi * (25.0 - 1.0 - 0.25), 1e-3);
  EXPECT_NEAR(domain.measure, domain.old_measure, 1e-10 * domain.old_measure);
  std::array<int, 3> sides{0, 0, 0};
  for (const BoundaryPlace& place : domain.corner_places)
    ++sides[at(place.loop)];
  for (const int count : sides)
    EXPECT_GE(count, 18); // turn by 20 degrees
}

TEST(DomainRemesher, RefusesWhatIsNoDomainAndNamesThePlace) {
  const RemeshSizes sizes{0.1, 1.0};
  const auto crossing = outline({{{0, 0}, 0}, {{4, 4}, 0}, {{4, 0}, 0}, {{0, 3}, 0}}, 10.0);
  EXPECT_NE(refusal({crossing}, Fault::geometry, sizes).find("near ("), std::string::npos);
  EXPECT_NE(refusal({reversed(circle(5, 20))}, Fault::geometry, sizes)
                .find("left of its boundary near ("),
            std::string::npos);
  EXPECT_NE(refusal({circle(5, 20), circle(1, 12)}, Fault::geometry, sizes).find("left of its"),
            std::string::npos);
  EXPECT_NE(refusal({circle(5, 20), reversed(circle(1, 12, {4.5, 0}))}, Fault::geometry, sizes)
                .find("crosses or touches itself near ("),
            std::string::npos);
  SideLoop none = circle(5, 20);
  none.middles[3] = none.corners[3];
  EXPECT_NE(refusal({none}, Fault::geometry, sizes).find("no length near (2.93"),
            std::string::npos);
  none.middles[3].x() = std::nan("");
  EXPECT_NE(refusal({none}, Fault::geometry, sizes).find("not finite"), std::string::npos);
  EXPECT_NE(refusal({}, Fault::geometry, sizes), "meshed");
  EXPECT_NE(refusal({circle(5, 20)}, Fault::geometry, {0.0, 1.0}), "meshed");
  EXPECT_NE(refusal({circle(5, 20)}, Fault::geometry, {2.0, 1.0}), "meshed");
  EXPECT_NE(refusal({circle(5, 20)}, Fault::limit, {1e-4, 1e-4}), "meshed");
  RemeshSizes tiny{1e-5, 1.0};
  tiny.wanted = [](const Vec2& x) { return x.x() > 0.0 ? 1e-5 : 1.0; };
  EXPECT_NE(refusal({circle(5, 20)}, Fault::limit, tiny), "meshed");
}

TEST(DomainRemesher, AFoldThatClosesIsMeshedUntilItTouches) {
  const auto fold = [](double gap) {
    return outline({{{0, 0}, 0},
                    {{10, 0}, 0},
                    {{10, 5}, 0},
                    {{5 + 0.5 * gap, 5}, 0},
                    {{5, 1}, 0},
                    {{5 - 0.5 * gap, 5}, 0},
                    {{0, 5}, 0}},
                   0.7);
  };
  for (const double gap : {1e-1, 1e-3, 1e-6, 1e-9}) {
    const RemeshedDomain domain = remeshed(fold(gap), {0.1, 0.7});
    expect_sound(domain, "fold");
    EXPECT_GE(smallest_angle(domain.mesh), 20.0) << gap;
    EXPECT_LT(domain.mesh.triangles.size(), 600U) << gap; // lips do not refine each other
  }
  EXPECT_NE(refusal({fold(0.0)}, Fault::geometry, {0.1, 0.7}).find("touches itself near (5, "),
            std::string::npos);
}

TEST(DomainRemesher, SidesThatBulgeMoreThanHalfACircleAreMeshedAsTheyAre) {
  // The circles through their nodes leave the corner between them backwards, into each other.
  SideLoop loop = outline({{{0, 0}, 0},
                           {{10, 0}, 0},
                           {{10, 5}, 0},
                           {{5.5, 5}, 0},
                           {{5, 5}, 0},
                           {{4.5, 5}, 0},
                           {{0, 5}, 0}},
                          0.7);
  std::size_t bulges = 0;
  for (std::size_t i = 0; i < loop.corners.size(); ++i)
    if (const Vec2 middle = loop.middles[i];
        middle.y() == 5.0 && std::abs(middle.x() - 5.0) < 0.5) {
      loop.middles[i].y() += 0.35;
      ++bulges;
    }
  ASSERT_EQ(bulges, 2U);
  const RemeshedDomain domain = remeshed(loop, {0.05, 0.7});
  expect_sound(domain, "bulges");
  const auto highest = std::max_element(domain.mesh.points.begin(), domain.mesh.points.end(),
                                        [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  EXPECT_NEAR(highest->y(), 5.35, 0.02);
}

TEST(DomainRemesher, RepeatsToTheBitInAnyUnit) {
  SideLoop loop = forging();
  for (auto* nodes : {&loop.corners, &loop.middles})
    for (Vec2& x : *nodes) // without four points on a circle, rounding decides nothing
      x += Vec2(0.05 * std::sin(0.7 * x.y() + 1.0), 0.03 * std::sin(1.3 * x.x()));
  const RemeshedDomain first = remeshed(loop, {0.1, 1.0}, Measure::revolved);
  const RemeshedDomain again = remeshed(loop, {0.1, 1.0}, Measure::revolved);
  EXPECT_TRUE(first.mesh.points == again.mesh.points);
  EXPECT_TRUE(first.mesh.triangles == again.mesh.triangles);
  for (const double scale : {1.0 / 1024.0, 1e-3, 1e3}) {
    SideLoop scaled = loop;
    for (auto* nodes : {&scaled.corners, &scaled.middles})
      for (Vec2& x : *nodes)
        x *= scale;
    const RemeshedDomain other = remeshed(scaled, {0.1 * scale, scale}, Measure::revolved);
    EXPECT_TRUE(first.mesh.triangles == other.mesh.triangles) << scale;
    ASSERT_EQ(first.mesh.points.size(), other.mesh.points.size()) << scale;
    for (std::size_t i = 0; i < first.mesh.points.size(); ++i)
      EXPECT_LT((first.mesh.points[i] - other.mesh.points[i] / scale).norm(), 1e-9) << scale;
  }
}

TEST(DomainRemesher, HasAsManyTrianglesAsItsSizesAskFor) {
  const RemeshedDomain domain = remeshed(forging(), {0.1, 0.95}, Measure::revolved);
  std::printf("%zu triangles, %zu sides\n", domain.mesh.triangles.size(),
              domain.mesh.boundary.size());
  EXPECT_GT(domain.mesh.triangles.size(), 1200U);
  EXPECT_LT(domain.mesh.triangles.size(), 1800U);
}

} // namespace
} // namespace billet::geometry::domain_remesher_test
