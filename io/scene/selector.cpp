#include "io/scene/selector.h"

#include "geometry/base/box.h"
#include "io/scene/missed_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace billet::io {

using mechanics::Face;
using mechanics::Index;

Selector::Selector(const mechanics::Mesh& mesh,
                   const std::vector<Face>& surface,
                   const std::vector<Face>& boundary)
    : mesh_(mesh), surface_(surface), boundary_(boundary), size_(box_of(mesh.points).size()) {}

std::vector<Index> Selector::nodes(const Where& where) {
  std::vector<Index> found;
  if (std::holds_alternative<Everywhere>(where.kind)) {
    for (Index i = 0; i < mesh_.n_points(); ++i)
      found.push_back(i);
  } else if (const auto* plane = std::get_if<OnPlane>(&where.kind)) {
    constexpr double tolerance = 1e-6; // of the size of the mesh, as the case format says
    for (Index i = 0; i < mesh_.n_points(); ++i)
      if (std::abs(mesh_.points[idx(i)][plane->axis] - plane->value) <= tolerance * size_)
        found.push_back(i);
    if (found.empty())
      complain(
          where,
          fmt::format("no node of the mesh lies on {} = {}", "xyz"[plane->axis], plane -> value),
          "check the coordinate against the mesh ('billet check' prints its box)");
  } else {
    found = set(where, std::get<InSet>(where.kind).name);
  }
  warn_of_missed(where, found);
  return found;
}

void Selector::warn_of_missed(const Where& where, const std::vector<Index>& found) {
  std::vector<char> meant(mesh_.points.size(), 0);
  for (const Index i : found)
    meant[idx(i)] = 1;
  if (const auto* plane = std::get_if<OnPlane>(&where.kind))
    if (const auto near =
            nodes_near_plane(mesh_, surface_, meant, plane->axis, plane->value, size_))
      warnings_.push_back(fmt::format("warning: [near-plane] {}: {}; put them on it, or name a set",
                                      where.key, *near));
  if (std::holds_alternative<InSet>(where.kind))
    if (const auto middle = missed_middle_nodes(mesh_, surface_, meant))
      warnings_.push_back(fmt::format("warning: [middle-nodes] {}, set '{}': {}; complete the set",
                                      where.key, std::get<InSet>(where.kind).name, *middle));
}

std::vector<Face> Selector::faces(const Where& where) {
  std::vector<char> selected(mesh_.points.size(), 0);
  const std::vector<Index> of_place = nodes(where);
  for (const Index i : of_place)
    selected[idx(i)] = 1;
  std::vector<Face> found;
  for (const Face& face : boundary_)
    if (std::all_of(face.nodes.begin(), face.nodes.end(),
                    [&](Index a) { return selected[idx(a)] != 0; }))
      found.push_back(face);
  if (found.empty() && !of_place.empty())
    complain(where,
             fmt::format("{} node(s) lie there, but no whole free face (the axis of an "
                         "axisymmetric part is none)",
                         of_place.size()),
             "name a place on the surface of the part that holds all nodes of a face");
  return found;
}

void Selector::throw_if_any() const {
  if (!complaints_.empty())
    throw Error(Fault::case_file, complaints_);
}

std::vector<Index> Selector::set(const Where& where, const std::string& name) {
  const auto found = mesh_.node_sets.find(name);
  if (found != mesh_.node_sets.end())
    return found->second;
  std::string known;
  for (const auto& [other, nodes] : mesh_.node_sets)
    known += (known.empty() ? "" : ", ") + other;
  complain(where, "the mesh has no set named '" + name + "'",
           known.empty() ? "the mesh has no sets" : "it has: " + known);
  return {};
}

void Selector::complain(const Where& where, const std::string& message, std::string remedy) {
  complaints_.push_back({where.place, where.key + ": " + message, std::move(remedy)});
}

} // namespace billet::io
