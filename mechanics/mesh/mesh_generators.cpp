#include "mechanics/mesh/mesh_generators.h"

#include "geometry/base/error.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/simplex_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <utility>

namespace billet::mechanics {

namespace {

[[noreturn]] void refuse(std::string message, std::string remedy = {}) {
  throw Error(Fault::geometry, "", std::move(message), std::move(remedy));
}

/// Refuses meshes whose nodes could not be numbered.
void require_countable(double n_cells, const char* what) {
  // A hexahedron of 20 nodes brings 4 nodes of its own in the interior of a large mesh.
  constexpr double most = std::numeric_limits<Index>::max() / 32.0;
  if (n_cells > most)
    throw Error(Fault::limit, "",
                fmt::format("a {} of {:.3g} cells is too large: at most {:.3g} can be numbered",
                            what, n_cells, most),
                "ask for fewer cells");
}

/// Adds the set of the nodes at which `belongs` holds.
template <class Predicate>
void add_node_set(Mesh& mesh, const std::string& name, const Predicate& belongs) {
  std::vector<Index>& set = mesh.node_sets[name];
  for (Index node = 0; node < mesh.n_points(); ++node)
    if (belongs(mesh.points[static_cast<std::size_t>(node)]))
      set.push_back(node);
}

// --- box -----------------------------------------------------------------------------------------

void require_sound(const BoxDomain& box, int dimension) {
  double n_cells = dimension == 2 ? 2.0 : 6.0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
    const char letter = "xyz"[axis];
    const auto i = static_cast<Eigen::Index>(axis);
    if (box.cells[axis] < 1)
      refuse(fmt::format("a box needs at least 1 cell along {}, not {}", letter, box.cells[axis]));
    const double length = box.high[i] - box.low[i];
    if (!(length > 0.0) || !std::isfinite(length))
      refuse(fmt::format("the box goes from {} = {} to {}", letter, box.low[i], box.high[i]),
             "give the smaller corner first, then the larger one");
    if (!(box.grading[axis] > 0.0) || !std::isfinite(box.grading[axis]))
      refuse(fmt::format("the grading along {} is {}; it must be positive", letter,
                         box.grading[axis]));
    n_cells *= box.cells[axis];
  }
  require_countable(n_cells, "box");
}

/// Ends of the cells along one axis, their lengths in geometric progression.
std::vector<double> divisions(double low, double high, int n, double grading) {
  const double ratio = n > 1 ? std::pow(grading, 1.0 / (n - 1)) : 1.0;
  std::vector<double> ends{0.0};
  double length = 1.0;
  for (int i = 0; i < n; ++i, length *= ratio)
    ends.push_back(ends.back() + length);
  const double sum = ends.back();
  for (double& end : ends)
    end = low + (high - low) * (end / sum);
  ends.back() = high;
  return ends;
}

/// Corner cells of a grid of nx * ny * nz boxes; nz = 0 in the plane.
class Grid {
public:
  Grid(int nx, int ny, int nz) : nx_(nx), ny_(ny), nz_(nz) {}

  [[nodiscard]] Index node(int i, int j, int k) const {
    return i + (nx_ + 1) * (j + (ny_ + 1) * k);
  }

  /// Calls `use` with the 4 or 8 corners of each box, in the order of a quad4 or hex8.
  template <class Use> void for_each_box(const Use& use) const {
    for (int k = 0; k < std::max(nz_, 1); ++k)
      for (int j = 0; j < ny_; ++j)
        for (int i = 0; i < nx_; ++i)
          use(corners(i, j, k));
  }

private:
  [[nodiscard]] std::vector<Index> corners(int i, int j, int k) const {
    std::vector<Index> nodes;
    for (int layer = k; layer <= (nz_ == 0 ? k : k + 1); ++layer)
      nodes.insert(nodes.end(), {node(i, j, layer), node(i + 1, j, layer),
                                 node(i + 1, j + 1, layer), node(i, j + 1, layer)});
    return nodes;
  }

  int nx_, ny_, nz_;
};

/// 0 or 1 along an axis, alternating from both ends: cells are cut from their corners of lowest sum
/// over the axes, so that neighbours mirror each other and every corner of the box is cut through.
int alternation(int i, int n) { return std::min(i, n - i) % 2; }

std::vector<int> grid_ranks(const BoxDomain& box, int dimension) {
  std::vector<int> ranks;
  const int n_layers = dimension == 3 ? box.cells[2] : 0;
  for (int k = 0; k <= n_layers; ++k)
    for (int j = 0; j <= box.cells[1]; ++j)
      for (int i = 0; i <= box.cells[0]; ++i)
        ranks.push_back(alternation(i, box.cells[0]) + alternation(j, box.cells[1]) +
                        alternation(k, n_layers));
  return ranks;
}

std::vector<Vec3> grid_points(const BoxDomain& box, int dimension) {
  std::array<std::vector<double>, 3> ends;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    ends[axis] = axis < static_cast<std::size_t>(dimension)
                     ? divisions(box.low[i], box.high[i], box.cells[axis], box.grading[axis])
                     : std::vector<double>{0.0};
  }
  std::vector<Vec3> points;
  points.reserve(ends[0].size() * ends[1].size() * ends[2].size());
  for (const double z : ends[2])
    for (const double y : ends[1])
      for (const double x : ends[0])
        points.emplace_back(x, y, z);
  return points;
}

/// The mesh of a kind from corner cells: as they are, or with mid-side nodes; simplices by cutting
/// the cells, from the corners of lowest rank.
Mesh mesh_from_corners(ElementKind kind,
                       std::vector<Vec3> points,
                       std::vector<Index> corners,
                       const std::vector<int>& ranks) {
  if (is_simplex(kind))
    corners = cut_into_simplices(dimension(kind), corners, ranks);
  if (is_quadratic(kind))
    return quadratic_mesh(kind, std::move(points), corners);
  return Mesh{
      .kind = kind, .points = std::move(points), .cells = std::move(corners), .node_sets = {}};
}

// --- cylinder ------------------------------------------------------------------------------------

/// The section of a cylinder: a core of 2m x 2m squares (or the part in the sector) with bulged
/// sides, and rings of cells from its outline to the circle. One eighth of the circle has m cells.
class Disc {
public:
  Disc(double radius, int n_radius, int sector)
      : radius_(radius), m_((n_radius + 1) / 2), rings_(n_radius - m_),
        core_(radius * m_ / n_radius), low_x_(sector >= 180 ? -m_ : 0),
        low_y_(sector == 360 ? -m_ : 0), n_around_(2 * m_ * (sector / 90)), closed_(sector == 360) {
    add_core();
    add_rings();
  }

  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  /// Corners of the cells, shape (n, 4).
  [[nodiscard]] const std::vector<Index>& corners() const { return corners_; }
  /// Ranks of the points, alternating along both lines of cells that cross at each (see
  /// `alternation`).
  [[nodiscard]] const std::vector<int>& ranks() const { return ranks_; }

private:
  /// Half the width of the core at the relative distance t from its axis: the corners stand back
  /// so that the three cells that meet there have angles near 120 degrees.
  [[nodiscard]] double half_width(double t) const { return core_ * (1.0 - 0.12 * t * t); }

  [[nodiscard]] Index core_node(int i, int j) const {
    return (i - low_x_) + (m_ - low_x_ + 1) * (j - low_y_);
  }

  void add_core() {
    for (int j = low_y_; j <= m_; ++j)
      for (int i = low_x_; i <= m_; ++i) {
        const double u = static_cast<double>(i) / m_;
        const double v = static_cast<double>(j) / m_;
        points_.emplace_back(u * half_width(v), v * half_width(u), 0.0);
        ranks_.push_back(std::abs(i % 2) + std::abs(j % 2));
      }
    for (int j = low_y_; j < m_; ++j)
      for (int i = low_x_; i < m_; ++i)
        corners_.insert(corners_.end(), {core_node(i, j), core_node(i + 1, j),
                                         core_node(i + 1, j + 1), core_node(i, j + 1)});
  }

  /// Core node on the outline, counted from (m, 0) against the clock.
  [[nodiscard]] Index outline_node(int around) const {
    const int quarter = around / (2 * m_);
    const int step = around % (2 * m_);
    int x = step <= m_ ? m_ : 2 * m_ - step;
    int y = step <= m_ ? step : m_;
    for (int turn = 0; turn < quarter; ++turn)
      x = -std::exchange(y, x);
    return core_node(x, y);
  }

  /// Direction of the same place on the circle; exact on the axes and symmetric.
  [[nodiscard]] Vec3 direction(int around) const {
    const int quarter = around / (2 * m_);
    const int step = around % (2 * m_);
    const double angle = std::acos(-1.0) / 4.0 * std::min(step, 2 * m_ - step) / m_;
    double x = std::cos(angle);
    double y = std::sin(angle);
    if (step > m_)
      std::swap(x, y);
    for (int turn = 0; turn < quarter; ++turn)
      x = -std::exchange(y, x);
    return {x, y, 0.0};
  }

  void add_rings() {
    const int n_places = closed_ ? n_around_ : n_around_ + 1;
    const auto n_core = static_cast<Index>(points_.size());
    for (int ring = 1; ring <= rings_; ++ring)
      for (int around = 0; around < n_places; ++around) {
        const Vec3 inner = points_[static_cast<std::size_t>(outline_node(around))];
        const Vec3 outer = radius_ * direction(around);
        const double t = static_cast<double>(ring) / rings_;
        points_.emplace_back((1.0 - t) * inner + t * outer);
        ranks_.push_back(around % 2 + (m_ + ring) % 2);
      }
    const auto node = [&](int ring, int around) {
      const int place = around % n_places;
      return ring == 0 ? outline_node(place) : n_core + (ring - 1) * n_places + place;
    };
    for (int ring = 0; ring < rings_; ++ring)
      for (int around = 0; around < n_around_; ++around)
        corners_.insert(corners_.end(), {node(ring, around), node(ring + 1, around),
                                         node(ring + 1, around + 1), node(ring, around + 1)});
  }

  double radius_;
  int m_, rings_;
  double core_;
  int low_x_, low_y_, n_around_;
  bool closed_;
  std::vector<Vec3> points_;
  std::vector<Index> corners_;
  std::vector<int> ranks_;
};

void require_sound(const CylinderDomain& cylinder) {
  if (dimension(cylinder.kind) != 3)
    refuse(fmt::format("a cylinder is a body in space and cannot be meshed with {}",
                       name(cylinder.kind)),
           "choose element = \"hex20\", \"hex8\" or \"tet10\", or give a mesh file");
  if (!(cylinder.radius > 0.0) || !std::isfinite(cylinder.radius) || !(cylinder.height > 0.0) ||
      !std::isfinite(cylinder.height))
    refuse(fmt::format("a cylinder of radius {} and height {} has no volume", cylinder.radius,
                       cylinder.height));
  if (cylinder.n_radius < 2 || cylinder.n_height < 1)
    refuse(fmt::format("a cylinder needs at least 2 cells along the radius and 1 along the axis, "
                       "not {} and {}",
                       cylinder.n_radius, cylinder.n_height));
  if (cylinder.sector != 360 && cylinder.sector != 180 && cylinder.sector != 90)
    refuse(
        fmt::format("the sector of a cylinder is 360, 180 or 90 degrees, not {}", cylinder.sector));
  require_countable(5.0 * cylinder.n_radius * cylinder.n_radius * cylinder.n_height, "cylinder");
}

/// Layers of the section, from z = 0 to the height.
Mesh extrude(const Disc& disc, const CylinderDomain& cylinder) {
  std::vector<Vec3> points;
  std::vector<int> ranks;
  std::vector<Index> corners;
  const auto n_section = static_cast<Index>(disc.points().size());
  for (int layer = 0; layer <= cylinder.n_height; ++layer) {
    const double z =
        layer == cylinder.n_height ? cylinder.height : cylinder.height * layer / cylinder.n_height;
    for (std::size_t i = 0; i < disc.points().size(); ++i) {
      points.emplace_back(disc.points()[i].x(), disc.points()[i].y(), z);
      ranks.push_back(disc.ranks()[i] + alternation(layer, cylinder.n_height));
    }
  }
  for (int layer = 0; layer < cylinder.n_height; ++layer)
    for (std::size_t cell = 0; cell < disc.corners().size(); cell += 4)
      for (int above = 0; above < 2; ++above)
        for (std::size_t corner = 0; corner < 4; ++corner)
          corners.push_back(disc.corners()[cell + corner] + (layer + above) * n_section);
  return mesh_from_corners(cylinder.kind, std::move(points), std::move(corners), ranks);
}

/// Moves the mid-side nodes between two nodes of the outer surface to the true circle.
void snap_to_circle(Mesh& mesh, double radius) {
  const auto edges = element_edges(mesh.kind);
  const auto n_corners = static_cast<std::size_t>(corners_per_element(mesh.kind));
  const auto outside = [&](Index node) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(node)];
    return std::abs(std::hypot(p.x(), p.y()) - radius) < 1e-9 * radius;
  };
  for (Index element = 0; element < mesh.n_elements(); ++element) {
    const auto cell = mesh.cell(element);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (!outside(cell[static_cast<std::size_t>(edges[i][0])]) ||
          !outside(cell[static_cast<std::size_t>(edges[i][1])]))
        continue;
      Vec3& middle = mesh.points[static_cast<std::size_t>(cell[n_corners + i])];
      middle.head<2>() *= radius / std::hypot(middle.x(), middle.y());
    }
  }
}

} // namespace

Mesh box_mesh(const BoxDomain& domain) {
  const int dimension = mechanics::dimension(domain.kind);
  require_sound(domain, dimension);
  const Grid grid(domain.cells[0], domain.cells[1], dimension == 3 ? domain.cells[2] : 0);
  std::vector<Index> corners;
  grid.for_each_box([&](const std::vector<Index>& box) {
    corners.insert(corners.end(), box.begin(), box.end());
  });
  Mesh mesh = mesh_from_corners(domain.kind, grid_points(domain, dimension), std::move(corners),
                                grid_ranks(domain, dimension));
  for (Eigen::Index axis = 0; axis < dimension; ++axis) {
    const std::string letter(1, "xyz"[axis]);
    add_node_set(mesh, letter + "-min", [&](const Vec3& p) { return p[axis] == domain.low[axis]; });
    add_node_set(mesh, letter + "-max",
                 [&](const Vec3& p) { return p[axis] == domain.high[axis]; });
  }
  return mesh;
}

Mesh cylinder_mesh(const CylinderDomain& domain) {
  require_sound(domain);
  const double radius = domain.radius;
  Mesh mesh = extrude(Disc(radius, domain.n_radius, domain.sector), domain);
  if (is_quadratic(domain.kind))
    snap_to_circle(mesh, radius);
  add_node_set(mesh, "bottom", [](const Vec3& p) { return p.z() == 0.0; });
  add_node_set(mesh, "top", [&](const Vec3& p) { return p.z() == domain.height; });
  add_node_set(mesh, "side", [&](const Vec3& p) {
    return std::abs(std::hypot(p.x(), p.y()) - radius) < 1e-9 * radius;
  });
  if (domain.sector <= 180)
    add_node_set(mesh, "y-min", [](const Vec3& p) { return p.y() == 0.0; });
  if (domain.sector == 90)
    add_node_set(mesh, "x-min", [](const Vec3& p) { return p.x() == 0.0; });
  return mesh;
}

Mesh quadratic_mesh(ElementKind kind, std::vector<Vec3> points, std::span<const Index> corners) {
  const auto edges = element_edges(kind);
  const auto n_corners = static_cast<std::size_t>(corners_per_element(kind));
  Mesh mesh{.kind = kind, .points = std::move(points), .cells = {}, .node_sets = {}};
  mesh.cells.reserve(corners.size() / n_corners * (n_corners + edges.size()));
  std::unordered_map<std::uint64_t, Index> middles;
  for (std::size_t first = 0; first < corners.size(); first += n_corners) {
    const auto cell = corners.subspan(first, n_corners);
    mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
    for (const std::array<int, 2>& edge : edges) {
      const auto [a, b] = std::minmax(cell[static_cast<std::size_t>(edge[0])],
                                      cell[static_cast<std::size_t>(edge[1])]);
      const std::uint64_t key =
          (static_cast<std::uint64_t>(a) << 32U) | static_cast<std::uint64_t>(b);
      const auto [middle, is_new] = middles.try_emplace(key, mesh.n_points());
      if (is_new) {
        const Vec3 place = 0.5 * (mesh.points[static_cast<std::size_t>(a)] +
                                  mesh.points[static_cast<std::size_t>(b)]);
        mesh.points.push_back(place);
      }
      mesh.cells.push_back(middle->second);
    }
  }
  return mesh;
}

} // namespace billet::mechanics
