#include "tests/geometry/sample_meshes.h"
#include "tests/io/stl_zoo.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace billet::io {

using geometry::cube;
using geometry::flipped;
using geometry::sphere_mesh;
using geometry::TriangleMesh;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points)
    p += by;
  return mesh;
}

TriangleMesh posed(TriangleMesh mesh, Random& random) {
  const Vec3 axis = Vec3(between(random, -1, 1), between(random, -1, 1), 1.5).normalized();
  const Mat3 turn = Eigen::AngleAxisd(between(random, 0.0, 6.0), axis).toRotationMatrix();
  const double scale = between(random, 10.0, 100.0);
  const Vec3 shift(between(random, -50, 50), between(random, -50, 50), between(random, -50, 50));
  for (Vec3& p : mesh.points)
    p = scale * (turn * p) + shift;
  return mesh;
}

TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both = a;
  const auto first = static_cast<std::int32_t>(a.points.size());
  both.points.insert(both.points.end(), b.points.begin(), b.points.end());
  for (const std::array<std::int32_t, 3>& t : b.triangles)
    both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return both;
}

std::string binary_stl(const TriangleMesh& mesh, const std::string& header) {
  std::string bytes = header.substr(0, 80);
  bytes.resize(80, ' ');
  const auto put = [&](auto value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(value)>>(value);
    bytes.append(raw.data(), raw.size());
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 &a = geometry::corner(mesh, t, 0), &b = geometry::corner(mesh, t, 1),
               &c = geometry::corner(mesh, t, 2);
    for (const Vec3& v : {Vec3((b - a).cross(c - a).stableNormalized()), a, b, c})
      for (int i = 0; i < 3; ++i)
        put(static_cast<float>(v[i]));
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string ascii_stl(const TriangleMesh& mesh, int digits, const std::string& name) {
  std::string text = "solid " + name + "\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& x = geometry::corner(mesh, t, i);
      text += fmt::format("   vertex {0:.{3}g} {1:.{3}g} {2:.{3}g}\n", x.x(), x.y(), x.z(), digits);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

namespace {

using Triangle = std::array<std::int32_t, 3>;
using Make = std::function<TriangleMesh(Random&)>;

constexpr int all_digits = 17;

TriangleMesh ball() { return sphere_mesh(10); }

TriangleMesh flat(std::int32_t n) {
  return geometry::sheet(n, [](double, double) { return 0.0; });
}

TriangleMesh box(double x, double y, double z) {
  return geometry::prism({{0, 0}, {x, 0}, {x, y}, {0, y}}, z);
}

std::size_t any(Random& random, std::size_t n) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

// Every triangle with corners of its own.
TriangleMesh loose(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    soup.triangles.push_back({first, first + 1, first + 2});
    for (std::size_t i = 0; i < 3; ++i)
      soup.points.push_back(geometry::corner(mesh, t, i));
  }
  return soup;
}

Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

TriangleMesh with(TriangleMesh mesh, const Triangle& t) {
  mesh.triangles.push_back(t);
  return mesh;
}

TriangleMesh without(TriangleMesh mesh, std::size_t n, Random& random) {
  for (std::size_t i = 0; i < n; ++i)
    mesh.triangles.erase(mesh.triangles.begin() +
                         static_cast<std::ptrdiff_t>(any(random, mesh.triangles.size())));
  return mesh;
}

TriangleMesh partly_turned(TriangleMesh mesh, std::size_t every) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += every)
    mesh.triangles[t] = turned(mesh.triangles[t]);
  return mesh;
}

// Every corner of every triangle a little off.
TriangleMesh shaken(const TriangleMesh& mesh, double by, Random& random) {
  TriangleMesh soup = loose(mesh);
  for (Vec3& p : soup.points)
    p += Vec3(between(random, -by, by), between(random, -by, by), between(random, -by, by));
  return soup;
}

// The triangle after `share` of its first side is cut in two, and its neighbour not; `filled` by a
// triangle without height.
TriangleMesh split_on_one_side(TriangleMesh mesh, std::size_t t, double share, bool filled) {
  const Triangle old = mesh.triangles[t];
  const auto middle = static_cast<std::int32_t>(mesh.points.size());
  const Vec3 a = geometry::corner(mesh, t, 0), b = geometry::corner(mesh, t, 1);
  mesh.points.emplace_back(a + share * (b - a));
  mesh.triangles[t] = {old[0], middle, old[2]};
  mesh.triangles.push_back({middle, old[1], old[2]});
  if (filled)
    mesh.triangles.push_back({old[0], old[1], middle});
  return mesh;
}

// A band with a number of half turns.
TriangleMesh band(int half_turns) {
  constexpr std::int32_t n = 40;
  TriangleMesh mesh;
  for (std::int32_t i = 0; i <= n; ++i) {
    const double phi = 2.0 * std::numbers::pi * i / n, tilt = 0.5 * phi * half_turns;
    const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
    for (const double w : {-0.3, 0.3})
      mesh.points.emplace_back((1.0 + w * std::cos(tilt)) * out +
                               w * std::sin(tilt) * Vec3::UnitZ());
  }
  // The last pair is the first, swapped after an odd number of half turns.
  const bool odd = half_turns % 2 != 0;
  mesh.points[2 * n] = mesh.points[odd ? 1 : 0];
  mesh.points[2 * n + 1] = mesh.points[odd ? 0 : 1];
  for (std::int32_t i = 0; i < n; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

TriangleMesh heap(Random& random) {
  TriangleMesh mesh;
  for (std::int32_t i = 0; i < 300; ++i)
    mesh.points.emplace_back(between(random, 0, 1), between(random, 0, 1), between(random, 0, 1));
  for (std::int32_t i = 0; i < 300; i += 3)
    mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

// A cube glued to its mirror image: the face between has the same two triangles.
TriangleMesh mirrored_cube() {
  TriangleMesh mesh = flipped(cube());
  for (Vec3& p : mesh.points)
    p.x() = 2.0 - p.x();
  return mesh;
}

TriangleMesh upright(double x, double turn) {
  TriangleMesh mesh = flat(3);
  for (Vec3& p : mesh.points)
    p = Eigen::AngleAxisd(turn, Vec3::UnitX()) * Vec3(p - Vec3(x, 0.51, 0));
  return mesh;
}

ZooKind kind(const char* name,
             Verdict verdict,
             const char* says,
             const Make& make,
             std::optional<bool> closed = std::nullopt) {
  return {name, verdict, says, [make](Random& r) { return binary_stl(posed(make(r), r)); }, closed};
}

// Without rounding to single precision, and where it is built.
ZooKind exact(const char* name,
              Verdict verdict,
              const char* says,
              const Make& make,
              std::optional<bool> closed = std::nullopt) {
  return {name, verdict, says, [make](Random& r) { return ascii_stl(make(r), all_digits); },
          closed};
}

std::vector<ZooKind> sound_surfaces() {
  const auto cavity = [](Random&) {
    TriangleMesh inner = flipped(cube());
    for (Vec3& p : inner.points)
      p = 0.3 * p + Vec3::Constant(0.2);
    return together(cube(), inner);
  };
  const auto scaled = [](double by) {
    return [by](Random&) {
      TriangleMesh mesh = ball();
      for (Vec3& p : mesh.points)
        p *= by;
      return mesh;
    };
  };
  constexpr auto sound = Verdict::sound;
  return {
      kind(
          "one_triangle", sound, "open, 3 border edges in 1 loop",
          [](Random&) {
            return TriangleMesh{flat(1).points, {{0, 1, 2}}};
          },
          false),
      kind(
          "flat_die_face", sound, "open", [](Random&) { return flat(6); }, false),
      kind(
          "curved_die_face", sound, "open",
          [](Random&) {
            return geometry::sheet(8, [](double x, double y) { return x * x - 0.3 * y; });
          },
          false),
      kind(
          "roll_without_ends", sound, "in 2 loops", [](Random&) { return band(0); }, false),
      kind(
          "band_with_a_full_turn", sound, "in 2 loops", [](Random&) { return band(2); }, false),
      kind(
          "body_with_a_hole", sound, "in 1 loop", [](Random& r) { return without(ball(), 1, r); },
          false),
      kind(
          "body_with_many_holes", sound, "open", [](Random& r) { return without(ball(), 9, r); },
          false),
      kind("body_with_a_cavity", sound, "2 parts", cavity, true),
      kind(
          "angle_bar", sound, "closed", [](Random&) { return geometry::angle_bar(); }, true),
      kind(
          "spiky", sound, "closed", [](Random&) { return geometry::spiky(9); }, true),
      kind(
          "crack_wider_than_the_tolerance", sound, "open",
          [](Random& r) { return shaken(cube(), 0.02, r); }, false),
      kind(
          "small_part_far_away", sound, "2 parts",
          [](Random&) {
            return together(ball(), moved(cube(), {3e3, 0, 0}));
          },
          true),
      exact("huge", sound, "closed", scaled(1e37), true),
      exact("tiny", sound, "closed", scaled(1e-30), true),
      exact(
          "far_away_with_all_digits", sound, "closed",
          [](Random&) {
            return moved(ball(), {1e6, -1e6, 1e6});
          },
          true),
      exact("metres_for_millimetres", sound, "closed", scaled(1e-3), true),
  };
}

std::vector<ZooKind> dirty_triangles() {
  constexpr auto noted = Verdict::noted;
  const auto all_twice = [](Random&) { return together(ball(), ball()); };
  const auto needle = [](double share) {
    return [share](Random& r) { return split_on_one_side(cube(), any(r, 12), share, true); };
  };
  return {
      kind(
          "triangle_in_a_point", noted, "1 degenerate",
          [](Random&) {
            return with(ball(), {3, 3, 3});
          },
          true),
      kind(
          "triangle_in_a_line", noted, "1 degenerate",
          [](Random&) {
            return with(ball(), {3, 4, 4});
          },
          true),
      kind("triangle_without_height", noted, "1 flat triangle", needle(0.5), true),
      exact("triangle_without_height_in_doubles", noted, "1 flat triangle", needle(0.3), true),
      exact("needle_of_aspect_1e9", noted, "drawn to a point", needle(1e-9), true),
      exact("needle_of_aspect_1e15", noted, "drawn to a point", needle(1e-15), true),
      kind(
          "long_needles", noted, "needles", [](Random&) { return box(1.0, 0.5, 5e-5); }, true),
      kind(
          "duplicate", noted, "1 duplicate",
          [](Random& r) { return with(ball(), ball().triangles[any(r, 100)]); }, true),
      kind(
          "duplicate_starting_elsewhere", noted, "1 duplicate",
          [](Random& r) {
            const Triangle t = ball().triangles[any(r, 100)];
            return with(ball(), {t[1], t[2], t[0]});
          },
          true),
      kind("everything_twice", noted, "360 duplicate", all_twice, true),
      kind(
          "one_triangle_a_thousand_times", noted, "999 duplicate",
          [](Random&) {
            return TriangleMesh{flat(1).points, std::vector<Triangle>(1000, {0, 1, 2})};
          },
          false),
      kind(
          "opposite_triangle", noted, "back to back",
          [](Random& r) { return with(ball(), turned(ball().triangles[any(r, 100)])); }, true),
      kind(
          "opposite_patch", noted, "back to back",
          [](Random&) {
            TriangleMesh mesh = ball();
            for (std::size_t t = 60; t < 90; ++t)
              mesh.triangles.push_back(turned(mesh.triangles[t]));
            return mesh;
          },
          true),
      kind("far_away_in_single_precision", noted, "coordinates are known to",
           [](Random&) {
             return moved(ball(), {3e4, 0, 3e4});
           }),
  };
}

std::vector<ZooKind> cracked_surfaces() {
  constexpr auto noted = Verdict::noted;
  const auto slit = [](Random& r) {
    TriangleMesh mesh = ball();
    const std::size_t t = any(r, 100);
    const auto copy = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.emplace_back(geometry::corner(mesh, t, 0) + Vec3::Constant(3e-6));
    mesh.triangles[t][0] = copy;
    return mesh;
  };
  const auto several_junctions = [](Random&) {
    TriangleMesh mesh = split_on_one_side(cube(), 4, 0.25, false);
    mesh = split_on_one_side(mesh, mesh.triangles.size() - 1, 0.5, false);
    return split_on_one_side(mesh, 6, 0.7, false);
  };
  return {
      kind("slit", noted, "merged across cracks", slit, true),
      kind(
          "every_triangle_on_its_own", noted, "merged across cracks",
          [](Random& r) { return shaken(ball(), 4e-6, r); }, true),
      kind(
          "every_triangle_on_its_own_open", noted, "merged across cracks",
          [](Random& r) { return shaken(flat(5), 2e-6, r); }, false),
      kind(
          "t_junction", noted, "1 T-junction",
          [](Random& r) { return split_on_one_side(ball(), 40 + any(r, 100), 0.4, false); }, true),
      kind("several_t_junctions", noted, "T-junctions closed", several_junctions, true),
      kind(
          "two_halves_of_different_mesh_size", noted, "T-junctions closed",
          [](Random&) {
            return together(flat(4), moved(flat(8), {1, 0, 0}));
          },
          false),
  };
}

std::vector<ZooKind> turned_surfaces() {
  constexpr auto noted = Verdict::noted;
  return {
      kind(
          "one_triangle_turned", noted, "1 triangles turned",
          [](Random& r) {
            TriangleMesh mesh = ball();
            Triangle& t = mesh.triangles[any(r, mesh.triangles.size())];
            t = turned(t);
            return mesh;
          },
          true),
      kind(
          "every_third_turned", noted, "triangles turned",
          [](Random&) { return partly_turned(ball(), 3); }, true),
      kind(
          "every_other_turned", noted, "triangles turned",
          [](Random&) { return partly_turned(ball(), 2); }, true),
      kind(
          "sheet_partly_turned", noted, "triangles turned",
          [](Random&) { return partly_turned(flat(6), 5); }, false),
      kind(
          "inside_out", noted, "inside out", [](Random&) { return flipped(ball()); }, true),
      kind(
          "one_of_two_bodies_inside_out", noted, "1 closed parts turned",
          [](Random&) {
            return together(ball(), moved(flipped(cube()), {4, 0, 0}));
          },
          true),
      kind(
          "turned_and_inside_out", noted, "triangles turned",
          [](Random&) { return partly_turned(flipped(cube()), 4); }, true),
      kind(
          "body_within_a_body", noted, "no effect from outside",
          [](Random&) {
            TriangleMesh inner = cube();
            for (Vec3& p : inner.points)
              p = 0.3 * p + Vec3::Constant(0.2);
            return together(cube(), inner);
          },
          true),
  };
}

std::vector<ZooKind> meeting_bodies() {
  constexpr auto noted = Verdict::noted;
  const auto cubes = [](const Vec3& by) {
    return [by](Random&) { return together(cube(), moved(cube(), by)); };
  };
  const auto mirrored = [](Random&) { return together(cube(), mirrored_cube()); };
  return {
      kind("touching_in_a_corner", noted, "touch in a point", cubes({1, 1, 1}), true),
      kind("touching_in_an_edge", noted, "touch in a point or an edge", cubes({1, 1, 0}), true),
      exact("touching_in_a_face", noted, "overlap or touch", cubes({1, 0, 0}), true),
      kind(
          "touching_in_part_of_a_face", noted, "",
          [](Random& r) {
            return together(cube(), moved(box(0.3, 0.4, 0.5), {0.2, between(r, 0, 0.5), 1}));
          },
          true),
      exact(
          "touching_in_part_of_a_face_exactly", noted, "overlap or touch",
          [](Random&) {
            return together(cube(), moved(box(0.25, 0.5, 0.5), {0.25, 0.25, 1}));
          },
          true),
      kind("glued_by_a_doubled_face", noted, "4 triangles back to back", mirrored, true),
      kind("overlapping_bodies", noted, "overlap or touch", cubes({0.3, 0.4, 0.2}), true),
      kind(
          "overlapping_balls", noted, "overlap or touch",
          [](Random& r) {
            return together(ball(), moved(ball(), {between(r, 0.5, 1.5), 0.1, 0.2}));
          },
          true),
      exact(
          "coplanar_sheets_on_each_other", noted, "touch or cut by less than",
          [](Random&) {
            return together(flat(3), moved(flat(3), {0.17, 0.23, 0}));
          },
          false),
  };
}

std::vector<ZooKind> hopeless_surfaces() {
  constexpr auto refused = Verdict::refused;
  const auto wall = [](Random&) { return with(with(cube(), {0, 2, 6}), {0, 6, 4}); };
  const auto fin = [](Random&) {
    TriangleMesh mesh = ball();
    mesh.points.emplace_back(3, 3, 3);
    return with(mesh, {20, 21, static_cast<std::int32_t>(mesh.points.size()) - 1});
  };
  const auto inverted_lobe = [](Random&) {
    TriangleMesh mesh = ball();
    for (Vec3& p : mesh.points)
      if (p.z() > 0.5)
        p.z() = -2.0 * p.z();
    return mesh;
  };
  const auto half_turned = [](Random&) {
    TriangleMesh mesh = flat(6);
    for (std::size_t t = 0; t < mesh.triangles.size() / 2; ++t)
      mesh.triangles[t] = turned(mesh.triangles[t]);
    return mesh;
  };
  return {
      kind("moebius_strip", refused, "one-sided", [](Random&) { return band(1); }),
      kind("moebius_strip_of_three_half_turns", refused, "one-sided",
           [](Random&) { return band(3); }),
      kind("sheet_half_of_it_turned", refused, "face opposite ways", half_turned),
      kind("sheet_doubled", refused, "facing the other way",
           [](Random&) { return together(flat(4), flipped(flat(4))); }),
      exact("sheet_doubled_and_shifted", refused, "back to back",
            [](Random&) {
              return together(flat(3), moved(flipped(flat(3)), {0.17, 0.23, 0}));
            }),
      kind("three_triangles_on_an_edge", refused, "more than two triangles", fin),
      kind("inner_wall", refused, "more than two triangles", wall),
      kind("sheets_through_each_other", refused, "cut each other",
           [](Random&) { return together(upright(0.5, 0.4), upright(0.53, 1.3)); }),
      kind("sheet_through_a_body", refused, "cut each other",
           [](Random&) {
             return together(cube(), moved(flat(3), {0.5, 0.5, 0.51}));
           }),
      kind("body_turned_through_itself", refused, "cut each other", inverted_lobe),
      kind("heap_of_triangles", refused, "cut each other", heap),
      kind("everything_in_a_point", refused, "no facet is larger",
           [](Random&) {
             return TriangleMesh{{{1, 2, 3}}, {{0, 0, 0}, {0, 0, 0}}};
           }),
      kind("everything_on_a_line", refused, "",
           [](Random&) {
             return TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}},
                                 {{0, 1, 2}, {1, 2, 3}}};
           }),
      exact("a_corner_at_1e38", refused, "",
            [](Random&) {
              TriangleMesh mesh = ball();
              mesh.points[7].x() = 1e38;
              return mesh;
            }),
  };
}

} // namespace

std::vector<ZooKind> zoo_of_surfaces() {
  std::vector<ZooKind> all;
  for (const auto& more : {sound_surfaces(), dirty_triangles(), cracked_surfaces(),
                           turned_surfaces(), meeting_bodies(), hopeless_surfaces()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

} // namespace billet::io
