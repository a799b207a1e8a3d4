// What Newton's method sums: forces on the nodes and their derivatives.
//
// The bulk of the workpiece, loads, contact and the stabilization of free bodies are all force
// terms. The residual is the sum of internal minus external forces; at equilibrium it vanishes at
// every unknown that is not prescribed. A term never changes its committed state while it
// assembles, so any trial can be repeated to the bit.
//
// Units   forces N (plane strain: N per unit thickness; axisymmetric: of the full turn).

#pragma once

#include "geometry/base/outcome.h"
#include "geometry/base/pieces.h"
#include "mechanics/equilibrium/analysis.h"
#include "mechanics/linear/sparse_matrix.h"

#include <algorithm>
#include <span>
#include <vector>

namespace billet::mechanics {

/// What contact is softer by on the way to a solution. (N.10)
struct Softening {
  double slip = 1.0;        ///< of what resists slip [-]
  double penetration = 1.0; ///< of what resists more penetration than there was [-]
};

/// The configuration being tried and the committed one it starts from.
struct Trial {
  double time_old;               ///< [s]
  double time;                   ///< [s]
  std::span<const double> x_old; ///< committed positions, shape (n_dofs + n_extra) [mm]
  std::span<const double> x;     ///< positions tried, shape (n_dofs + n_extra) [mm]
  Softening softening{};         ///< on the way to a solution
  bool first_guess = false;      ///< may be too coarse to tell which contacts have parted
};

/// Row and column of the tangent for an unknown that belongs to no node: a tool's free degree of
/// freedom. They are kept outside of the matrix, which they would fill.
struct Border {
  std::vector<double> column; ///< d residual / d unknown, shape (n_dofs) [N/mm]
  std::vector<double> row;    ///< d residual of the unknown / d x, shape (n_dofs) [N/mm]
  std::vector<double> corner; ///< the same by all such unknowns, shape (n_extra) [N/mm]
};

/// Residual and tangent over the mesh's pattern.
struct System {
  SparseMatrix tangent;
  std::vector<double> residual;      ///< shape (n_dofs + n_extra) [N]
  bool symmetric = true;             ///< every term said that its tangent is symmetric
  std::vector<Border> borders{};     ///< shape (n_extra)
  std::vector<Coupling> couplings{}; ///< parts of the tangent outside of its pattern
  int contact_changes = 0; ///< contact points that opened, closed, stuck or slid since the last
                           ///< trial: the iteration is not smooth where there are any

  bool kept_contacts = false; ///< contacts are in it that have parted: see Trial
  bool forces_only = false;   ///< the tangent is not wanted: terms may leave it out

  void clear() {
    if (!forces_only)
      for_pieces(tangent.values.size(), std::size_t{1} << 16,
                 [&](std::size_t begin, std::size_t end) {
                   std::fill_n(tangent.values.data() + begin, end - begin, 0.0);
                 });
    tangent.unsymmetric.clear();
    couplings.clear();
    std::fill(residual.begin(), residual.end(), 0.0);
    for (Border& border : borders)
      for (std::vector<double>* part : {&border.column, &border.row, &border.corner})
        std::fill(part->begin(), part->end(), 0.0);
    symmetric = true;
    kept_contacts = false;
    contact_changes = 0;
  }
};

/// Passed through by `assemble` when all went well.
struct Assembled {};

/// One contribution to equilibrium.
class ForceTerm {
public:
  virtual ~ForceTerm() = default;

  /// Adds residual and exact tangent at a trial. A failure (inverted element, return map) ends the
  /// trial; nothing that matters later has changed.
  [[nodiscard]] virtual Outcome<Assembled> assemble(const Trial& trial, System& system) = 0;
  /// Whether its forces are nonsmooth, and cost little compared with those of the bulk: a line
  /// search asks it alone.
  [[nodiscard]] virtual bool nonsmooth() const { return false; }
  /// The last assembled trial becomes the committed state.
  virtual void commit(const Trial& trial) = 0;

protected:
  ForceTerm() = default;
  ForceTerm(const ForceTerm&) = default;
  ForceTerm& operator=(const ForceTerm&) = default;
};

} // namespace billet::mechanics
