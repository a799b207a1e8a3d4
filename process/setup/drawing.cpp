#include "process/setup/drawing.h"

#include "geometry/base/box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace billet::process {

namespace {

using geometry::DisplayMesh;

constexpr std::size_t most_facets = 4000; // asked how far a drawing is from its surface
constexpr int cells = 4;                  // a side of a face's grid of samples

/// Where the samples of a face stand: a line, a square of rows, or a triangle of rows that become
/// shorter by one. `cells` lie along each side.
class Grid {
public:
  explicit Grid(std::size_t n_samples)
      : solid_(n_samples > cells + 1), triangle_(solid_ && n_samples < (cells + 1) * (cells + 1)) {}

  [[nodiscard]] bool solid() const { return solid_; }
  [[nodiscard]] bool triangle() const { return triangle_; }
  [[nodiscard]] bool has(int i, int j) const {
    return j <= (solid_ ? cells : 0) && i <= (triangle_ ? cells - j : cells);
  }
  [[nodiscard]] std::int32_t at(int i, int j) const {
    return j * (cells + 1) + i - (triangle_ ? j * (j - 1) / 2 : 0);
  }
  /// Calls `use(i, j)` for each sample.
  template <class Use> void for_each(const Use& use) const {
    for (int j = 0; has(0, j); ++j)
      for (int i = 0; has(i, j); ++i)
        use(i, j);
  }

private:
  bool solid_;
  bool triangle_;
};

void add_cells(const Grid& grid, std::size_t first, DisplayMesh& mesh) {
  const auto at = [&](int i, int j) { return static_cast<std::int32_t>(first) + grid.at(i, j); };
  grid.for_each([&](int i, int j) {
    if (!grid.has(i + 1, j))
      return;
    if (!grid.solid())
      mesh.lines.push_back({at(i, j), at(i + 1, j)});
    else if (grid.triangle())
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
    if (!grid.solid() || !grid.has(i + 1, j + 1))
      return;
    if (grid.triangle()) {
      mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      return;
    }
    mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
    mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
  });
}

/// By how much a sample is off the chord of its neighbours, along rows and columns (and the third
/// direction of a triangle); a quarter of that remains between neighbours, for a parabola half as
/// far apart, and in the middle of a triangle four thirds of what is on its sides.
double sagitta(const Grid& grid, const std::vector<Vec3>& samples) {
  const double halved = grid.triangle() ? 1.0 / 3.0 : 0.25;
  double most = 0.0;
  const auto sample = [&](int i, int j) {
    return samples[static_cast<std::size_t>(grid.at(i, j))];
  };
  const auto look = [&](int i, int j, int right, int up) {
    if (i + 2 * right < 0 || !grid.has(i + 2 * right, j + 2 * up))
      return;
    const Vec3 chord = 0.5 * (sample(i, j) + sample(i + 2 * right, j + 2 * up));
    most = std::max(most, (sample(i + right, j + up) - chord).norm());
  };
  grid.for_each([&](int i, int j) {
    look(i, j, 1, 0);
    look(i, j, 0, 1);
    if (grid.triangle())
      look(i, j, -1, 1);
  });
  return halved * most;
}

} // namespace

DrawnWorkpiece drawn(const contact::ContactSurface& surface, std::span<const double> x) {
  DrawnWorkpiece workpiece;
  for (mechanics::Index f = 0; f < surface.n_faces(); ++f) {
    const std::vector<Vec3> samples = surface.samples(x, f, cells);
    const Grid grid(samples.size());
    add_cells(grid, workpiece.mesh.points.size(), workpiece.mesh);
    workpiece.mesh.points.insert(workpiece.mesh.points.end(), samples.begin(), samples.end());
    workpiece.error = std::max(workpiece.error, sagitta(grid, samples));
  }
  return workpiece;
}

double excess(const geometry::RigidSurface& surface, const DisplayMesh& mesh) {
  const auto point = [&](std::int32_t i) { return mesh.points[static_cast<std::size_t>(i)]; };
  std::vector<Vec3> middles;
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 1 + mesh.triangles.size() / most_facets) {
    const auto& [a, b, c] = mesh.triangles[k];
    for (const Vec3& p : {point(a), point(b), point(c)})
      middles.push_back(0.5 * (point(a) + point(b) + point(c) - p));
  }
  for (const auto& [a, b] : mesh.lines)
    middles.push_back(0.5 * (point(a) + point(b)));
  const Box box = box_of(mesh.points);
  std::vector<geometry::Projection> feet(middles.size());
  double most = 0.0;
  if (box.size() > 0.0)
    surface.project(middles, box.size(), feet);
  for (const geometry::Projection& foot : feet)
    if (foot.found())
      most = std::max(most, foot.gap);
  return most;
}

void keep_within(const Box& window, DisplayMesh& mesh) {
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    Box box;
    for (const std::int32_t corner : triangle)
      box.add(mesh.points[static_cast<std::size_t>(corner)]);
    return !box.overlaps(window, facet_tolerance * window.size());
  });
}

} // namespace billet::process
