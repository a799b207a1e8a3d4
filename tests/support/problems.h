// Whole problems in memory, driven by supports: helpers that fill a process::Scene, and an observer
// that looks on and keeps reports.

#pragma once

#include "geometry/surfaces/analytic_surfaces.h"
#include "mechanics/mesh/mesh_generators.h"
#include "process/loop/process.h"
#include "tests/support/tensors.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace billet::support {

using mechanics::Index;

/// Nodes at which a predicate of the position holds.
inline std::vector<Index> nodes_where(const mechanics::Mesh& mesh,
                                      const std::function<bool(const Vec3&)>& belongs) {
  std::vector<Index> nodes;
  for (Index node = 0; node < mesh.n_points(); ++node)
    if (belongs(mesh.points[static_cast<std::size_t>(node)]))
      nodes.push_back(node);
  return nodes;
}

/// Holds or moves one component of a named set.
inline void support(process::Scene& scene,
                    const std::string& set,
                    int component,
                    TimeFunction displacement = 0.0) {
  scene.part.supports.push_back(
      {scene.part.mesh.node_sets.at(set), component, std::move(displacement)});
}

/// Boundary faces all of whose nodes satisfy a predicate.
inline std::vector<mechanics::Face> faces_where(const mechanics::Mesh& mesh,
                                                const std::function<bool(const Vec3&)>& belongs) {
  std::vector<mechanics::Face> list;
  for (const mechanics::Face& face : mechanics::boundary_faces(mesh)) {
    bool all = true;
    for (const Index node : face.nodes)
      all = all && belongs(mesh.points[static_cast<std::size_t>(node)]);
    if (all)
      list.push_back(face);
  }
  return list;
}

/// Calls a function after each increment and keeps the reports.
class Recorder : public process::Observer {
public:
  using Look = std::function<void(const process::Run&, const process::IncrementReport&)>;
  explicit Recorder(Look look = {}) : look_(std::move(look)) {}

  void incremented(const process::Run& process, const process::IncrementReport& report) override {
    reports.push_back(report);
    if (look_)
      look_(process, report);
  }
  void failed(const process::Run&, const process::PostMortem& post) override {
    reason = post.reason;
    failed_time = post.time;
  }

  std::vector<process::IncrementReport> reports;
  std::string reason;
  double failed_time = 0.0;

private:
  Look look_;
};

/// Runs to the end and fails the test if that is not reached.
inline void run_to_end(process::Process& process, Recorder& recorder) {
  ASSERT_EQ(process.run({&recorder}), process::RunStatus::done) << recorder.reason;
}

/// Displacement of a node since the start.
inline Vec3 displacement(const process::Run& process, Index node) {
  const int dim = process.mesh().dimension();
  Vec3 u = -process.mesh().points[static_cast<std::size_t>(node)];
  for (int i = 0; i < dim; ++i)
    u[i] += process.positions()[static_cast<std::size_t>(node * dim + i)];
  return u;
}

/// A bar of one element of unit length whose end follows a displacement: axis y in the plane
/// (axisymmetric), z in space.
inline process::Scene unit_bar(mechanics::ElementKind kind,
                               const mechanics::Material& material,
                               TimeFunction displacement) {
  process::Scene scene;
  const bool solid = mechanics::dimension(kind) == 3;
  scene.part.analysis = solid ? mechanics::Analysis::solid : mechanics::Analysis::axisymmetric;
  scene.part.mesh = mechanics::box_mesh({.kind = kind});
  support(scene, "x-min", 0);
  support(scene, "y-min", 1);
  if (solid)
    support(scene, "z-min", 2);
  support(scene, solid ? "z-max" : "y-max", solid ? 2 : 1, std::move(displacement));
  scene.material = material;
  scene.tolerance = 1e-10;
  return scene;
}

/// Equal increments of a single stage.
inline void one_stage(process::Scene& scene, double end, int increments) {
  scene.stages.push_back({"stage", end, std::vector<char>(scene.tools.size(), 1), false});
  scene.increments.first = end / increments;
  scene.increments.max = end / increments;
}

} // namespace billet::support
