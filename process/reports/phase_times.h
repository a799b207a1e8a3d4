// Where the time of a run goes.

#pragma once

namespace billet::process {

/// Time spent by part of the program [s].
struct PhaseTimes {
  double total = 0.0;         ///< from the scene to the end
  double elements = 0.0;      ///< forces and tangents of the workpiece's elements
  double search = 0.0;        ///< contact search
  double contact = 0.0;       ///< laws of the interface, contact elements
  double assembly = 0.0;      ///< clearing the system, norms, other terms
  double analysis = 0.0;      ///< order of the unknowns, symbolic factorization
  double factorization = 0.0; ///< numerical
  double solve = 0.0;         ///< substitutions, iterations around them, constraints
  double certificate = 0.0;   ///< bound of penetration
  double output = 0.0;        ///< observers
  double remeshing = 0.0;     ///< new meshes and transfer, without the equilibrium on them

  /// What is left: preparing the scene, guesses, commits [s].
  [[nodiscard]] double rest() const {
    return total - search - contact - elements - assembly - analysis - factorization - solve -
           certificate - output - remeshing;
  }

  template <class Archive> void fields(Archive& archive) {
    archive(total, elements, search, contact, assembly, analysis, factorization, solve, certificate,
            output, remeshing);
  }
};

} // namespace billet::process
