#include "process/increment/symmetry_walls.h"

#include "process/scene/scene.h"
#include "process/state/run.h"
#include "process/state/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

namespace {

/// How far beyond a wall a node may end, once. [mm]
double slack(const Wall& wall, double near) { return wall.axis ? 0.0 : near; }

/// The shortest edge of a face [mm].
double shortest_edge(const mechanics::Mesh& mesh, const mechanics::Face& face) {
  const bool triangle = face.nodes.size() % 3 == 0;
  const std::size_t corners = mesh.dimension() == 2 ? 2 : triangle ? 3 : 4;
  double shortest = HUGE_VAL;
  for (std::size_t a = 0; a < corners; ++a)
    shortest = std::min(
        shortest,
        (mesh.points[idx(face.nodes[a])] - mesh.points[idx(face.nodes[(a + 1) % corners])]).norm());
  return shortest;
}

/// Nodes of the surface, and of each the shortest edge of its faces, if that is shorter than the
/// first elements' edges were on average [mm].
std::map<Index, double> surface_edges(const Run& run) {
  std::map<Index, double> edges;
  for (const mechanics::Face& face : mechanics::boundary_faces(run.mesh())) {
    const double edge = std::min(run.state.mesh.first_side, shortest_edge(run.mesh(), face));
    for (const Index node : face.nodes) {
      const auto [place, is_new] = edges.emplace(node, edge);
      if (!is_new)
        place->second = std::min(place->second, edge);
    }
  }
  return edges;
}

std::size_t unknown(const Run& run, const Wall& wall, Index node) {
  return idx(node * run.mesh().dimension() + wall.component);
}

/// How far a node is off a wall, in a state of the unknowns [mm].
double gap(const Run& run, const Wall& wall, Index node, const std::vector<double>& x) {
  return wall.sense * (x[unknown(run, wall, node)] - wall.at);
}

Vec3 place(const Run& run, Index node, const std::vector<double>& x) {
  Vec3 place = Vec3::Zero();
  const int dim = run.mesh().dimension();
  for (int i = 0; i < dim; ++i)
    place[i] = x[idx(node * dim + i)];
  return place;
}

using Held = std::vector<std::array<char, 3>>;

/// Which components of each node supports hold.
Held holds(const Part& part) {
  Held held(part.mesh.points.size(), {0, 0, 0});
  for (const Support& support : part.supports)
    for (const Index node : support.nodes)
      held[idx(node)][idx(support.component)] = 1;
  return held;
}

/// Whether metal may slide along a plane at most of its nodes, or is held across at its rims, where
/// other planes of symmetry may be.
bool lets_slide(const std::vector<Vec3>& points,
                const std::vector<Index>& plane,
                int normal,
                const Held& held) {
  std::vector<char> slides(plane.size(), 1);
  for (int d = 0; d < 3; ++d) {
    if (d == normal)
      continue;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Index node : plane) {
      low = std::min(low, points[idx(node)][d]);
      high = std::max(high, points[idx(node)][d]);
    }
    const double rounding = 1e-9 * (high - low);
    bool everywhere = high > low;
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const double at = points[idx(plane[i])][d];
      const bool is_held = held[idx(plane[i])][idx(d)] != 0;
      everywhere = everywhere && is_held;
      if (is_held && at > low + rounding && at < high - rounding)
        slides[i] = 0;
    }
    if (everywhere)
      return false;
  }
  return 2 * std::count(slides.begin(), slides.end(), 1) >= std::ssize(plane);
}

/// Whether a support holds its nodes where they were.
bool stands(const Support& support) {
  const auto& points = support.displacement.points();
  return std::all_of(points.begin(), points.end(),
                     [](const auto& point) { return point.second == 0.0; });
}

/// Area of a face by its corners; in the plane its length.
double size_of(const mechanics::Mesh& mesh, const mechanics::Face& face) {
  const auto at = [&](std::size_t corner) { return mesh.points[idx(face.nodes[corner])]; };
  if (mesh.dimension() == 2)
    return (at(1) - at(0)).norm();
  const double half = 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  const bool triangle = face.nodes.size() % 3 == 0;
  return triangle ? half : half + 0.5 * (at(2) - at(0)).cross(at(3) - at(0)).norm();
}

/// Whether the part ends at a plane and is held there over its faces, as at a plane of symmetry,
/// and not at single nodes, an edge, or a foot of a side that goes on: of what may be free a crack
/// is the most.
bool ends_at(const mechanics::Mesh& mesh, const std::vector<char>& held, const Wall& plane) {
  constexpr double least_share = 0.3;
  double low = plane.at, high = plane.at;
  for (const Vec3& point : mesh.points) {
    low = std::min(low, point[plane.component]);
    high = std::max(high, point[plane.component]);
  }
  const double near = 1e-6 * (high - low);
  double on_plane = 0.0, of_support = 0.0;
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh)) {
    const auto all = [&](auto&& is) {
      return std::all_of(face.nodes.begin(), face.nodes.end(), is);
    };
    if (!all([&](Index node) {
          return std::abs(mesh.points[idx(node)][plane.component] - plane.at) <= near;
        }))
      continue;
    const double size = size_of(mesh, face);
    on_plane += size;
    if (all([&](Index node) { return held[idx(node)] != 0; }))
      of_support += size;
  }
  return of_support > 0.0 && of_support >= least_share * on_plane;
}

/// The plane on which a support holds the part as a plane of symmetry does, if it is one: all of
/// the part lies on one side and ends there, and the metal may slide along it.
std::optional<Wall> plane_of(const Run& run, const Support& support, const Held& held) {
  const std::vector<Vec3>& points = run.mesh().points;
  if (support.nodes.empty() || !stands(support))
    return std::nullopt;
  const int c = support.component;
  const double at = points[idx(support.nodes.front())][c];
  double low = 0.0, high = 0.0;
  for (const Vec3& point : points) {
    low = std::min(low, point[c] - at);
    high = std::max(high, point[c] - at);
  }
  const double rounding = 1e-9 * (high - low);
  const bool flat = std::all_of(support.nodes.begin(), support.nodes.end(), [&](Index node) {
    return std::abs(points[idx(node)][c] - at) <= rounding;
  });
  if (!flat || !lets_slide(points, support.nodes, c, held) || (low < -rounding && high > rounding))
    return std::nullopt;
  const Wall wall{c, at, high > rounding ? 1.0 : -1.0, false, {}, {}, {}, {}};
  std::vector<char> held_across(points.size());
  for (std::size_t node = 0; node < points.size(); ++node)
    held_across[node] = held[node][idx(c)];
  return ends_at(run.mesh(), held_across, wall) ? std::optional(wall) : std::nullopt;
}

/// Area that a node of the surface stands for, about [mm^2].
double area_at(const Run& run, Index node) {
  const double side = run.state.mesh.first_side;
  switch (run.part().analysis) {
  case mechanics::Analysis::axisymmetric:
    return 2.0 * std::numbers::pi * run.state.x[idx(2 * node)] * side;
  case mechanics::Analysis::solid:
    return side * side;
  case mechanics::Analysis::plane_strain:
    return side;
  }
  return 0.0;
}

/// Takes the nodes of a wall that it would have to pull off it.
void release(const Run& run, Wall& wall) {
  constexpr double pull = 1e-5; // over Young's modulus: what is less is rounding, to and fro
  const double young = run.scene.material.elasticity.young;
  if (!wall.axis) // where nothing has an area, forces say nothing
    std::erase_if(wall.held, [&](Index node) {
      return wall.sense * run.state.reactions[unknown(run, wall, node)] <
             -pull * young * area_at(run, node);
    });
}

/// Nodes that have come to a wall in the last increment.
std::vector<Index> arrived(const Run& run, const Wall& wall) {
  std::vector<Index> nodes;
  for (std::size_t i = 0; i < wall.off.size(); ++i)
    if (const Index node = wall.off[i];
        gap(run, wall, node, run.state.x) < wall.near[i] &&
        wall.sense * run.state.velocity[unknown(run, wall, node)] < 0.0 &&
        !std::binary_search(wall.held.begin(), wall.held.end(), node))
      nodes.push_back(node);
  return nodes;
}

void note_meeting(const Run& run, const std::vector<Index>& nodes, Wall& wall) {
  if (!wall.met)
    wall.met = MetWall{run.state.time, {}};
  for (const Index node : nodes)
    wall.met->box.add(place(run, node, run.state.x));
}

} // namespace

void find_walls(Run& run) {
  const bool revolved = run.part().analysis == mechanics::Analysis::axisymmetric;
  run.state.walls.clear();
  if (revolved)
    run.state.walls.push_back({0, 0.0, 1.0, true, {}, {}, {}, {}});
  const Held held = holds(run.part());
  const auto is_known = [&](const Wall& wall) { // several supports may share a plane
    return std::any_of(run.state.walls.begin(), run.state.walls.end(), [&](const Wall& other) {
      return other.component == wall.component && other.sense == wall.sense;
    });
  };
  for (const Support& support : run.part().supports)
    if (run.scene.contact.self && !(revolved && support.component == 0))
      if (const std::optional<Wall> wall = plane_of(run, support, held); wall && !is_known(*wall))
        run.state.walls.push_back(*wall);
  note_nodes_off_walls(run);
}

void note_nodes_off_walls(Run& run) {
  if (run.state.walls.empty())
    return;
  // Nodes nearer to a wall than this share of their edges are on it. The last of a bore would ask
  // for hoops that shrink to nothing: what is left counts as closed.
  constexpr double of_edge = 0.002, of_edge_at_axis = 0.1;
  const std::map<Index, double> surface = surface_edges(run);
  for (Wall& wall : run.state.walls) {
    std::vector<char> supported(run.part().mesh.points.size(), 0);
    for (const Support& support : run.part().supports)
      if (support.component == wall.component)
        for (const Index node : support.nodes)
          supported[idx(node)] = 1;
    wall.off.clear();
    wall.near.clear();
    for (const auto& [node, edge] : surface) {
      const double near = (wall.axis ? of_edge_at_axis : of_edge) * edge;
      // What has lain on the axis from the start without a support is free there.
      const double least = wall.axis ? near : -near;
      if (supported[idx(node)] == 0 &&
          (gap(run, wall, node, run.state.x) > least ||
           std::binary_search(wall.held.begin(), wall.held.end(), node))) {
        wall.off.push_back(node);
        wall.near.push_back(near);
      }
    }
  }
}

void hold_where_on_walls(Run& run) {
  for (Wall& wall : run.state.walls) {
    wall.held.clear();
    for (std::size_t i = 0; i < wall.off.size(); ++i)
      if (gap(run, wall, wall.off[i], run.state.x) < wall.near[i])
        wall.held.push_back(wall.off[i]);
    if (!wall.held.empty())
      note_meeting(run, wall.held, wall); // a new mesh may be what brings them there
  }
}

Outcome<Done> check_walls(const Run& run) {
  for (const Wall& wall : run.state.walls)
    for (std::size_t i = 0; i < wall.off.size(); ++i)
      if (gap(run, wall, wall.off[i], run.attempt.x) < -slack(wall, wall.near[i])) {
        const Vec3 x = place(run, wall.off[i], run.attempt.x);
        return Failure{fmt::format("the workpiece goes through {}, at ({:.6g}, {:.6g}, {:.6g})",
                                   name_of_wall(wall), x[0], x[1], x[2])};
      }
  return Done{};
}

double up_to_walls(const Run& run, double step) {
  for (const Wall& wall : run.state.walls)
    for (std::size_t i = 0; i < wall.off.size(); ++i) {
      const Index node = wall.off[i];
      const double near = wall.near[i];
      const double h = gap(run, wall, node, run.state.x);
      const double v = wall.sense * run.state.velocity[unknown(run, wall, node)];
      if (v < 0.0 && h > near && h + step * v < -slack(wall, near))
        step = (h - 0.5 * near) / -v;
    }
  return step;
}

std::vector<std::string> hold_on_walls(Run& run) {
  std::vector<std::string> events;
  for (Wall& wall : run.state.walls) {
    release(run, wall);
    const std::vector<Index> nodes = arrived(run, wall);
    if (nodes.empty())
      continue;
    note_meeting(run, nodes, wall);
    wall.held.insert(wall.held.end(), nodes.begin(), nodes.end());
    std::sort(wall.held.begin(), wall.held.end());
    const Vec3 x = place(run, nodes.front(), run.state.x);
    events.push_back(
        fmt::format("  {} node(s) of the surface come to {}, near ({:.6g}, {:.6g}, {:.6g})",
                    nodes.size(), name_of_wall(wall), x[0], x[1], x[2]));
  }
  return events;
}

std::shared_ptr<const Part> part_held_on_walls(const Run& run) {
  auto part = std::make_shared<Part>(run.part());
  for (const Wall& wall : run.state.walls)
    part->supports.push_back({wall.held, wall.component, TimeFunction(0.0)});
  return part;
}

void take_held_nodes(std::vector<Wall>& walls, std::vector<Support>& supports) {
  for (std::size_t w = walls.size(); w-- > 0; supports.pop_back())
    walls[w].held = std::move(supports.back().nodes);
}

} // namespace billet::process
