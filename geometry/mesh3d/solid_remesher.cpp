#include "geometry/mesh3d/solid_remesher.h"

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/base/index.h"
#include "geometry/curved/boundary_surface.h"
#include "geometry/mesh3d/patch_mesher.h"
#include "geometry/mesh3d/solid_contraction.h"
#include "geometry/mesh3d/solid_shell.h"
#include "geometry/mesh3d/wall_widths.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/repair/mesh_parts.h"
#include "geometry/repair/self_intersection.h"
#include "geometry/size_field.h"
#include "geometry/triangles/triangle_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace billet::geometry {

namespace {

constexpr double most_tetrahedra = 2e5;

/// Nodes are moved until tetrahedra are as good as this (`shape_quality`).
constexpr double wanted_quality = 0.4;
/// Bent edges are drawn to their chords until tetrahedra are as good as this, bends included.
constexpr double straight_enough = 0.3;
/// A mesh whose faces are at these angles and whose tetrahedra are as good is taken at once, ...
constexpr double good_angle = 10.0 * degree;
constexpr double good_quality = 0.12;
/// ... and one with less than this angle is not taken at all.
constexpr double least_angle = 2.0 * degree;

/// A mesh that is not good is made again with sizes smaller by this factor where it is poor, or
/// where its boundary touches itself, so many times in all.
constexpr double finer = 0.7;
constexpr double finer_at_flaws = 0.4;
constexpr int most_attempts = 4;

/// Rounds of drawing bent edges to their chords; half of the bend is left by each.
constexpr int most_straightenings = 8;

/// A straight mesh encloses the volume of the old triangles to this share, or something is missing.
constexpr double volume_share = 0.1;

[[noreturn]] void refuse(const std::string& what, const Vec3& x) {
  throw Error(Fault::geometry, "",
              fmt::format("{} near ({:.6g}, {:.6g}, {:.6g})", what, x.x(), x.y(), x.z()));
}

void require_sound(const SolidSizes& sizes) {
  const bool sound = sizes.min > 0.0 && sizes.max >= sizes.min && std::isfinite(sizes.max) &&
                     sizes.turn > 0.0 && sizes.growth > 0.0 && sizes.across > 0.0;
  if (!sound)
    throw Error(Fault::geometry, "",
                fmt::format("sizes of a mesh from {} to {}, turn {}, growth {}, {} across",
                            sizes.min, sizes.max, sizes.turn, sizes.growth, sizes.across),
                "give 0 < min <= max and positive values");
}

void require_sound(const SolidBoundary& boundary) {
  const std::size_t n = boundary.mesh.triangles.size();
  if (n == 0 || boundary.part.size() != n || boundary.hold.size() != n ||
      boundary.keep.size() != boundary.mesh.points.size())
    throw Error(Fault::geometry, "", "the boundary of the body lacks triangles or their data");
  for (const Vec3& x : boundary.mesh.points)
    if (!x.allFinite())
      throw Error(Fault::geometry, "", "a node of the boundary is not finite");
  const MeshHealth state = health(boundary.mesh);
  if (state.degenerate_at)
    refuse("a face of the boundary has no area", *state.degenerate_at);
  if (state.non_manifold_at)
    refuse("more than two faces of the boundary meet", *state.non_manifold_at);
  if (state.non_manifold_vertex_at)
    refuse("the boundary touches itself", *state.non_manifold_vertex_at);
  if (state.border_at)
    refuse("the boundary is open", *state.border_at);
  if (!state.closed() || state.inside_out())
    throw Error(Fault::geometry, "", "the boundary is turned inside out");
  const SelfIntersections cuts = self_intersections(boundary.mesh, parts_of(boundary.mesh), 0.0);
  if (cuts.cut_at)
    refuse("the boundary cuts itself", *cuts.cut_at);
  if (cuts.overlap_at)
    refuse("pieces of the part overlap", *cuts.overlap_at);
}

PatchedSurface patched(const BoundarySurface& surface) {
  const FeatureLines& lines = surface.lines();
  const std::vector<Vec3>& points = surface.boundary().mesh.points;
  PatchedSurface result{surface.boundary().mesh, lines.patch, {}, {}};
  for (std::size_t i = 0; i < lines.chains.size(); ++i) {
    FeatureLine& line = result.lines.emplace_back();
    line.patches = lines.patches[i];
    line.points.push_back(points[idx(lines.chains[i].front().ends[0])]);
    for (const LinePiece& piece : lines.chains[i])
      line.points.push_back(points[idx(piece.ends[1])]);
  }
  for (const std::int32_t point : lines.lone_corners)
    result.corners.push_back(points[idx(point)]);
  return result;
}

/// Refinement does not end on two sheets of the surface before its edges are as short as the sheets
/// are apart: a lap that closes is reported at once.
void require_room(const std::vector<WallWidth>& walls) {
  constexpr double tetrahedra_a_square = 4.0; // or more, on a surface of that area
  double needed = 0.0;
  for (const WallWidth& wall : walls)
    needed += tetrahedra_a_square * wall.area / (wall.width * wall.width);
  if (needed < most_tetrahedra)
    return;
  const WallWidth& thinnest = *std::min_element(
      walls.begin(), walls.end(), [](const auto& a, const auto& b) { return a.width < b.width; });
  refuse(fmt::format("a wall or a gap of {:.3g} mm is too thin to be meshed", thinnest.width),
         thinnest.at);
}

/// What is asked for along the boundary by its curvature, by thin places and by the caller. (G.45)
std::vector<SpaceSizeSample> size_samples(const BoundarySurface& surface,
                                          const std::vector<WallWidth>& walls,
                                          const SolidSizes& sizes) {
  std::vector<SpaceSizeSample> samples;
  const TriangleMesh& mesh = surface.boundary().mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 middle = (mesh.points[idx(a)] + mesh.points[idx(b)] + mesh.points[idx(c)]) / 3.0;
    double size = sizes.max;
    if (sizes.wanted)
      size = std::min(size, sizes.wanted(middle));
    const double curvature = surface.curvature(static_cast<std::int32_t>(t));
    if (curvature * size > sizes.turn)
      size = sizes.turn / curvature;
    samples.push_back({middle, std::max(size, sizes.min)});
  }
  for (const WallWidth& wall : walls)
    samples.push_back({wall.at, std::max(wall.width / sizes.across, sizes.min)});
  return samples;
}

double enclosed(const TriangleMesh& mesh) { return health(mesh).volume; }

/// Tetrahedra beyond which refinement is taken to have no end: several times as many as the sizes
/// inside and along the boundary let expect.
double tetrahedra_allowed(const SolidBoundary& boundary, const SpaceSizeField& size, double max) {
  constexpr double a_cube = 6.0 * std::numbers::sqrt2, a_square = 8.0, times = 3.0;
  const TriangleMesh& mesh = boundary.mesh;
  double expected = a_cube * enclosed(mesh) / (max * max * max);
  for (const auto& triangle : mesh.triangles) {
    const double h = size(
        (corner(mesh, triangle, 0) + corner(mesh, triangle, 1) + corner(mesh, triangle, 2)) / 3.0);
    expected += a_square * 0.5 * doubled_area(mesh, triangle).norm() / (h * h);
  }
  return std::min(times * expected, most_tetrahedra);
}

/// One mesh, with what speaks against it.
struct Attempt {
  std::unique_ptr<SolidShell> shell;
  double quality = -1.0;
  std::string flaw;            ///< empty: it may be taken
  std::vector<Vec3> poor = {}; ///< where it should be finer; empty: it is good
  double share = finer;        ///< of the sizes there
};

bool is_better(const Attempt& a, const Attempt& b) {
  return a.flaw.empty() == b.flaw.empty() ? a.quality > b.quality : a.flaw.empty();
}

Attempt attempt(const BoundarySurface& surface,
                const SpaceSizeField& size,
                double most,
                double volume,
                const SnapSolid& snap) {
  Attempt made;
  const SpaceSize size_at = [&](const Vec3& x) { return size(x); };
  const PatchedSurface patches = patched(surface);
  PatchedSolid solid = mesh_patches(patches, size_at, most);
  tidy(solid, patches.corners, size_at, wanted_quality);
  made.shell = std::make_unique<SolidShell>(surface, std::move(solid));
  SolidShell& shell = *made.shell;
  if (!shell.flaws().empty())
    return {std::move(made.shell), -1.0, "the new boundary touches itself", shell.flaws(),
            finer_at_flaws};
  const double old_volume = enclosed(surface.boundary().mesh);
  if (std::abs(shell.volume() - old_volume) > volume_share * old_volume)
    return {std::move(made.shell), -1.0, "a thin place was lost", surface.boundary().mesh.points};
  shell.slide(wanted_quality);
  if (snap)
    shell.snap(snap);
  shell.restore_volume(volume);
  shell.smooth(wanted_quality);
  for (int round = 0; round < most_straightenings && shell.straighten(straight_enough); ++round)
    shell.restore_volume(volume);
  made.quality = shell.quality();
  made.poor = shell.poor_places(good_angle, good_quality);
  if (shell.smallest_angle() < least_angle || shell.smallest_jacobian() <= 0.0)
    made.flaw = "no sound tetrahedra are found";
  return made;
}

} // namespace

RemeshedSolid remesh_solid(const SolidBoundary& boundary,
                           const SolidSizes& sizes,
                           double volume,
                           const SnapSolid& snap) {
  require_sound(sizes);
  require_sound(boundary);
  const BoundarySurface surface(boundary, sizes.max);
  const std::vector<WallWidth> walls = wall_widths(boundary.mesh, sizes.across * sizes.max);
  require_room(walls);
  std::vector<SpaceSizeSample> samples = size_samples(surface, walls, sizes);
  const double most = tetrahedra_allowed(boundary, {samples, sizes.max, sizes.growth}, sizes.max);
  Attempt best;
  for (int i = 0; i < most_attempts; ++i) {
    const SpaceSizeField field(samples, sizes.max, sizes.growth);
    Attempt next;
    try {
      next = attempt(surface, field, most, volume, snap);
    } catch (const Error&) {
      if (best.shell == nullptr)
        throw;
      break; // finer yet would be no better
    }
    for (const Vec3& x : next.poor)
      samples.push_back({x, next.share * field(x)});
    if (best.shell == nullptr || is_better(next, best))
      best = std::move(next);
    if (best.flaw.empty() && best.poor.empty())
      break;
  }
  if (!best.flaw.empty())
    refuse(best.flaw, best.poor.front());
  return std::move(*best.shell).result();
}

} // namespace billet::geometry
