// How deep tools lie in the workpiece where they are narrower than its faces.
//
// The bound of penetration asks how deep faces lie in a tool (C.13). A needle has no room for a
// face, and once it is inside of the part no face lies in it at all. So the balls that mark where a
// tool is narrow (G.60) are looked for in the part: how deep they lie in it, at the end of an
// increment, and whether they enter it on the way.
//
// Units   mm. Theory: docs/theory/process.md (P.40), (P.41).

#pragma once

#include "contact/term/contact_term.h"
#include "contact/tools/tool.h"
#include "geometry/inner_ball.h"
#include "mechanics/mesh/mesh.h"

#include <optional>
#include <span>
#include <vector>

namespace billet::process {

using mechanics::Index;

class PartDepth;

/// Share of the parent element that a tool may lie in the part without bearing on it there.
inline constexpr double deepest_unfelt = 0.1;

/// A narrow part of a tool that lies in the workpiece.
struct DeepTool {
  double depth = 0.0; ///< of its deepest point below the faces [mm]
  double share = 0.0; ///< of the parent element of the nearest face [-]
  std::size_t tool = 0;
  Vec3 place = Vec3::Zero(); ///< in space [mm]
  Index face = -1;           ///< the nearest candidate face
  double radius = 0.0;       ///< of the tool there; 0: a corner or an edge [mm]
};

class NarrowTools {
public:
  /// @param x  positions of the nodes, shape (n_dofs) [mm]
  /// @pre mesh, tools and surface outlive it; the mesh stays the same
  NarrowTools(const mechanics::Mesh& mesh,
              std::span<const contact::Tool> tools,
              const contact::ContactSurface& surface,
              std::span<const double> x);

  /// The deepest, relative to the parent elements, at the end of a trial, of the tools that act.
  ///
  /// @param faces  how deep faces lie in tools, relative to the parent element: where they hardly
  ///               do only slender parts of tools can be deep in the part [-]
  [[nodiscard]] DeepTool
  deepest(const contact::ContactTerm& contact, const mechanics::Trial& trial, double faces) const;

  /// A slender part that is deeper than `deepest_unfelt` somewhere on the way of a trial, and is
  /// not from the start; none.
  [[nodiscard]] std::optional<DeepTool> met_on_the_way(const contact::ContactTerm& contact,
                                                       const mechanics::Trial& trial) const;

  /// Length of a face when the mesh was new, from corner to corner [mm].
  [[nodiscard]] double length(Index face) const { return lengths_[static_cast<std::size_t>(face)]; }

private:
  /// A narrow part of a tool.
  struct Part {
    geometry::InnerBall ball; ///< tool frame
    bool slender;             ///< a face that it enters hardly lies in it
  };
  class Way;

  [[nodiscard]] std::vector<Part> parts_of(const geometry::RigidSurface& tool,
                                           const Box& window) const;
  /// @param window   where the workpiece is and goes, in the tool's frame
  /// @param endless  room for those of a large or endless tool
  [[nodiscard]] std::span<const Part>
  parts(std::size_t tool, const Box& window, std::vector<Part>& endless) const;
  [[nodiscard]] bool none() const;
  /// How deep a narrow part lies in the workpiece; depth 0: hardly, or not at all.
  [[nodiscard]] DeepTool
  in_part(PartDepth& part, const Part& narrow, const geometry::Pose& pose) const;

  const mechanics::Mesh* mesh_;
  std::span<const contact::Tool> tools_;
  const contact::ContactSurface* surface_;
  std::vector<double> lengths_; ///< of the faces when the mesh was new [mm]
  double width_ = 0.0;          ///< of the longest [mm]
  double thinnest_;             ///< least depth of a face's parent element [mm]
  std::vector<char> endless_;   ///< tools that are looked at where the part is, a flag each
  std::vector<std::vector<Part>> parts_; ///< of the others
};

} // namespace billet::process
