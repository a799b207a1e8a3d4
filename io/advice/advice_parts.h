// The parts of `scene_advice`; a detail of io/advice.

#pragma once

#include "io/advice/nominal_flow.h"
#include "io/advice/scene_advice.h"

#include <optional>
#include <vector>

namespace billet::io {

/// A solid of revolution or of equal sections that a scene of the plane would show; none: it is
/// neither.
struct PlaneScene {
  Advice advice;
  int axis; ///< of revolution, or along which all sections are equal
};
[[nodiscard]] std::optional<PlaneScene> plane_scene(const Case& content,
                                                    const process::Scene& scene);

/// A plane through the middle of the part about which the whole scene is symmetric.
///
/// @param axis  normal to the plane
[[nodiscard]] std::optional<Advice>
mirror_advice(const Case& content, const process::Scene& scene, int axis);

/// Tools that the scene can do without.
[[nodiscard]] std::vector<Advice> tool_advice(const Case& content, const process::Scene& scene);

/// Heat, rate, inertia and the pressure on the dies.
[[nodiscard]] std::vector<Advice>
physics_advice(const Case& content, const process::Scene& scene, const NominalFlow& flow);

/// A part so slender that it buckles and touches itself.
[[nodiscard]] std::optional<Advice>
buckling_advice(const Case& content, const process::Scene& scene, const NominalFlow& flow);

} // namespace billet::io
