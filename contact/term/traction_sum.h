// The tractions of all tools at the points of the workpiece, in space, and what they put on its
// nodes.

#pragma once

#include "contact/term/contact_state.h"
#include "mechanics/equilibrium/force_term.h"

#include <span>
#include <vector>

namespace billet::contact {

class TractionSum {
public:
  explicit TractionSum(std::size_t n_points)
      : traction_(n_points), dtraction_(n_points), symmetric_(n_points), touched_(n_points) {}

  void clear();
  /// Adds those of one tool.
  void add(const TrialContact& tool, const geometry::Pose& pose);
  /// Adds forces and their derivatives to the equations of the nodes.
  ///
  /// @param tools  whose sum it is
  void scatter(const ContactModel& model,
               std::span<const ToolContact> tools,
               std::span<const double> x,
               mechanics::System& system) const;

private:
  template <class Shape, class Rule> class FaceEquations;
  /// Whether a tool touches any of a face's points.
  [[nodiscard]] bool touches(std::size_t first, int points) const;

  std::vector<Vec3> traction_;
  std::vector<Mat3> dtraction_;
  std::vector<Mat3> symmetric_; ///< of each derivative, what a symmetric tangent may have of it
  std::vector<char> touched_;
};

} // namespace billet::contact
