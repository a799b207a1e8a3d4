#include "geometry/triangles/triangle_mesh.h"

#include "geometry/triangles/edge_table.h"
#include "geometry/triangles/triangle_shape.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace billet::geometry {

namespace {

using Triangle = std::array<std::int32_t, 3>;

// The same triangle starting with its smallest point number.
Triangle turned(const Triangle& t) {
  const auto first = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

bool has_repeated_corner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

struct NumberedPoint {
  Vec3 x;
  std::int32_t number;
};

void weld(TriangleMesh& mesh, CleanUp& done) {
  const std::size_t n = mesh.points.size();
  std::vector<NumberedPoint> order;
  order.reserve(n);
  for (const Vec3& x : mesh.points)
    order.push_back({x, static_cast<std::int32_t>(order.size())});
  std::sort(order.begin(), order.end(), [](const NumberedPoint& a, const NumberedPoint& b) {
    return std::tie(a.x[0], a.x[1], a.x[2], a.number) < std::tie(b.x[0], b.x[1], b.x[2], b.number);
  });
  std::vector<std::int32_t> same(n), number(n, -1);
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(order[k].number);
    const bool first = k == 0 || order[k].x != order[k - 1].x;
    same[i] = first ? order[k].number : same[static_cast<std::size_t>(order[k - 1].number)];
    done.welded_points += first ? 0 : 1;
  }
  std::vector<Vec3> kept;
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& v : t) {
      std::int32_t& renumbered =
          number[static_cast<std::size_t>(same[static_cast<std::size_t>(v)])];
      if (renumbered < 0) {
        renumbered = static_cast<std::int32_t>(kept.size());
        kept.push_back(mesh.points[static_cast<std::size_t>(v)]);
      }
      v = renumbered;
    }
  done.unused_points += static_cast<std::int64_t>(n - kept.size()) - done.welded_points;
  mesh.points = std::move(kept);
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
    const TriangleShape flat = shape_of(mesh, mesh.triangles[t]);
    if (touched[t] != 0 || flat.height > flatness || flat.shortest <= flatness)
      continue;
    const Triangle old = mesh.triangles[t];
    const std::int32_t c = old[flat.longest_side], a = old[(flat.longest_side + 1) % 3];
    const std::int32_t b = old[(flat.longest_side + 2) % 3];
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

// Draws every edge shorter than `flatness` to one of its ends; an end that has taken another stays
// where it is, so that no point moves farther. True if something changed.
bool collapse_short_edges(TriangleMesh& mesh, double flatness, CleanUp& done) {
  std::vector<std::int32_t> target(mesh.points.size());
  std::iota(target.begin(), target.end(), 0);
  std::vector<char> fixed(mesh.points.size(), 0);
  const auto at = [](auto& list, std::int32_t i) -> auto& {
    return list[static_cast<std::size_t>(i)];
  };
  bool changed = false;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t a = t[i], b = t[(i + 1) % 3];
      if ((at(mesh.points, a) - at(mesh.points, b)).norm() > flatness || at(target, a) != a ||
          at(target, b) != b || (at(fixed, a) != 0 && at(fixed, b) != 0))
        continue;
      if (at(fixed, b) != 0)
        std::swap(a, b);
      at(target, b) = a;
      at(fixed, a) = 1;
      changed = true;
      ++done.collapsed_edges;
    }
  if (changed)
    for (Triangle& t : mesh.triangles)
      for (std::int32_t& v : t)
        v = at(target, v);
  return changed;
}

} // namespace

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

void remove_slivers(TriangleMesh& mesh, double flatness, CleanUp& done) {
  // A flip may leave a flat triangle behind; each pass shortens it.
  constexpr int passes = 16;
  const double height = std::max(flatness, coordinate_rounding(mesh));
  for (int pass = 0; pass < passes; ++pass) {
    const bool collapsed = collapse_short_edges(mesh, height, done);
    if (collapsed)
      drop_useless(mesh, done);
    const bool swapped = flip_slivers(mesh, height, done);
    if (swapped)
      drop_useless(mesh, done);
    if (!collapsed && !swapped)
      return;
  }
}

CleanUp clean_up(TriangleMesh& mesh, double flatness) {
  CleanUp done;
  weld(mesh, done);
  drop_useless(mesh, done);
  remove_slivers(mesh, flatness, done);
  return done;
}

TriangleMesh flipped(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles)
    std::swap(t[1], t[2]);
  return mesh;
}

} // namespace billet::geometry
