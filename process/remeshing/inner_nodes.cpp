#include "process/remeshing/inner_nodes.h"

#include "mechanics/elements/mesh_locator.h"
#include "mechanics/mesh/mesh_edges.h"
#include "process/state/mesh_quality.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// Which nodes of a mesh do not lie on its boundary.
std::vector<char> inner_nodes(const mechanics::Mesh& mesh) {
  std::vector<char> inner(mesh.points.size(), 1);
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh))
    for (const Index node : face.nodes)
      inner[idx(node)] = 0;
  return inner;
}

/// Finds the nodes of a new mesh that stand for inner ones of an old mesh, and moves them.
class InnerNodes {
public:
  InnerNodes(const Part& old, std::span<const double> x, mechanics::Mesh& anew)
      : old_(old.mesh), points_(as_points(x, old.mesh.dimension())),
        inner_before_(inner_nodes(old.mesh)), anew_(anew), inner_(inner_nodes(anew)),
        places_(mechanics::MeshLocator(old.mesh, x).locate(anew.points)),
        is_corner_(anew.points.size(), 0), drawn_(anew.points.size(), 0),
        stands_for_(old.mesh.points.size()) {
    const auto corners = idx(mechanics::corners_per_element(anew.kind));
    for (Index e = 0; e < anew.n_elements(); ++e)
      for (const Index node : anew.cell(e).first(corners))
        is_corner_[idx(node)] = 1;
  }

  /// Adds to a list of the new mesh what stands for the inner ones of an old list.
  void add(const std::vector<Index>& before, std::vector<Index>& list) {
    const std::vector<double> region = nodes_of_whole_elements(before);
    add_region(region, list);
    for (const Index node : before)
      if (inner_before_[idx(node)] != 0 && region[idx(node)] == 0.0)
        if (const std::optional<Index> found = stand_in(node))
          list.push_back(*found);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

private:
  /// 1 for the nodes of elements that lie in an old list with all their nodes, else 0.
  [[nodiscard]] std::vector<double> nodes_of_whole_elements(const std::vector<Index>& list) const {
    std::vector<char> wanted(old_.points.size(), 0);
    for (const Index node : list)
      wanted[idx(node)] = 1;
    std::vector<double> covered(old_.points.size(), 0.0);
    for (Index e = 0; e < old_.n_elements(); ++e) {
      const auto cell = old_.cell(e);
      if (std::all_of(cell.begin(), cell.end(), [&](Index a) { return wanted[idx(a)] != 0; }))
        for (const Index node : cell)
          covered[idx(node)] = 1.0;
    }
    return covered;
  }

  /// Nodes nearer to those of a region than to others: so it neither grows nor shrinks from mesh to
  /// mesh.
  void add_region(const std::vector<double>& region, std::vector<Index>& list) const {
    constexpr double half = 0.5;
    for (std::size_t node = 0; node < places_.size(); ++node) {
      double share = 0.0;
      if (inner_[node] != 0)
        mechanics::interpolate(old_, places_[node], region, std::span(&share, 1));
      if (share >= half)
        list.push_back(static_cast<Index>(node));
    }
  }

  /// The corner that stands for an old node, the same in all lists: the nearest that can be drawn
  /// to its place, or else the nearest.
  std::optional<Index> stand_in(Index node) {
    constexpr std::ptrdiff_t tries = 4;
    std::optional<Index>& found = stands_for_[idx(node)];
    if (found)
      return found;
    const Vec3& place = points_[idx(node)];
    std::vector<std::pair<double, Index>> nearest;
    for (std::size_t i = 0; i < anew_.points.size(); ++i)
      if (inner_[i] != 0 && is_corner_[i] != 0 && drawn_[i] == 0)
        nearest.emplace_back((anew_.points[i] - place).norm(), static_cast<Index>(i));
    const auto last = nearest.begin() + std::min(std::ssize(nearest), tries);
    std::partial_sort(nearest.begin(), last, nearest.end());
    const auto drawn =
        std::find_if(nearest.begin(), last, [&](const auto& at) { return draw(at.second, place); });
    if (drawn != last)
      found = drawn->second;
    else if (!nearest.empty())
      found = nearest.front().second;
    return found;
  }

  /// Moves a corner to a place, and inner corners around it with it, unless the worst element gets
  /// much worse.
  bool draw(Index corner, const Vec3& to) {
    constexpr double least_share = 0.5;
    const std::vector<Vec3> before = anew_.points;
    const double quality = worst_quality(anew_, mechanics::node_positions(anew_));
    for (const double shifts : {4.0, 8.0}) { // elements are sheared by a part of it
      shift_around(corner, to - before[idx(corner)], shifts);
      if (worst_quality(anew_, mechanics::node_positions(anew_)) >= least_share * quality) {
        drawn_[idx(corner)] = 1;
        return true;
      }
      anew_.points = before;
    }
    return false;
  }

  void shift_around(Index corner, const Vec3& shift, double shifts) {
    const Vec3 from = anew_.points[idx(corner)];
    const double farthest = shifts * shift.norm();
    for (std::size_t i = 0; i < anew_.points.size(); ++i) {
      if (inner_[i] == 0 || is_corner_[i] == 0 || drawn_[i] != 0)
        continue;
      const double away = (anew_.points[i] - from).norm();
      if (away < farthest)
        anew_.points[i] += (1.0 - away / farthest) * shift;
    }
    put_middles();
  }

  /// Inner edges are straight.
  void put_middles() {
    const auto corners = idx(mechanics::corners_per_element(anew_.kind));
    const auto edges = mechanics::element_edges(anew_.kind);
    for (Index e = 0; e < anew_.n_elements(); ++e) {
      const auto cell = anew_.cell(e);
      for (std::size_t k = 0; k < edges.size(); ++k)
        if (const Index middle = cell[corners + k]; inner_[idx(middle)] != 0)
          anew_.points[idx(middle)] = 0.5 * (anew_.points[idx(cell[idx(edges[k][0])])] +
                                             anew_.points[idx(cell[idx(edges[k][1])])]);
    }
  }

  const mechanics::Mesh& old_;
  std::vector<Vec3> points_; ///< of the old nodes [mm]
  std::vector<char> inner_before_;
  mechanics::Mesh& anew_;
  std::vector<char> inner_;
  std::vector<mechanics::MeshLocation> places_; ///< of the new nodes in the old mesh
  std::vector<char> is_corner_, drawn_;
  std::vector<std::optional<Index>> stands_for_; ///< new nodes
};

} // namespace

void add_inner_nodes(const Part& old, std::span<const double> x, RemeshedPart& anew) {
  const std::vector<char> inner = inner_nodes(old.mesh);
  using Lists = std::vector<std::pair<const std::vector<Index>*, std::vector<Index>*>>;
  Lists lists;
  for (std::size_t s = 0; s < old.supports.size(); ++s)
    lists.emplace_back(&old.supports[s].nodes, &anew.supports[s].nodes);
  for (const auto& [name, nodes] : old.mesh.node_sets)
    lists.emplace_back(&nodes, &anew.mesh.node_sets[name]);
  std::erase_if(lists, [&](const auto& list) {
    const auto& [before, after] = list;
    return before->size() == old.mesh.points.size() ||
           std::none_of(before->begin(), before->end(),
                        [&](Index node) { return inner[idx(node)] != 0; });
  });
  if (lists.empty())
    return;
  InnerNodes nodes(old, x, anew.mesh);
  for (const auto& [before, after] : lists)
    nodes.add(*before, *after);
}

} // namespace billet::process
