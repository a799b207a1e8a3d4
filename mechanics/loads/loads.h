// Loads other than contact: pressure that follows the surface, dead nodal loads.
//
// Theory: docs/theory/mechanics.md (M.15), (M.16).

#pragma once

#include "geometry/base/time_function.h"
#include "mechanics/equilibrium/force_term.h"
#include "mechanics/linear/sparse_matrix.h"
#include "mechanics/mesh/mesh.h"

#include <memory>
#include <span>
#include <vector>

namespace billet::mechanics {

/// A load whose work on the workpiece is counted.
class Load : public ForceTerm {
public:
  /// Work done on the workpiece by all commits [N mm].
  [[nodiscard]] double work() const { return work_; }
  /// Work done in an increment, by the trapezoidal rule [N mm].
  [[nodiscard]] double work_in(const Trial& trial) const;
  /// Norm of its nodal forces [N].
  [[nodiscard]] double norm(double time, std::span<const double> x) const;

  void commit(const Trial& trial) final;

  template <class Archive> void fields(Archive& archive) { archive(work_); }

private:
  /// Force of the load on the nodes in a configuration, shape (n_dofs), added to `out` [N].
  virtual void add_force(double time, std::span<const double> x, std::span<double> out) const = 0;

  double work_ = 0.0;
};

/// Pressure on faces, normal to their current position; positive inward [MPa].
[[nodiscard]] std::unique_ptr<Load> make_pressure(const Mesh& mesh,
                                                  Analysis analysis,
                                                  const BlockPattern& pattern,
                                                  const std::vector<Face>& faces,
                                                  TimeFunction pressure);

/// Fixed nodal forces times an amplitude.
[[nodiscard]] std::unique_ptr<Load> make_dead_load(std::vector<double> forces,
                                                   TimeFunction amplitude);

/// Nodal forces of tractions per initial area of faces [N]; shape (n_dofs).
///
/// @param tractions  of each face [MPa]
[[nodiscard]] std::vector<double> traction_forces(const Mesh& mesh,
                                                  Analysis analysis,
                                                  const std::vector<Face>& faces,
                                                  std::span<const Vec3> tractions);

/// The same for one traction on all of them [MPa].
[[nodiscard]] std::vector<double> traction_forces(const Mesh& mesh,
                                                  Analysis analysis,
                                                  const std::vector<Face>& faces,
                                                  const Vec3& traction);

/// Areas of faces; in plane strain lengths, in axisymmetry of the whole turn [mm^2].
///
/// @param x  positions of the nodes, shape (n_dofs) [mm]
[[nodiscard]] std::vector<double> face_areas(const Mesh& mesh,
                                             Analysis analysis,
                                             const std::vector<Face>& faces,
                                             std::span<const double> x);

/// Nodal forces of a body force per initial volume [N]; shape (n_dofs).
[[nodiscard]] std::vector<double>
body_forces(const Mesh& mesh, Analysis analysis, const Vec3& force);

} // namespace billet::mechanics
