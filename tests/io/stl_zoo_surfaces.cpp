#include "tests/io/stl_zoo.h"
#include "tests/io/stl_zoo_meshes.h"

namespace billet::io {

namespace {

using Make = std::function<TriangleMesh(Random&)>;

constexpr int all_digits = 17;

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
          "body_with_a_hole", sound, "in 1 loop",
          [](Random& r) { return without(ball(), any(r, 360), 360); }, false),
      kind(
          "body_with_many_holes", sound, "open",
          [](Random& r) { return without(ball(), 5 + any(r, 8), 36); }, false),
      kind("body_with_a_cavity", sound, "2 parts", cavity, true),
      kind(
          "angle_bar", sound, "closed", [](Random&) { return geometry::angle_bar(); }, true),
      kind(
          "spiky", sound, "closed", [](Random&) { return geometry::spiky(9); }, true),
      kind(
          "crack_wider_than_the_tolerance", sound, "open",
          [](Random& r) { return shrunk(ball(), between(r, 0.01, 0.1)); }, false),
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
