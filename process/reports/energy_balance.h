// The balance of energy of a run: what went in, and what became of it. (P.6)

#pragma once

#include <algorithm>

namespace billet::process {

/// Energies of the run so far [N mm].
struct EnergyBalance {
  double external = 0.0;       ///< work of tools, supports and loads, and of penalty updates (C.23)
  double elastic = 0.0;        ///< stored in the workpiece
  double plastic = 0.0;        ///< dissipated in it
  double friction = 0.0;       ///< dissipated on its surface
  double contact = 0.0;        ///< stored in the penalties
  double stabilization = 0.0;  ///< lost to the stabilization of free motions
  double remeshing = 0.0;      ///< lost where a state was carried to a new mesh
  double penalty_update = 0.0; ///< of external, what no tool's motion did (C.23)
  double most = 0.0;    ///< that any of the first five has been: springback gives it all back
  double nothing = 0.0; ///< no more than rounding makes of a part at rest

  /// external less the sum of the rest [N mm].
  [[nodiscard]] double missing() const {
    return external - (elastic + plastic + friction + contact + stabilization + remeshing);
  }
  /// The largest of what has been done, stored and dissipated since `before` [N mm].
  [[nodiscard]] double largest_since(const EnergyBalance& before) const;
  /// The largest of the first five so far [N mm].
  [[nodiscard]] double scale() const { return std::max(most, largest_since({})); }
  /// |external - sum of the rest| over that [-].
  [[nodiscard]] double error() const;
  /// That of what has been done since `before` [-].
  [[nodiscard]] double error_since(const EnergyBalance& before) const;

  template <class Archive> void fields(Archive& archive) {
    archive(external, elastic, plastic, friction, contact, stabilization, remeshing, penalty_update,
            most, nothing);
  }
};

} // namespace billet::process
