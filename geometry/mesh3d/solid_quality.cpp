#include "geometry/mesh3d/solid_quality.h"

#include "geometry/base/index.h"
#include "geometry/mesh3d/solid_reconnection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

namespace billet::geometry {

namespace {

constexpr int most_rounds_of_moves = 12; // through all poor tetrahedra
constexpr double most_moves = 2.0;   // of nodes, over the number of tetrahedra: a bound of the time
constexpr double first_step = 0.25;  // over the shortest edge at a node
constexpr double least_step = 0.004; // over the same edge

/// Of the angles between two faces of a tetrahedron that is turned the right way round; the
/// largest one is that of the smallest angle.
double largest_cosine(const std::array<Vec3, 4>& x) {
  // Normals of the faces opposite to each corner, outward, as long as twice the area.
  const std::array<Vec3, 4> n{(x[2] - x[1]).cross(x[3] - x[1]), (x[3] - x[0]).cross(x[2] - x[0]),
                              (x[1] - x[0]).cross(x[3] - x[0]), (x[2] - x[0]).cross(x[1] - x[0])};
  std::array<double, 4> length{};
  for (std::size_t i = 0; i < 4; ++i)
    length[i] = n[i].norm();
  double largest = -1.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      largest = std::max(largest, -n[i].dot(n[j]) / (length[i] * length[j]));
  return largest;
}

/// Directions in which a node is tried: along the axes and into the octants.
std::vector<Vec3> directions() {
  std::vector<Vec3> result;
  for (const double sign : {1.0, -1.0})
    for (Eigen::Index i = 0; i < 3; ++i)
      result.emplace_back(sign * Vec3::Unit(i));
  for (int octant = 0; octant < 8; ++octant)
    result.push_back(Vec3(octant & 1 ? 1.0 : -1.0, octant & 2 ? 1.0 : -1.0, octant & 4 ? 1.0 : -1.0)
                         .normalized());
  return result;
}

class Improver {
public:
  Improver(SolidMesh& mesh, const std::vector<char>& movable, const Confine& confine, double wanted)
      : mesh_(mesh), stars_(mesh), movable_(movable), confine_(confine), wanted_(wanted),
        fresh_(mesh.points.size(), 1), ways_(directions()),
        moves_(
            static_cast<std::int64_t>(most_moves * static_cast<double>(mesh.tetrahedra.size()))) {}

  void run() {
    for (int round = 0; round < most_rounds_of_moves; ++round) {
      bool better = false;
      for (std::size_t e = 0; e < stars_.size(); ++e)
        if (is_poor(e))
          better = reconnect(e) || better;
      for (std::size_t e = 0; e < stars_.size(); ++e)
        if (is_poor(e))
          for (const std::int32_t node : stars_[e])
            if (movable_[idx(node)] != 0 && fresh_[idx(node)] != 0 && moves_-- > 0)
              better = move(node) || better;
      if (!better)
        break;
    }
    stars_.close();
  }

private:
  [[nodiscard]] bool is_poor(std::size_t e) const {
    return stars_.is_there(e) && stars_.quality(e) < wanted_;
  }

  /// Joins the nodes around a tetrahedron otherwise, if that is better.
  bool reconnect(std::size_t e) {
    const std::optional<Reconnection> better = reconnection(stars_, e);
    if (!better)
      return false;
    stars_.replace(better->old, better->fresh);
    for (const auto& corners : better->fresh)
      for (const std::int32_t node : corners)
        fresh_[idx(node)] = 1;
    return true;
  }

  /// Quality of the worst tetrahedron around a node, or of one that is no better than `enough`;
  /// that one is the first to be asked the next time.
  double worst_around(std::int32_t node, double enough) {
    std::vector<std::size_t>& around = stars_.around(node);
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t& e : around) {
      worst = std::min(worst, stars_.quality(e));
      if (worst <= enough) {
        std::swap(e, around.front());
        break;
      }
    }
    return worst;
  }

  [[nodiscard]] double shortest_edge(std::int32_t node) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::size_t e : stars_.around(node))
      for (const std::int32_t other : stars_[e])
        if (other != node)
          shortest =
              std::min(shortest, (mesh_.points[idx(other)] - mesh_.points[idx(node)]).norm());
    return shortest;
  }

  bool move(std::int32_t node) {
    constexpr double gain = 1e-3;
    Vec3& x = mesh_.points[idx(node)];
    double worst = worst_around(node, -std::numeric_limits<double>::infinity());
    const double before = worst;
    const double edge = shortest_edge(node);
    double step = first_step;
    while (step > least_step) {
      const Vec3 start = x;
      Vec3 best = x;
      for (const Vec3& way : ways_) {
        x = confine_(node, start + step * edge * way);
        const double now = worst_around(node, worst + gain);
        if (now > worst + gain) {
          worst = now;
          best = x;
        }
      }
      x = best;
      step *= 0.5;
    }
    fresh_[idx(node)] = 0;
    if (worst > before)
      for (const std::size_t e : stars_.around(node))
        for (const std::int32_t other : stars_[e])
          fresh_[idx(other)] = static_cast<char>(other != node || fresh_[idx(other)] != 0);
    return worst > before;
  }

  SolidMesh& mesh_;
  SolidStars stars_;
  const std::vector<char>& movable_;
  const Confine& confine_;
  double wanted_;
  std::vector<char> fresh_; ///< something next to the node has moved since it was tried
  std::vector<Vec3> ways_;
  std::int64_t moves_; ///< that are left
};

} // namespace

double smallest_dihedral(const std::array<Vec3, 4>& x) {
  const double volume6 = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
  if (!(volume6 > 0.0))
    return volume6 < 0.0 ? -1.0 : 0.0;
  return std::acos(std::min(largest_cosine(x), 1.0));
}

double shape_quality(const std::array<Vec3, 4>& x) {
  static const double regular = std::acos(1.0 / 3.0);
  const double angle = smallest_dihedral(x) / regular;
  if (!(angle > 0.0))
    return angle;
  const double volume6 = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
  // Squares of the lengths of the edges 01, 02, 03, 12, 13, 23, and the three at each corner.
  const std::array<double, 6> l{(x[1] - x[0]).squaredNorm(), (x[2] - x[0]).squaredNorm(),
                                (x[3] - x[0]).squaredNorm(), (x[2] - x[1]).squaredNorm(),
                                (x[3] - x[1]).squaredNorm(), (x[3] - x[2]).squaredNorm()};
  const double longest =
      std::max({l[0] * l[1] * l[2], l[0] * l[3] * l[4], l[1] * l[3] * l[5], l[2] * l[4] * l[5]});
  return std::min(angle, std::numbers::sqrt2 * volume6 / std::sqrt(longest));
}

double bent_jacobian(const std::array<Vec3, 4>& x, const std::array<Vec3, 6>& m) {
  constexpr std::array<std::array<std::size_t, 2>, 6> ends{
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  const double straight = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
  if (!(straight > 0.0))
    return std::min(straight, 0.0);
  // Derivatives by the four barycentric coordinates l: shapes l (2 l - 1) and 4 l_a l_b.
  const auto jacobian = [&](const std::array<double, 4>& l) {
    std::array<Vec3, 4> d;
    for (std::size_t i = 0; i < 4; ++i)
      d[i] = (4.0 * l[i] - 1.0) * x[i];
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [a, b] = ends[e];
      d[a] += 4.0 * l[b] * m[e];
      d[b] += 4.0 * l[a] * m[e];
    }
    return (d[1] - d[0]).cross(d[2] - d[0]).dot(d[3] - d[0]);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<double, 4> l{};
    l[i] = 1.0;
    least = std::min(least, jacobian(l));
  }
  for (const auto& [a, b] : ends) {
    std::array<double, 4> l{};
    l[a] = l[b] = 0.5;
    least = std::min(least, jacobian(l));
  }
  return least / straight;
}

double bent_quality(const std::array<Vec3, 4>& x, const std::array<Vec3, 6>& m) {
  // Corner, the three others in the order that turns the same way, and the middles to them.
  struct Corner {
    std::size_t at;
    std::array<std::size_t, 3> others, middles;
  };
  constexpr std::array<Corner, 4> at_corners{{{0, {1, 2, 3}, {0, 2, 3}},
                                              {1, {2, 0, 3}, {1, 0, 4}},
                                              {2, {0, 1, 3}, {2, 1, 5}},
                                              {3, {1, 0, 2}, {4, 3, 5}}}};
  double least = 1.0;
  for (const Corner& corner : at_corners) {
    Mat3 tangents;
    double scale = std::numbers::sqrt2 / 2.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 chord = x[corner.others[k]] - x[corner.at];
      const Vec3 tangent = 4.0 * m[corner.middles[k]] - 3.0 * x[corner.at] - x[corner.others[k]];
      tangents.col(static_cast<Eigen::Index>(k)) = tangent;
      scale *= std::max(tangent.norm(), chord.norm());
    }
    least = std::min(least, scale > 0.0 ? tangents.determinant() / scale : 0.0);
  }
  return least;
}

void improve(SolidMesh& mesh,
             const std::vector<char>& movable,
             const Confine& confine,
             double wanted) {
  Improver(mesh, movable, confine, wanted).run();
}

} // namespace billet::geometry
