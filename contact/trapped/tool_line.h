// The line along which a tool cuts the plane of a scene, and the ways along it.

#pragma once

#include "geometry/motion.h"
#include "geometry/rigid_surface.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace billet::contact {

/// A plane of symmetry or the axis of revolution, which closes a pocket as a tool does.
struct SymmetryLine {
  int component = 0; ///< of the coordinate that is constant
  double at = 0.0;   ///< [mm]
};

/// A place on a tool's line.
struct LinePlace {
  std::size_t piece = 0;
  double share = 0.0;        ///< of the piece, from its beginning
  Vec3 point = Vec3::Zero(); ///< in space [mm]
  double distance = 0.0;     ///< of what was asked for from it [mm]
};

class ToolLine {
public:
  /// @param window  that holds what it is needed for, in space [mm]
  ToolLine(const geometry::RigidSurface& surface, const geometry::Pose& pose, const Box& window);

  [[nodiscard]] bool empty() const { return lines_.empty(); }
  /// The place next to a point. @pre not empty
  [[nodiscard]] LinePlace nearest(const Vec3& point) const;
  /// Points from one place to another, both included; none: they are not on one line.
  ///
  /// @param forward  which way round
  [[nodiscard]] std::optional<std::vector<Vec3>>
  way(const LinePlace& from, const LinePlace& to, bool forward) const;
  /// Points from a place to where the line comes to a line of symmetry; none: it does not.
  [[nodiscard]] std::optional<std::vector<Vec3>>
  way(const LinePlace& from, const SymmetryLine& to, bool forward) const;

private:
  /// The piece that follows; -1: none.
  [[nodiscard]] std::int32_t after(std::size_t piece, bool forward) const;

  std::vector<Vec3> points_; ///< in space [mm]
  std::vector<std::array<std::int32_t, 2>> lines_;
  std::vector<std::int32_t> next_, previous_; ///< of the pieces; -1: none
  double tolerance_ = 0.0;                    ///< of coordinates [mm]
};

} // namespace billet::contact
