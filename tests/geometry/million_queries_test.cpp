// A million queries on five dies, against a search of every triangle and against CGAL.
//
// The reference shares no code with the surface: its distance to a triangle goes by barycentric
// regions, its side by the winding number. Prints what the queries met and how well they agree.

#include "geometry/surfaces/triangle_surface.h"
#include "tests/geometry/round_meshes.h"
#include "tests/geometry/sample_meshes.h"
#include "tests/geometry/surface_checks.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace billet::geometry::million_queries_test {
namespace {

constexpr std::size_t queries = 200'000; // of one surface
constexpr double tolerance = 1e-12;      // share of the size of the surface

struct Die {
  std::string name;
  TriangleMesh mesh;
};

/// A ring of n by m quadrilaterals: convex outside, saddles inside.
TriangleMesh ring(std::int32_t n, std::int32_t m) {
  TriangleMesh mesh;
  const double turn = 2.0 * std::numbers::pi;
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = 0; j < m; ++j) {
      const double r = 1.0 + 0.4 * std::cos(turn * j / m);
      mesh.points.emplace_back(r * std::cos(turn * i / n), r * std::sin(turn * i / n),
                               0.4 * std::sin(turn * j / m));
    }
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = 0; j < m; ++j) {
      const std::int32_t a = i * m + j, b = i * m + (j + 1) % m;
      const std::int32_t c = (i + 1) % n * m + (j + 1) % m, d = (i + 1) % n * m + j;
      mesh.triangles.push_back({a, d, c});
      mesh.triangles.push_back({a, c, b});
    }
  return mesh;
}

/// Turned, 40 times larger and away from the origin, as dies are.
TriangleMesh posed(TriangleMesh mesh) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& p : mesh.points)
    p = 40.0 * turn * p + Vec3(25, -60, 10);
  return mesh;
}

std::vector<Die> dies() {
  return {{"cube", posed(cube())},
          {"angle bar", posed(angle_bar())},
          {"spikes", posed(spiky(6))},
          {"sphere", posed(icosphere(2))},
          {"ring", posed(ring(12, 8))}};
}

/// Points over faces, edges and (most: a saddle has none) vertices, on both sides, from a
/// billionth of the size of the die to half of it away; every tenth anywhere.
class Queries {
public:
  explicit Queries(const TriangleMesh& mesh) : mesh_(mesh), normals_(mesh.points.size()) {
    Box box;
    for (const Vec3& p : mesh.points)
      box.add(p);
    box_ = box;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        normals_[static_cast<std::size_t>(mesh.triangles[t][i])].push_back(normal(t));
        edges_[std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3])].push_back(
            normal(t));
      }
  }

  [[nodiscard]] std::vector<Vec3> points(std::size_t n) {
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < n; ++k)
      points.push_back(k % 10 < 1   ? over_face()
                       : k % 10 < 4 ? over_edge()
                       : k % 10 < 9 ? over_vertex()
                                    : anywhere());
    return points;
  }

private:
  double random(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  std::size_t any(std::size_t n) { return generator_() % n; }
  [[nodiscard]] Vec3 normal(std::size_t t) const {
    return (corner(mesh_, t, 1) - corner(mesh_, t, 0))
        .cross(corner(mesh_, t, 2) - corner(mesh_, t, 0))
        .normalized();
  }
  // A direction between these, and a distance of any order of magnitude.
  Vec3 away(const std::vector<Vec3>& normals) {
    Vec3 direction = Vec3::Zero();
    for (const Vec3& n : normals)
      direction += random(0.0, 1.0) * n;
    const double distance = box_.size() * std::pow(10.0, random(-9.0, -0.3));
    return (generator_() % 2 == 0 ? 1.0 : -1.0) * distance * direction.normalized();
  }
  Vec3 anywhere() {
    const Vec3 middle = 0.5 * (box_.low + box_.high), half = 0.75 * (box_.high - box_.low);
    return middle + half.cwiseProduct(Vec3(random(-1, 1), random(-1, 1), random(-1, 1)));
  }
  Vec3 over_face() {
    const std::size_t t = any(mesh_.triangles.size());
    const double v = random(0.0, 1.0), w = random(0.0, 1.0 - v);
    return (1.0 - v - w) * corner(mesh_, t, 0) + v * corner(mesh_, t, 1) + w * corner(mesh_, t, 2) +
           away({normal(t)});
  }
  Vec3 over_edge() {
    const auto& [ends, normals] = *std::next(edges_.begin(), static_cast<int>(any(edges_.size())));
    const double t = random(0.0, 1.0);
    return (1.0 - t) * mesh_.points[static_cast<std::size_t>(ends.first)] +
           t * mesh_.points[static_cast<std::size_t>(ends.second)] + away(normals);
  }
  Vec3 over_vertex() {
    const std::size_t v = any(mesh_.points.size());
    return mesh_.points[v] + away(normals_[v]);
  }

  const TriangleMesh& mesh_;
  Box box_;
  std::vector<std::vector<Vec3>> normals_; // of the faces at each vertex
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Vec3>> edges_; // and at each edge
  std::mt19937 generator_{20250117};
};

/// What one thread found.
struct Tally {
  std::array<std::size_t, 3> met{}; ///< faces, edges, vertices
  std::size_t wrong_side = 0;       ///< gap and winding number disagree
  double worst = 0.0;               ///< difference of distances to brute force [mm]
  double worst_of_cgal = 0.0;       ///< and to CGAL [mm]

  void add(const Tally& other) {
    for (std::size_t i = 0; i < met.size(); ++i)
      met[i] += other.met[i];
    wrong_side += other.wrong_side;
    worst = std::max(worst, other.worst);
    worst_of_cgal = std::max(worst_of_cgal, other.worst_of_cgal);
  }
};

/// Calls work(begin, end) for parts of [0, n) in threads of their own.
void in_threads(std::size_t n, const std::function<void(std::size_t, std::size_t)>& work) {
  const std::size_t parts = std::max(2U, std::thread::hardware_concurrency());
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < parts; ++k)
    threads.emplace_back(work, k * n / parts, (k + 1) * n / parts);
  for (std::thread& thread : threads)
    thread.join();
}

/// CGAL's tree, the second engine.
class SecondEngine {
public:
  explicit SecondEngine(const TriangleMesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      triangles_.emplace_back(point(corner(mesh, t, 0)), point(corner(mesh, t, 1)),
                              point(corner(mesh, t, 2)));
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
    tree_.accelerate_distance_queries();
  }
  [[nodiscard]] double distance(const Vec3& x) const {
    return std::sqrt(tree_.squared_distance(point(x)));
  }

private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

  static Kernel::Point_3 point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

  Triangles triangles_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

class MillionQueries : public testing::TestWithParam<std::size_t> {
protected:
  MillionQueries() : die_(dies()[GetParam()]), points_(Queries(die_.mesh).points(queries)) {
    for (const Vec3& p : die_.mesh.points)
      box_.add(p);
    surface_->project(points_, far, found_);
  }

  // The second derivative of a distance d tells what is closest: its trace is 0 over a face, 1/d
  // over an edge, 2/d over a vertex.
  void compare(const SecondEngine& cgal, std::size_t i, Tally& tally) const {
    const double size = box_.size(), gap = found_[i].gap;
    const double distance = brute_distance(die_.mesh, points_[i]);
    tally.worst = std::max(tally.worst, std::abs(std::abs(gap) - distance));
    tally.worst_of_cgal =
        std::max(tally.worst_of_cgal, std::abs(std::abs(gap) - cgal.distance(points_[i])));
    ++tally.met[static_cast<std::size_t>(
        std::clamp(std::round(found_[i].dnormal_dx.trace() * gap), 0.0, 2.0))];
    if (distance > tolerance * size && (gap < 0.0) != (winding(die_.mesh, points_[i]) > 0.5))
      ++tally.wrong_side;
  }

  Die die_;
  Box box_;
  std::vector<Vec3> points_;
  SurfacePtr surface_ = make_triangle_surface(die_.mesh);
  std::vector<Projection> found_ = std::vector<Projection>(queries);
};

TEST_P(MillionQueries, AgreeWithBruteForceTheWindingNumberAndCgal) {
  const SecondEngine cgal(die_.mesh);
  Tally all;
  std::mutex guard;
  in_threads(queries, [&](std::size_t begin, std::size_t end) {
    Tally tally;
    for (std::size_t i = begin; i < end; ++i)
      compare(cgal, i, tally);
    const std::lock_guard lock(guard);
    all.add(tally);
  });
  const auto share = [&](std::size_t i) {
    return static_cast<double>(all.met[i]) / static_cast<double>(queries);
  };
  std::cout << fmt::format("{:10} {:4} triangles, {} queries: {:.1f} % faces, {:.1f} % edges, "
                           "{:.1f} % vertices; largest error {:.1e} of the size (CGAL {:.1e}), "
                           "{} on the wrong side\n",
                           die_.name, die_.mesh.triangles.size(), queries, 100.0 * share(0),
                           100.0 * share(1), 100.0 * share(2), all.worst / box_.size(),
                           all.worst_of_cgal / box_.size(), all.wrong_side);
  for (std::size_t i = 0; i < all.met.size(); ++i)
    EXPECT_GE(share(i), 0.1);
  EXPECT_LE(all.worst, tolerance * box_.size());
  EXPECT_LE(all.worst_of_cgal, tolerance * box_.size());
  EXPECT_EQ(all.wrong_side, 0U);
}

TEST_P(MillionQueries, GiveTheSameBitsInAnyOrderWithAnyHintFromAnyThread) {
  std::mt19937 generator(1);
  std::vector<std::size_t> order(queries);
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), generator);
  std::vector<Vec3> shuffled(queries);
  std::vector<Projection> out(queries);
  for (std::size_t k = 0; k < queries; ++k) {
    shuffled[k] = points_[order[k]];
    out[k].patch = static_cast<std::int32_t>(generator() % (die_.mesh.triangles.size() + 2)) - 1;
  }
  in_threads(queries, [&](std::size_t begin, std::size_t end) {
    surface_->project(std::span(shuffled).subspan(begin, end - begin), far,
                      std::span(out).subspan(begin, end - begin));
  });
  for (std::size_t k = 0; k < queries; ++k)
    ASSERT_TRUE(same_bits(out[k], found_[order[k]])) << shuffled[k].transpose();
}

INSTANTIATE_TEST_SUITE_P(dies, MillionQueries, testing::Range<std::size_t>(0, 5));

} // namespace
} // namespace billet::geometry::million_queries_test
