// The billet benchmark with remeshing, for tests of what a new mesh keeps and when it comes.

#pragma once

#include "tests/support/contact_scenes.h"

#include <utility>

namespace billet::process {

constexpr double billet_height = 15.0; ///< of half of it [mm]

inline RemeshSettings every(double interval) {
  RemeshSettings settings;
  settings.interval = interval;
  return settings;
}

/// The billet benchmark's half model (VALIDATION FRM-06) with n x n elements.
inline Upsetting
billet(ElementKind kind, int n, double reduction, const contact::Friction& friction) {
  Upsetting u;
  u.mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), Vec3(10, billet_height, 0), {n, n, 1}, {1, 1, 1}});
  u.friction = friction;
  u.reduction = reduction;
  return u;
}

inline Scene remeshed(Upsetting u, const RemeshSettings& settings) {
  Scene scene = upsetting_scene(std::move(u));
  scene.remesh = settings;
  return scene;
}

} // namespace billet::process
