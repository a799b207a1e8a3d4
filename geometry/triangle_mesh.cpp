#include "geometry/triangle_mesh.h"

#include "geometry/edge_table.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace billet::geometry {

namespace {

using Triangle = std::array<std::int32_t, 3>;

const Vec3& corner(const TriangleMesh& mesh, const Triangle& t, std::size_t i) {
  return mesh.points[static_cast<std::size_t>(t[i])];
}

Vec3 doubled_area(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3& a = corner(mesh, t, 0);
  return (corner(mesh, t, 1) - a).cross(corner(mesh, t, 2) - a);
}

// The same triangle starting with its smallest point number.
Triangle turned(const Triangle& t) {
  const auto first = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

std::int64_t repeats(std::vector<Triangle> triangles) {
  std::sort(triangles.begin(), triangles.end());
  const auto last = std::unique(triangles.begin(), triangles.end());
  return triangles.end() - last;
}

bool has_repeated_corner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

// Coordinates are known no better than this.
double rounding(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Vec3& point : mesh.points)
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return 8.0 * std::numeric_limits<double>::epsilon() * largest;
}

// Side opposite the smallest height, and that height.
struct Flatness {
  std::size_t longest;
  double height;
  double shortest;
};

Flatness flatness_of(const TriangleMesh& mesh, const Triangle& t) {
  std::array<double, 3> length{};
  for (std::size_t i = 0; i < 3; ++i)
    length[i] = (corner(mesh, t, (i + 1) % 3) - corner(mesh, t, i)).norm();
  const auto longest =
      static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  const double base = length[longest];
  return {longest, base > 0.0 ? doubled_area(mesh, t).norm() / base : 0.0,
          *std::min_element(length.begin(), length.end())};
}

void weld(TriangleMesh& mesh, CleanUp& done) {
  const std::size_t n = mesh.points.size();
  std::vector<std::int32_t> order(n), same(n), number(n, -1);
  std::iota(order.begin(), order.end(), 0);
  const auto point = [&](std::int32_t i) -> const Vec3& {
    return mesh.points[static_cast<std::size_t>(i)];
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
    const Vec3 &a = point(i), &b = point(j);
    return std::tie(a.x(), a.y(), a.z(), i) < std::tie(b.x(), b.y(), b.z(), j);
  });
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(order[k]);
    const bool first = k == 0 || point(order[k]) != point(order[k - 1]);
    same[i] = first ? order[k] : same[static_cast<std::size_t>(order[k - 1])];
    done.welded_points += first ? 0 : 1;
  }
  std::vector<Vec3> kept;
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t) {
      std::int32_t& renumbered =
          number[static_cast<std::size_t>(same[static_cast<std::size_t>(v)])];
      if (renumbered < 0) {
        renumbered = static_cast<std::int32_t>(kept.size());
        kept.push_back(point(v));
      }
      v = renumbered;
    }
  done.unused_points += static_cast<std::int64_t>(n - kept.size()) - done.welded_points;
  mesh.points = std::move(kept);
}

void drop_useless(TriangleMesh& mesh, CleanUp& done) {
  const auto degenerate = std::erase_if(mesh.triangles, has_repeated_corner);
  done.degenerate_triangles += static_cast<std::int64_t>(degenerate);
  std::vector<std::pair<Triangle, std::size_t>> keys;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    keys.emplace_back(turned(mesh.triangles[t]), t);
  std::sort(keys.begin(), keys.end());
  std::vector<char> repeated(mesh.triangles.size(), 0);
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (keys[k].first == keys[k - 1].first) {
      repeated[keys[k].second] = 1;
      ++done.duplicate_triangles;
    }
  std::size_t next = 0;
  std::erase_if(mesh.triangles, [&](const Triangle&) { return repeated[next++] != 0; });
}

std::span<const EdgeUse> find(const std::vector<EdgeUse>& uses, std::int32_t a, std::int32_t b) {
  const std::pair<std::int32_t, std::int32_t> key = std::minmax(a, b);
  const auto less = [](const EdgeUse& use, const auto& k) {
    return std::pair(use.low, use.high) < k;
  };
  const auto first = std::lower_bound(uses.begin(), uses.end(), key, less);
  const auto last = std::lower_bound(first, uses.end(), std::pair(key.first, key.second + 1), less);
  return {first, last};
}

// One pass over the mesh; true if something changed. With the sliver (a, b, c), b between a and c,
// and its neighbour (a, c, d): both become (a, b, d) and (b, c, d). (G.13)
bool flip_slivers(TriangleMesh& mesh, double flatness, CleanUp& done) {
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  std::vector<char> touched(mesh.triangles.size(), 0), dropped(mesh.triangles.size(), 0);
  bool changed = false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Flatness flat = flatness_of(mesh, mesh.triangles[t]);
    if (touched[t] != 0 || flat.height > flatness || flat.shortest <= flatness)
      continue;
    const Triangle old = mesh.triangles[t];
    const std::int32_t c = old[flat.longest], a = old[(flat.longest + 1) % 3];
    const std::int32_t b = old[(flat.longest + 2) % 3];
    const std::span<const EdgeUse> across = find(uses, a, c);
    if (across.size() == 1)
      dropped[t] = 1;
    else if (across.size() == 2 && across[0].forward != across[1].forward) {
      const EdgeUse& use =
          across[0].triangle == static_cast<std::int32_t>(t) ? across[1] : across[0];
      const auto other = static_cast<std::size_t>(use.triangle);
      const std::int32_t d = mesh.triangles[other][static_cast<std::size_t>((use.side + 2) % 3)];
      if (touched[other] != 0 || d == b || !find(uses, b, d).empty())
        continue;
      mesh.triangles[t] = {a, b, d};
      mesh.triangles[other] = {b, c, d};
      touched[other] = 1;
    } else
      continue;
    touched[t] = 1;
    changed = true;
    ++done.slivers;
  }
  std::size_t next = 0;
  std::erase_if(mesh.triangles, [&](const Triangle&) { return dropped[next++] != 0; });
  return changed;
}

std::int64_t components(const TriangleMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      std::int32_t& up = parent[static_cast<std::size_t>(i)];
      up = parent[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  };
  std::vector<char> used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t v : t) {
      used[static_cast<std::size_t>(v)] = 1;
      parent[static_cast<std::size_t>(root(v))] = root(t[0]);
    }
  std::int64_t count = 0;
  for (std::size_t i = 0; i < parent.size(); ++i)
    count += used[i] != 0 && parent[i] == static_cast<std::int32_t>(i) ? 1 : 0;
  return count;
}

std::string coordinates(const Vec3& x) {
  return fmt::format("({:g}, {:g}, {:g})", x.x(), x.y(), x.z());
}

} // namespace

CleanUp clean_up(TriangleMesh& mesh, double flatness) {
  CleanUp done;
  weld(mesh, done);
  drop_useless(mesh, done);
  // A flip may leave a flat triangle behind; each pass shortens it.
  constexpr int passes = 16;
  const double height = std::max(flatness, rounding(mesh));
  for (int pass = 0; pass < passes && flip_slivers(mesh, height, done); ++pass)
    drop_useless(mesh, done);
  return done;
}

MeshHealth health(const TriangleMesh& mesh) {
  MeshHealth health;
  health.points = static_cast<std::int64_t>(mesh.points.size());
  health.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      health.bounds.add(corner(mesh, t, i));

  const double flat = rounding(mesh);
  const Vec3 middle = 0.5 * (health.bounds.low + health.bounds.high); // against cancellation
  std::vector<Triangle> corners;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 area = doubled_area(mesh, t);
    health.area += 0.5 * area.norm();
    health.volume += area.dot(corner(mesh, t, 0) - middle) / 6.0;
    corners.push_back(sorted(t));
    if (flatness_of(mesh, t).height > flat)
      continue;
    ++health.degenerate_triangles;
    if (!health.degenerate_at)
      health.degenerate_at = corner(mesh, t, 0);
  }
  health.duplicate_triangles = repeats(std::move(corners));
  health.components = components(mesh);

  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> uses) {
    const Vec3 at = 0.5 * (mesh.points[static_cast<std::size_t>(uses[0].low)] +
                           mesh.points[static_cast<std::size_t>(uses[0].high)]);
    if (uses.size() == 1)
      ++health.border_edges;
    else if (uses.size() > 2) {
      ++health.non_manifold_edges;
      if (!health.non_manifold_at)
        health.non_manifold_at = at;
    } else if (uses[0].forward == uses[1].forward) {
      ++health.inconsistent_edges;
      if (!health.inconsistent_at)
        health.inconsistent_at = at;
    }
  });
  if (!health.closed())
    health.volume = 0.0;
  return health;
}

std::vector<Complaint> complaints(const MeshHealth& health, const std::string& place) {
  std::vector<Complaint> found;
  if (health.triangles == 0)
    found.push_back({place, "the surface has no triangles", ""});
  if (health.degenerate_at)
    found.push_back({place,
                     fmt::format("{} triangles have no area, the first at {}",
                                 health.degenerate_triangles, coordinates(*health.degenerate_at)),
                     "repair the surface"});
  if (health.non_manifold_at)
    found.push_back({place,
                     fmt::format("{} edges belong to more than two triangles, the first at {}",
                                 health.non_manifold_edges, coordinates(*health.non_manifold_at)),
                     "remove inner walls and doubled faces"});
  if (health.inconsistent_at)
    found.push_back(
        {place,
         fmt::format("across {} edges the triangles face opposite ways, the first at {}",
                     health.inconsistent_edges, coordinates(*health.inconsistent_at)),
         "orient all triangles the same way"});
  if (health.duplicate_triangles > 0 && found.empty())
    found.push_back({place,
                     fmt::format("{} triangles lie on another one, facing the other way",
                                 health.duplicate_triangles),
                     "give the tool a thickness, or remove one of the two sheets"});
  return found;
}

TriangleMesh flipped(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles)
    std::swap(t[1], t[2]);
  return mesh;
}

} // namespace billet::geometry
