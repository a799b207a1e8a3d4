#include "mechanics/mesh/mesh_connections.h"

#include "geometry/base/box.h"
#include "mechanics/mesh/mesh_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

namespace billet::mechanics {

namespace {

constexpr std::size_t max_complaints = 10; // of a sort
constexpr double same_place = 2e-6;        // of the size of the mesh: files may have six digits
constexpr double same_of_edge = 1e-2;      // of the shortest edge, no more than that

std::string written(const Vec3& p, int dimension) {
  return dimension == 2 ? fmt::format("({:.6g}, {:.6g})", p.x(), p.y())
                        : fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

/// A side of a cell; in the plane an edge.
struct ElementFace {
  Index element;
  std::vector<Index> nodes;   ///< corners in their order, outward, then those in the middle
  std::vector<Index> corners; ///< sorted
};

std::vector<ElementFace> all_faces(const Mesh& mesh) {
  const std::size_t n = corners_per_face(mesh.kind);
  std::vector<ElementFace> sides;
  for (Index element = 0; element < mesh.n_elements(); ++element)
    for (const std::vector<int>& local : face_nodes(mesh.kind)) {
      ElementFace side{element, {}, {}};
      for (const int node : local)
        side.nodes.push_back(mesh.cell(element)[static_cast<std::size_t>(node)]);
      side.corners.assign(side.nodes.begin(), side.nodes.begin() + static_cast<std::ptrdiff_t>(n));
      std::sort(side.corners.begin(), side.corners.end());
      sides.push_back(std::move(side));
    }
  std::stable_sort(sides.begin(), sides.end(), [](const ElementFace& a, const ElementFace& b) {
    return a.corners < b.corners;
  });
  return sides;
}

/// Calls `visit` with each group of sides that have the same corners.
template <class Visit> void for_each_group(std::span<const ElementFace> sides, Visit&& visit) {
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(
        first, sides.end(), [&](const ElementFace& s) { return s.corners != first->corners; });
    visit(std::span<const ElementFace>(first, last));
    first = last;
  }
}

/// Whether the corners of two sides, known to be the same, are gone round in the same sense: their
/// cells lie on the same side then.
template <class Node> bool same_sense(std::span<const Node> a, std::span<const Node> b) {
  const std::size_t n = a.size();
  const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return a[1] == b[(at + 1) % n] && (n > 2 || at == 0);
}

Vec3 centre_of(const Mesh& mesh, std::span<const Index> nodes) {
  Vec3 sum = Vec3::Zero();
  for (const Index node : nodes)
    sum += mesh.points[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

/// Numbers places such that those that are the same but for rounding have the same number.
class PlaceNumbers {
public:
  explicit PlaceNumbers(double tolerance) : tolerance_(tolerance) {}

  Index number(const Vec3& place) {
    const std::optional<Index> known = find(place);
    if (known)
      return *known;
    const auto next = static_cast<Index>(places_.size());
    places_.push_back(place);
    cells_[cell(place)].push_back(next);
    return next;
  }

  [[nodiscard]] std::optional<Index> find(const Vec3& place) const {
    const Cell middle = cell(place);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (found == cells_.end())
            continue;
          for (const Index candidate : found->second)
            if ((places_[static_cast<std::size_t>(candidate)] - place).norm() <= tolerance_)
              return candidate;
        }
    return std::nullopt;
  }

private:
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] Cell cell(const Vec3& p) const {
    const double width = 2.0 * tolerance_;
    return {std::llround(p.x() / width), std::llround(p.y() / width), std::llround(p.z() / width)};
  }

  double tolerance_;
  std::vector<Vec3> places_;
  std::map<Cell, std::vector<Index>> cells_;
};

/// Free sides that have all corners in the same places as another.
struct Doubled {
  std::vector<std::array<Index, 2>> on_each_other; ///< positions in the list; the same way round
  std::vector<std::array<Index, 2>> beside;        ///< positions in the list; the other way round
};

std::vector<ElementFace> free_faces(std::span<const ElementFace> sides) {
  std::vector<ElementFace> free;
  for_each_group(sides, [&](std::span<const ElementFace> group) {
    if (group.size() == 1)
      free.push_back(group.front());
  });
  return free;
}

Doubled doubled(const Mesh& mesh, std::span<const ElementFace> free, PlaceNumbers& numbers) {
  Doubled result;
  const std::size_t n = corners_per_face(mesh.kind);
  std::map<std::vector<Index>, std::pair<Index, std::vector<Index>>> seen; // by sorted places
  for (std::size_t i = 0; i < free.size(); ++i) {
    std::vector<Index> round;
    for (std::size_t a = 0; a < n; ++a)
      round.push_back(numbers.number(mesh.points[static_cast<std::size_t>(free[i].nodes[a])]));
    std::vector<Index> sorted = round;
    std::sort(sorted.begin(), sorted.end());
    const auto [known, is_new] = seen.try_emplace(sorted, static_cast<Index>(i), round);
    if (is_new)
      continue;
    const std::span<const Index> other(known->second.second), own(round);
    auto& list = same_sense(other, own) ? result.on_each_other : result.beside;
    list.push_back({known->second.first, static_cast<Index>(i)});
  }
  return result;
}

/// Number of parts that share no node.
Index n_parts(const Mesh& mesh) {
  std::vector<Index> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index node) {
    while (parent[static_cast<std::size_t>(node)] != node) {
      Index& up = parent[static_cast<std::size_t>(node)];
      up = parent[static_cast<std::size_t>(up)];
      node = up;
    }
    return node;
  };
  Index parts = mesh.n_points();
  for (Index element = 0; element < mesh.n_elements(); ++element)
    for (const Index node : mesh.cell(element)) {
      const Index a = root(mesh.cell(element)[0]);
      const Index b = root(node);
      if (a != b) {
        parent[static_cast<std::size_t>(b)] = a;
        --parts;
      }
    }
  return parts;
}

/// Places in the middle of a free side's edges, and of itself, where no corner of another may be.
std::vector<Vec3> places_between_corners(const Mesh& mesh, const ElementFace& side) {
  const std::size_t n = side.corners.size();
  std::vector<Vec3> places;
  for (std::size_t a = 0; a < (n == 2 ? 1 : n); ++a)
    places.push_back(centre_of(mesh, std::array{side.nodes[a], side.nodes[(a + 1) % n]}));
  if (n > 2)
    places.push_back(centre_of(mesh, std::span(side.nodes).first(n)));
  return places;
}

double shortest_edge(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (Index element = 0; element < mesh.n_elements(); ++element) {
    const auto cell = mesh.cell(element);
    for (const auto& [a, b] : element_edges(mesh.kind))
      shortest = std::min(
          shortest, (mesh.points[static_cast<std::size_t>(cell[static_cast<std::size_t>(a)])] -
                     mesh.points[static_cast<std::size_t>(cell[static_cast<std::size_t>(b)])])
                        .norm());
  }
  return shortest;
}

double tolerance(const Mesh& mesh) {
  return std::min(same_place * box_of(mesh.points).size(), same_of_edge * shortest_edge(mesh));
}

/// Whether two sides with the same corners have nodes in their middle in the same places, but not
/// the same nodes. Two curved sides may well have the same corners and a hole between them.
bool middles_coincide(const Mesh& mesh,
                      const ElementFace& a,
                      const ElementFace& b,
                      double tolerance) {
  const auto n = static_cast<std::ptrdiff_t>(a.corners.size());
  return std::all_of(a.nodes.begin() + n, a.nodes.end(), [&](Index node) {
    return std::any_of(b.nodes.begin() + n, b.nodes.end(), [&](Index other) {
      return (mesh.points[static_cast<std::size_t>(node)] -
              mesh.points[static_cast<std::size_t>(other)])
                 .norm() <= tolerance;
    });
  });
}

} // namespace

std::vector<Complaint>
check_connections(const Mesh& mesh, const std::string& place, const MeshLabels& labels) {
  const std::vector<ElementFace> sides = all_faces(mesh);
  const std::size_t n = corners_per_face(mesh.kind);
  const double near = tolerance(mesh);
  std::vector<std::string> crowded, on_each_other, apart;
  const auto where = [&](const ElementFace& side) {
    return written(centre_of(mesh, std::span(side.nodes).first(n)), mesh.dimension());
  };
  for_each_group(sides, [&](std::span<const ElementFace> group) {
    const ElementFace& a = group.front();
    if (group.size() > 2) {
      crowded.push_back(fmt::format("{} elements share the side at {}", group.size(), where(a)));
    } else if (group.size() == 2) {
      const ElementFace& b = group.back();
      const std::string pair = labels.pair(a.element, b.element);
      if (same_sense(std::span(a.nodes).first(n), std::span(b.nodes).first(n)))
        on_each_other.push_back(
            fmt::format("{} lie on the same side of their side at {}", pair, where(a)));
      else if (!std::is_permutation(a.nodes.begin(), a.nodes.end(), b.nodes.begin()) &&
               middles_coincide(mesh, a, b, near))
        apart.push_back(
            fmt::format("{} share the corners of their side at {}, but not the nodes in its middle",
                        pair, where(a)));
    }
  });
  const std::vector<ElementFace> free = free_faces(sides);
  PlaceNumbers numbers(near);
  for (const auto& [i, j] : doubled(mesh, free, numbers).on_each_other)
    on_each_other.push_back(
        fmt::format("{} lie on each other at {}: they have nodes of their own in the same places",
                    labels.pair(free[static_cast<std::size_t>(i)].element,
                                free[static_cast<std::size_t>(j)].element),
                    where(free[static_cast<std::size_t>(i)])));
  std::vector<Complaint> complaints;
  const auto report = [&](const std::vector<std::string>& messages, const std::string& remedy) {
    for (std::size_t i = 0; i < std::min(messages.size(), max_complaints); ++i)
      complaints.push_back({place, messages[i], remedy});
    if (messages.size() > max_complaints)
      complaints.push_back(
          {place, fmt::format("and {} more such sides", messages.size() - max_complaints), {}});
  };
  report(crowded, "a side belongs to one or two elements: leave out those that are there twice");
  report(on_each_other, "leave out the elements that are there twice");
  report(apart, "merge the nodes that lie in the same place");
  return complaints;
}

std::vector<std::string> loose_connections(const Mesh& mesh, const MeshLabels& labels) {
  std::vector<std::string> found;
  const std::size_t n = corners_per_face(mesh.kind);
  const std::vector<ElementFace> sides = all_faces(mesh);
  const std::vector<ElementFace> free = free_faces(sides);
  PlaceNumbers numbers(tolerance(mesh));
  const Doubled pairs = doubled(mesh, free, numbers); // all free corners are numbered now
  if (!pairs.beside.empty()) {
    const ElementFace& first = free[static_cast<std::size_t>(pairs.beside.front()[0])];
    found.push_back(fmt::format(
        "the mesh is not joined along {} pair(s) of sides, the first at {}: they lie on each other "
        "but have nodes of their own, so the part opens there like a crack; merge nodes that lie "
        "in the same place",
        pairs.beside.size(),
        written(centre_of(mesh, std::span(first.nodes).first(n)), mesh.dimension())));
  }
  std::vector<Vec3> hanging;
  for (const ElementFace& side : free)
    for (const Vec3& place : places_between_corners(mesh, side))
      if (numbers.find(place))
        hanging.push_back(place);
  if (!hanging.empty())
    found.push_back(fmt::format(
        "corners of elements lie in the middle of {} other elements' sides or edges without being "
        "joined to them, the first at {}: the part opens there; refine without hanging nodes",
        hanging.size(), written(hanging.front(), mesh.dimension())));
  for_each_group(sides, [&](std::span<const ElementFace> group) {
    const ElementFace& a = group.front();
    if (group.size() == 2 &&
        !std::is_permutation(a.nodes.begin(), a.nodes.end(), group.back().nodes.begin()))
      found.push_back(
          fmt::format("{} share the corners of two curved sides at {}: the hole "
                      "between them is "
                      "no surface that a tool can touch or a load press",
                      labels.pair(a.element, group.back().element),
                      written(centre_of(mesh, std::span(a.nodes).first(n)), mesh.dimension())));
  });
  if (const Index parts = n_parts(mesh); parts > 1)
    found.push_back(fmt::format(
        "the mesh consists of {} parts that share no node: they do not feel each other", parts));
  return found;
}

} // namespace billet::mechanics
