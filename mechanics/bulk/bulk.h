// The workpiece's own resistance: all elements of one material, with their history.
//
// Pieces of elements that have a node in common are assembled one after another, always in the same
// order: sums are the same to the bit for any number of threads. Theory: docs/theory/mechanics.md.

#pragma once

#include "mechanics/bulk/element_kernel.h"
#include "mechanics/equilibrium/force_term.h"
#include "mechanics/linear/sparse_matrix.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/mesh/mesh.h"

#include <span>
#include <vector>

namespace billet::mechanics {

/// Internal forces and the history of every integration point.
class Bulk final : public ForceTerm {
public:
  /// @pre mesh and pattern outlive the term; the mesh has no inverted element
  Bulk(const Mesh& mesh, Analysis analysis, Material material, const BlockPattern& pattern);

  [[nodiscard]] Outcome<Assembled> assemble(const Trial& trial, System& system) override;
  void commit(const Trial& trial) override;

  /// Starts from given states: as reference volumes those that the elastic ratios of volume
  /// sqrt(det b_e) ask for. (M.40)
  ///
  /// @param x             where the nodes are, shape (n_dofs) or longer [mm]
  /// @param states        shape (n_elements, points)
  /// @param temperatures  shape (n_elements, points) [degC]; empty: the material's
  /// @param plastic_work  done so far [N mm]
  void adopt(std::span<const double> x,
             std::vector<PointState> states,
             std::vector<double> temperatures,
             double plastic_work);

  /// Scales the reference volumes to a sum: the mass of the part, whatever a new mesh lies off by.
  void keep_volume(double sum);
  /// Sum of the reference volumes [mm^3].
  [[nodiscard]] double reference_volume() const;

  [[nodiscard]] const Material& material() const { return material_; }
  [[nodiscard]] Analysis analysis() const { return analysis_; }
  /// Points an element.
  [[nodiscard]] int points() const { return points_; }
  /// Committed states, shape (n_elements, points).
  [[nodiscard]] std::span<const PointState> states() const { return states_; }
  /// Von Mises stress and flow stress of an integration point in the last assembled trial; what
  /// they owe to the displacements of its element's nodes. (F.21)
  [[nodiscard]] MisesStress trial_stress(std::size_t point) const {
    return mises_stress(material_, trial_states_[point], states_[point].plastic_strain, trial_dt_,
                        temperature(point));
  }
  /// Flow stress of an integration point in the last assembled trial [MPa].
  [[nodiscard]] double trial_flow_stress(std::size_t point) const {
    return follows_rate(material_.flow)
               ? trial_stress(point).flow_stress
               : yield_stress(material_.flow,
                              {trial_states_[point].plastic_strain, 0.0, temperature(point)});
  }
  /// Committed temperatures, shape (n_elements, points) [degC]; empty: nothing heats the metal.
  [[nodiscard]] std::span<const double> temperatures() const { return temperatures_; }
  /// Committed temperature of an integration point [degC].
  [[nodiscard]] double temperature(std::size_t point) const {
    return temperatures_.empty() ? material_.temperature : temperatures_[point];
  }
  /// Nodes of the element that an integration point lies in.
  [[nodiscard]] std::span<const Index> nodes_around(std::size_t point) const {
    return mesh_->cell(static_cast<Index>(point) / points_);
  }
  [[nodiscard]] ElementKind kind() const { return mesh_->kind; }
  /// Reference volumes, shape (n_elements, points) [mm^3].
  [[nodiscard]] std::span<const double> volumes() const { return volumes_; }
  /// Time of all assemblies [s].
  [[nodiscard]] double assembly_time() const { return assembly_time_; }
  /// Largest plastic strain increment of the last trial [-].
  [[nodiscard]] double largest_plastic_increment() const { return largest_plastic_increment_; }
  /// Plastic work of all commits [N mm].
  [[nodiscard]] double plastic_work() const { return plastic_work_; }
  /// [N mm]
  struct ElasticEnergy {
    double shape = 0.0;  ///< of deviatoric strain
    double volume = 0.0; ///< of pressure
    [[nodiscard]] double sum() const { return shape + volume; }
  };
  /// Elastic energy of shape that each point of the committed states stands for,
  /// shape (n_elements, points) [N mm].
  [[nodiscard]] std::vector<double> shape_energies() const;
  /// Of the committed states.
  [[nodiscard]] ElasticEnergy elastic_energy(std::span<const double> x) const {
    return elastic_energy(x, shape_energies_);
  }
  /// Of the last assembled trial.
  [[nodiscard]] ElasticEnergy trial_elastic_energy(std::span<const double> x) const {
    return elastic_energy(x, trial_shape_energies_);
  }
  /// Plastic work of the last assembled trial since the committed states [N mm].
  [[nodiscard]] double trial_plastic_work() const;
  /// Cauchy stress at every point of the committed states, shape (n_elements, points) [MPa].
  [[nodiscard]] std::vector<Mat3> stresses(std::span<const double> x) const;
  /// Current volume [mm^3].
  [[nodiscard]] double volume(std::span<const double> x) const;

  template <class Archive> void fields(Archive& archive) {
    archive(volumes_, states_, trial_states_, temperatures_, shape_energies_, trial_shape_energies_,
            trial_dt_, increments_, largest_plastic_increment_, plastic_work_);
  }

private:
  struct Scratch;
  /// Volumes of the points, shape (n_elements, points) [mm^3].
  [[nodiscard]] std::vector<double> volumes_at(std::span<const double> x) const;
  /// Adds forces and tangents of elements side by side, if they are good.
  ElementStatus add_elements(std::span<const Index> elements,
                             const Trial& trial,
                             System& system,
                             Scratch& scratch);
  [[nodiscard]] ElasticEnergy elastic_energy(std::span<const double> x,
                                             std::span<const double> shape_energies) const;
  /// Of a point in the last assembled trial, per reference volume [MPa].
  [[nodiscard]] double trial_plastic_work(std::size_t point) const;

  const Mesh* mesh_;
  const BlockPattern* pattern_;
  Analysis analysis_;
  Material material_;
  int points_;
  ElementKernel kernel_;
  Scatter scatter_;
  std::vector<double> volumes_;
  std::vector<PointState> states_;
  std::vector<PointState> trial_states_;
  std::vector<double> temperatures_;   ///< of the points; empty: isothermal
  std::vector<double> shape_energies_; ///< elastic, per reference volume, of the states [MPa]
  std::vector<double> trial_shape_energies_;
  double trial_dt_ = 0.0;          ///< length of the increment of the last trial
  std::vector<double> increments_; ///< largest plastic increment of each element
  double largest_plastic_increment_ = 0.0;
  double plastic_work_ = 0.0;
  double assembly_time_ = 0.0;
};

/// Positions of a group's nodes, gathered; shape (nodes, dim).
void gather(std::span<const double> x, std::span<const Index> nodes, int dim, double* out);

} // namespace billet::mechanics
