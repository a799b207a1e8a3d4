#include "process/remeshing/parted_walls.h"

#include "contact/self/face_place.h"
#include "contact/self/self_search.h"
#include "mechanics/mesh/mesh_edges.h"
#include "process/state/run.h"

#include <algorithm>
#include <map>

namespace billet::process {

namespace {

/// Faces that touch another face of the part, or are nearer to one than a gap.
std::vector<char> walls(const Run& run, double gap) {
  const contact::ContactSurface& surface = *run.model.surface;
  const contact::SelfContactState& state = run.model.self_contact->state();
  std::vector<Vec3> positions(surface.n_points());
  surface.positions(run.positions(), positions);
  std::vector<char> near(idx(surface.n_faces()), 0);
  const auto mark = [&](std::size_t point, Index face) {
    near[point / idx(surface.points())] = 1;
    near[idx(face)] = 1;
  };
  for (std::size_t k = 0; k < state.points.size(); ++k)
    if (state.points[k].closed())
      mark(k, state.points[k].face);
    else if (const contact::SelfFoot foot =
                 contact::find_foot(surface, run.positions(), state.ahead[k], positions[k]);
             foot.face >= 0 && foot.gap < gap)
      mark(k, foot.face);
  return near;
}

/// Outward normals, summed over the walls around each node.
std::map<Index, Vec3> normals_of_walls(const Run& run, double gap) {
  const contact::ContactSurface& surface = *run.model.surface;
  const bool plane = run.mesh().dimension() == 2;
  const Vec2 middle = mechanics::is_simplex(run.mesh().kind) && !plane ? Vec2(1.0 / 3.0, 1.0 / 3.0)
                                                                       : Vec2(0.0, 0.0);
  const std::vector<char> near = walls(run, gap);
  std::map<Index, Vec3> normals;
  for (Index f = 0; f < surface.n_faces(); ++f)
    if (near[idx(f)] != 0) {
      const std::vector<Vec3> nodes = contact::nodes_of_face(surface, run.positions(), f);
      const Vec3 normal =
          contact::FaceFrame(contact::FaceShapes(surface.kind(), middle), nodes, plane).normal();
      for (const Index node : surface.scatter().nodes(f))
        normals.try_emplace(node, Vec3::Zero()).first->second += normal;
    }
  return normals;
}

} // namespace

bool touches_itself(const Run& run) {
  if (!run.model.self_contact)
    return false;
  const auto& points = run.model.self_contact->state().points;
  return std::any_of(points.begin(), points.end(), [](const auto& p) { return p.closed(); });
}

std::vector<double> positions_with_parted_walls(const Run& run, double gap) {
  std::vector<double> x(run.positions().begin(), run.positions().end());
  if (!touches_itself(run))
    return x;
  const int dim = run.mesh().dimension();
  std::vector<char> held(x.size(), 0);
  for (const Support& support : run.part().supports)
    for (const Index node : support.nodes)
      held[idx(node * dim + support.component)] = 1;
  for (const auto& [node, normal] : normals_of_walls(run, gap)) {
    constexpr double none = 1e-3; // at a fold's root normals may cancel
    if (normal.norm() < none)
      continue;
    for (int d = 0; d < dim; ++d)
      if (const std::size_t i = idx(node * dim + d); held[i] == 0)
        x[i] -= 0.5 * gap * normal.normalized()[d];
  }
  return x;
}

} // namespace billet::process
