// Whole problems in memory: what the tests of process/ and verification/ build scenes from.
//
// Units: mm, N, MPa, s. In the plane x is across (the radius) and y up; in space z is up.

#pragma once

#include "geometry/surfaces/analytic_surfaces.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"
#include "process/loop/process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace billet::process {

using mechanics::Analysis;
using mechanics::ElementKind;

inline std::size_t as_size(Index i) { return static_cast<std::size_t>(i); }

/// Axis along which tools press: y in the plane, z in space.
inline int up(Analysis analysis) { return analysis == Analysis::solid ? 2 : 1; }

/// Steel of the billet benchmark (VALIDATION FRM-06).
inline mechanics::Material billet_steel() {
  return {{200e3, 0.3}, mechanics::Linear{700.0, 300.0}};
}

/// Never yields.
inline mechanics::Material elastic_body(double young, double poisson) {
  return {{young, poisson}, mechanics::Elastic{}};
}

/// Nodes whose coordinate along `axis` is `value`.
inline std::vector<Index> nodes_at(const mechanics::Mesh& mesh, int axis, double value) {
  constexpr double rounding = 1e-9;
  std::vector<Index> nodes;
  for (Index a = 0; a < mesh.n_points(); ++a)
    if (std::abs(mesh.points[as_size(a)][axis] - value) < rounding)
      nodes.push_back(a);
  return nodes;
}

/// Holds one component of the nodes on a plane.
inline Support held(const mechanics::Mesh& mesh, int axis, double value) {
  return {nodes_at(mesh, axis, value), axis, TimeFunction(0.0)};
}

/// Boundary faces whose nodes all lie on the plane `axis` = `value`, or all the others.
inline std::vector<mechanics::Face>
faces_on(const mechanics::Mesh& mesh, int axis, double value, bool others = false) {
  constexpr double rounding = 1e-9;
  std::vector<mechanics::Face> found;
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh)) {
    const bool on = std::all_of(face.nodes.begin(), face.nodes.end(), [&](Index a) {
      return std::abs(mesh.points[as_size(a)][axis] - value) < rounding;
    });
    if (on != others)
      found.push_back(face);
  }
  return found;
}

/// Boundary faces that lie on no plane of symmetry x = 0, y = 0 (z = 0).
inline std::vector<mechanics::Face> free_faces(const mechanics::Mesh& mesh, Analysis analysis) {
  constexpr double rounding = 1e-9;
  std::vector<mechanics::Face> found;
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh)) {
    bool symmetry = false;
    for (int axis = 0; axis <= up(analysis); ++axis)
      symmetry = symmetry || std::all_of(face.nodes.begin(), face.nodes.end(), [&](Index a) {
                   return std::abs(mesh.points[as_size(a)][axis]) < rounding;
                 });
    if (!symmetry)
      found.push_back(face);
  }
  return found;
}

/// A tool of a shape that moves with a constant velocity.
inline contact::Tool moving_tool(std::string name,
                                 geometry::SurfacePtr surface,
                                 const Vec3& velocity,
                                 contact::Friction friction = contact::Frictionless{}) {
  contact::Tool tool;
  tool.name = std::move(name);
  tool.surface = std::move(surface);
  tool.motion.velocity = velocity;
  tool.friction = friction;
  return tool;
}

/// A flat die above `height` that comes down at 1 mm/s.
inline contact::Tool flat_die(Analysis analysis, double height, const contact::Friction& friction) {
  const Vec3 along = Vec3::Unit(up(analysis));
  return moving_tool("die", geometry::make_plane(height * along, -along), -along, friction);
}

/// A roll in the plane whose lowest point is (0, `top`); its axis goes up by `rise` over time [mm].
inline contact::Tool
roll_above(double top, double radius, const TimeFunction& rise, const contact::Friction& friction) {
  const Vec3 centre(0.0, top + radius, 0.0);
  contact::Tool roll =
      moving_tool("roll", geometry::make_circle(centre, radius, false), Vec3::Zero(), friction);
  roll.motion.velocity.reset();
  roll.motion.displacement = std::array{TimeFunction(0.0), rise, TimeFunction(0.0)};
  roll.reference = centre;
  return roll;
}

/// A part with symmetry planes through the origin, from 0 to `height`, pressed by a flat die.
struct Upsetting {
  mechanics::Mesh mesh;
  Analysis analysis = Analysis::axisymmetric;
  double height = 15.0;
  contact::Friction friction = contact::Frictionless{};
  mechanics::Material material = billet_steel();
  double reduction = 0.1; ///< of the height, in one stage at 1 mm/s
};

inline Scene upsetting_scene(Upsetting u) {
  Scene scene;
  scene.title = "upsetting";
  scene.part.analysis = u.analysis;
  scene.part.mesh = std::move(u.mesh);
  scene.material = u.material;
  for (int axis = 0; axis <= up(u.analysis); ++axis)
    scene.part.supports.push_back(held(scene.part.mesh, axis, 0.0));
  scene.tools.push_back(flat_die(u.analysis, u.height, u.friction));
  scene.touch = {1};
  scene.part.contact_faces = free_faces(scene.part.mesh, u.analysis);
  scene.stages.push_back({"press", u.reduction * u.height, {1}, false});
  return scene;
}

/// A strip 2 mm high in plane strain that lies on y = 0, `half` to either side of x = 0.
inline Scene strip_on_table(ElementKind kind, double half, int nx, int ny) {
  Scene scene;
  scene.part.analysis = Analysis::plane_strain;
  scene.part.mesh =
      mechanics::box_mesh({kind, Vec3(-half, 0, 0), Vec3(half, 2, 0), {nx, ny, 1}, {1, 1, 1}});
  scene.material = billet_steel();
  scene.part.supports.push_back(held(scene.part.mesh, 1, 0.0));
  scene.touch = {0};
  return scene;
}

/// A cylinder of radius 5 and height 15 by its meridian, or a quarter of a square bar.
inline Upsetting bar_upsetting(ElementKind kind) {
  const bool solid = mechanics::dimension(kind) == 3;
  Upsetting u;
  u.analysis = solid ? Analysis::solid : Analysis::axisymmetric;
  u.mesh = mechanics::box_mesh({kind,
                                Vec3::Zero(),
                                solid ? Vec3(5, 5, u.height) : Vec3(5, u.height, 0),
                                {2, solid ? 2 : 4, 3},
                                {1, 1, 1}});
  return u;
}

/// The billet benchmark's half model (VALIDATION FRM-06): radius 10, half height 15.
inline Scene billet_scene(ElementKind kind,
                          int nx,
                          int ny,
                          const contact::Friction& friction,
                          double reduction) {
  Upsetting u;
  u.mesh = mechanics::box_mesh({kind, Vec3::Zero(), Vec3(10, 15, 0), {nx, ny, 1}, {1, 1, 1}});
  u.friction = friction;
  u.reduction = reduction;
  return upsetting_scene(std::move(u));
}

/// Moves the interior nodes of a mesh that lie between two heights by up to `size`, the same way in
/// every run; mid-side nodes go to the middle of their corners, so that sides stay straight.
inline void distort_inside(mechanics::Mesh& mesh, double size, int axis, double low, double high) {
  std::vector<char> fixed(mesh.points.size(), 0);
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh))
    for (const Index a : face.nodes)
      fixed[as_size(a)] = 1;
  const int dim = mesh.dimension();
  for (std::size_t a = 0; a < fixed.size(); ++a)
    if (fixed[a] == 0 && mesh.points[a][axis] > low && mesh.points[a][axis] < high)
      for (int d = 0; d < dim; ++d)
        mesh.points[a][d] +=
            size * std::sin(12.9 * static_cast<double>(a) + 78.2 * static_cast<double>(d));
  const auto edges = mechanics::element_edges(mesh.kind);
  const int corners = mechanics::corners_per_element(mesh.kind);
  const int nodes = mechanics::nodes_per_element(mesh.kind);
  for (Index e = 0; e < mesh.n_elements(); ++e)
    for (int m = 0; corners + m < nodes; ++m) {
      const auto& edge = edges[static_cast<std::size_t>(m)];
      const auto cell = mesh.cell(e);
      mesh.points[as_size(cell[static_cast<std::size_t>(corners + m)])] =
          0.5 * (mesh.points[as_size(cell[static_cast<std::size_t>(edge[0])])] +
                 mesh.points[as_size(cell[static_cast<std::size_t>(edge[1])])]);
    }
}

/// One accepted increment with what the tools felt.
struct Entry {
  IncrementReport report;
  std::vector<contact::ToolLoad> loads;
  std::vector<double> positions;
};

/// Keeps what happens in a run.
class Recorder final : public Observer {
public:
  void started(const Run&) override { ++starts; }
  void incremented(const Run& process, const IncrementReport& report) override {
    Entry entry{report, {}, {process.positions().begin(), process.positions().end()}};
    if (process.contact() != nullptr)
      entry.loads.assign(process.contact()->loads().begin(), process.contact()->loads().end());
    entries.push_back(std::move(entry));
  }
  void failed(const Run&, const PostMortem& post) override { failures.push_back(post); }
  void finished(const Run&) override { ++finishes; }
  [[nodiscard]] bool stop_requested() const override {
    return stop_after > 0 && static_cast<int>(entries.size()) >= stop_after;
  }

  std::vector<Entry> entries;
  std::vector<PostMortem> failures;
  int starts = 0;
  int finishes = 0;
  int stop_after = 0; ///< asks to stop after so many increments; 0: never
};

/// A run and what was recorded of it.
struct FinishedRun {
  std::unique_ptr<Process> process;
  Recorder recorder;
  RunStatus status = RunStatus::stopped;

  [[nodiscard]] const Entry& last() const { return recorder.entries.back(); }
  /// The first entry at or after a time.
  [[nodiscard]] const Entry& at(double time) const {
    for (const Entry& entry : recorder.entries)
      if (entry.report.time >= time * (1.0 - 1e-9))
        return entry;
    return last();
  }
};

inline FinishedRun run(Scene scene) {
  FinishedRun result;
  result.process = std::make_unique<Process>(std::move(scene));
  result.status = result.process->run({&result.recorder});
  for (const PostMortem& post : result.recorder.failures)
    std::printf("  not converged at t = %.6g, dt = %.3g: %s\n", post.time, post.dt,
                post.reason.c_str());
  return result;
}

/// Largest coordinate along an axis.
inline double largest_position(const Entry& entry, int dim, int axis) {
  double most = -1e300;
  for (std::size_t i = as_size(axis); i < entry.positions.size(); i += as_size(dim))
    most = std::max(most, entry.positions[i]);
  return most;
}

/// Tolerance for what asks `newton_orders`: no residual is as small, so each increment goes on
/// until its corrections are rounding. With a usual one it ends too early to show an order.
constexpr double to_rounding = 1e-13;

/// Orders of convergence log(d3 / d2) / log(d2 / d1) over the last corrections of each increment:
/// full steps, above rounding, in the asymptotic range and not parted by a contact point that
/// changed its status, for the theorem is about smooth equations. Corrections and not residuals:
/// they are the error of the iterate before, while a residual weighs a penetration a hundred times
/// heavier than a strain of the same size. Sorted.
///
/// The first correction of an increment does not count. It is the error of an extrapolation, spread
/// over the body; the later ones are where the equations are least linear. So the first quotient
/// d2 / d1^2 is smaller than those that follow (medians over 60 runs: 1.0,
/// then 2.5, 3.7, 4.5, 4.3), and an exact tangent would seem to have an order of 1.6.
///
/// @param size   what of an iteration is compared: the corrections, or the residuals
/// @param noise  values below are rounding, and so is what comes after them; of residuals the
///               penalty times that of a position
inline std::vector<double>
newton_orders(const std::vector<Entry>& entries,
              double mechanics::IterationRecord::*size = &mechanics::IterationRecord::correction,
              double noise = 1e-11) {
  constexpr double asymptotic = 1e-2;
  std::vector<double> orders;
  for (const Entry& entry : entries) {
    std::vector<double> r;
    for (const auto& record : entry.report.records) {
      if (record.iteration > 0 && record.*size <= noise)
        break;
      if (record.step < 1.0 || record.contact_changes > 0)
        r.clear();
      if (record.step == 1.0 && record.iteration > 1)
        r.push_back(record.*size);
    }
    if (r.size() < 3)
      continue;
    const double r1 = r[r.size() - 3], r2 = r[r.size() - 2], r3 = r[r.size() - 1];
    if (r1 < asymptotic && r2 < 0.1 * r1)
      orders.push_back(std::log(r3 / r2) / std::log(r2 / r1));
  }
  std::sort(orders.begin(), orders.end());
  return orders;
}

} // namespace billet::process
