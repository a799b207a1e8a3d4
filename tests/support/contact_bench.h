// A small body under tools, without a run loop: what the tests of contact/ need.
//
// Units: mm, MPa.

#pragma once

#include "contact/surface/contact_surface.h"
#include "contact/term/contact_term.h"
#include "geometry/surfaces/analytic_surfaces.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/linear/sparse_matrix.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/mesh/mesh_generators.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace billet::contact {

/// An element kind in an analysis it can serve.
struct BodyKind {
  mechanics::ElementKind kind;
  mechanics::Analysis analysis;

  [[nodiscard]] bool solid() const { return analysis == mechanics::Analysis::solid; }
  [[nodiscard]] std::string name() const {
    const std::string element(mechanics::name(kind));
    return solid() ? element
                   : element + (analysis == mechanics::Analysis::axisymmetric ? " axisymmetric"
                                                                              : " plane strain");
  }
};

inline const std::vector<BodyKind>& body_kinds() {
  using mechanics::Analysis;
  using mechanics::ElementKind;
  static const std::vector<BodyKind> kinds{
      {ElementKind::quad4, Analysis::plane_strain}, {ElementKind::quad8, Analysis::plane_strain},
      {ElementKind::quad4, Analysis::axisymmetric}, {ElementKind::quad8, Analysis::axisymmetric},
      {ElementKind::hex8, Analysis::solid},         {ElementKind::hex20, Analysis::solid},
      {ElementKind::tri6, Analysis::plane_strain},  {ElementKind::tri6, Analysis::axisymmetric},
      {ElementKind::tet4, Analysis::solid},         {ElementKind::tet10, Analysis::solid}};
  return kinds;
}

inline std::size_t as_size(mechanics::Index i) { return static_cast<std::size_t>(i); }

/// Positions of all nodes, shape (n_dofs).
inline std::vector<double> flat_positions(const mechanics::Mesh& mesh) {
  std::vector<double> x;
  for (const Vec3& p : mesh.points)
    x.insert(x.end(), p.data(), p.data() + mesh.dimension());
  return x;
}

/// Faces of the boundary all of whose nodes have the coordinate `value` along `axis`.
inline std::vector<mechanics::Face> faces_at(const mechanics::Mesh& mesh, int axis, double value) {
  std::vector<mechanics::Face> found;
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh))
    if (std::all_of(face.nodes.begin(), face.nodes.end(), [&](mechanics::Index a) {
          return std::abs(mesh.points[as_size(a)][axis] - value) < 1e-9;
        }))
      found.push_back(face);
  return found;
}

/// Body, pattern, contact surface and term; the tools may be changed before `begin`.
class ContactBench {
public:
  ContactBench(mechanics::Mesh body,
               mechanics::Analysis analysis,
               const mechanics::Material& material,
               std::vector<Tool> all_tools,
               const ContactSettings& settings,
               const std::vector<mechanics::Face>& faces)
      : mesh(std::move(body)), tools(std::move(all_tools)), pattern(mechanics::block_pattern(mesh)),
        bulk(mesh, analysis, material, pattern), surface(mesh, bulk, pattern, faces, settings),
        term(surface, bulk, pattern, tools, reach), x(flat_positions(mesh)) {
    system.tangent.pattern = &pattern;
    system.tangent.values.resize(pattern.n_entries());
    system.residual.resize(static_cast<std::size_t>(pattern.n_dofs()));
    const std::size_t n_extra = drive_unknowns(tools).size();
    bulk_system.tangent = system.tangent;
    bulk_system.residual = system.residual;
    system.borders.resize(n_extra);
    for (mechanics::Border& border : system.borders) {
      border.column.resize(x.size());
      border.row.resize(x.size());
      border.corner.resize(n_extra);
    }
    x.resize(x.size() + n_extra, 0.0);
    velocity.resize(x.size(), 0.0);
    system.residual.resize(x.size());
    term.start(x, 0.0);
  }

  /// Residual and tangent of contact at a trial, with the material in the state of that trial.
  const mechanics::System& assemble(const std::vector<double>& trial, double time) {
    bulk_system.clear();
    system.clear();
    ok = bulk.assemble({time_old, time, x, trial}, bulk_system).has_value() &&
         term.assemble({time_old, time, x, trial, softening}, system).has_value();
    return system;
  }
  /// Assembles a trial and makes it the committed state; keeps the books of what the forces of the
  /// nodes do on their way.
  void commit(const std::vector<double>& trial, double time) {
    term.predict(gone_on(time));
    assemble(trial, time);
    bulk.commit({time_old, time, x, trial});
    term.commit({time_old, time, x, trial});
    const auto as_vector = [&](const std::vector<double>& v) {
      return Eigen::Map<const Eigen::VectorXd>(v.data(), pattern.n_dofs());
    };
    entered -= 0.5 * (last_force + force()).dot(as_vector(trial) - as_vector(x));
    last_force = force();
    for (std::size_t i = 0; i < x.size(); ++i)
      velocity[i] = (trial[i] - x[i]) / (time - time_old);
    x = trial;
    time_old = time;
  }
  /// Where all would be at a time if it went on as in the last increment.
  [[nodiscard]] std::vector<double> gone_on(double time) const {
    std::vector<double> later = x;
    for (std::size_t i = 0; i < x.size(); ++i)
      later[i] += (time - time_old) * velocity[i];
    return later;
  }
  /// Dense copy of the tangent.
  [[nodiscard]] Eigen::MatrixXd tangent() const {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(pattern.n_dofs(), pattern.n_dofs());
    for (mechanics::Index i = 0; i < pattern.n_dofs(); ++i)
      for (mechanics::Index k = pattern.row_start[as_size(i)];
           k < pattern.row_start[as_size(i) + 1]; ++k)
        K(i, pattern.columns[as_size(k)]) = system.tangent.values[as_size(k)];
    return K;
  }
  /// Force on the nodes.
  [[nodiscard]] Eigen::VectorXd force() const {
    return -Eigen::Map<const Eigen::VectorXd>(system.residual.data(), pattern.n_dofs());
  }

  static constexpr double reach = 100.0;
  mechanics::Mesh mesh;
  std::vector<Tool> tools;
  mechanics::BlockPattern pattern;
  mechanics::Bulk bulk;
  ContactSurface surface;
  ContactTerm term;
  std::vector<double> x;
  std::vector<double> velocity; ///< of the last committed increment
  mechanics::System system;
  mechanics::System bulk_system;
  Eigen::VectorXd last_force = Eigen::VectorXd::Zero(pattern.n_dofs()); ///< committed [N]
  double entered = 0.0; ///< work of the nodes against tools that stand [N mm]
  double time_old = 0.0;
  mechanics::Softening softening{}; ///< of what is assembled
  bool ok = false;
};

/// A tool that stands still.
inline Tool still_tool(geometry::SurfacePtr surface, Friction friction) {
  Tool tool;
  tool.name = "tool";
  tool.surface = std::move(surface);
  tool.friction = std::move(friction);
  return tool;
}

inline std::vector<Tool> one_tool(Tool tool) {
  std::vector<Tool> tools;
  tools.push_back(std::move(tool));
  return tools;
}

/// Steel, elastic below 700 MPa.
inline mechanics::Material bench_material() {
  return {{200e3, 0.3}, mechanics::Linear{700.0, 300.0}};
}

/// A box of 2 x 1 (x 1) elements on y = 0, off the axis; in space its thickness is 1.
inline mechanics::Mesh bench_mesh(const BodyKind& body) {
  const std::array<int, 3> cells{2, 1, 1};
  return mechanics::box_mesh({body.kind, Vec3(1, 0, 0), Vec3(3, 1, 1), cells, {1, 1, 1}});
}

} // namespace billet::contact
