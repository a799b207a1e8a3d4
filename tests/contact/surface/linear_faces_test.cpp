// Straight faces on curved tools: what is added to their gaps, and what becomes of pressure and
// energy. (C.43)

#include "contact/surface/linear_faces.h"
#include "tests/support/contact_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>

namespace billet::contact::linear_faces_test {
namespace {

constexpr double radius = 20.0;
constexpr double middle = 2.0; // of the body [1, 3] along x

using mechanics::ElementKind;

/// A tool beneath the body whose highest point is at y = 0 in its middle; a bore for a negative
/// radius.
geometry::SurfacePtr tool_below(bool solid, double r = radius) {
  const bool inside = r < 0.0;
  const Vec3 centre(middle, -r, 0.5);
  return solid ? geometry::make_sphere(centre, std::abs(r), inside)
               : geometry::make_circle({centre[0], centre[1], 0.0}, std::abs(r), inside);
}

/// Height of that tool.
double height(double x, double z, bool solid, double r) {
  const double off = solid ? std::hypot(x - middle, z - 0.5) : x - middle;
  return std::copysign(std::sqrt(r * r - off * off), r) - r;
}

/// A body with faces of different lengths whose lower nodes lie on the tool.
ContactBench on_tool(ElementKind kind, double r, const Friction& friction = Frictionless{}) {
  const bool solid = kind == ElementKind::hex8 || kind == ElementKind::hex20;
  mechanics::Mesh mesh =
      mechanics::box_mesh({kind, Vec3(1, 0, 0), Vec3(3, 1, 1), {8, 1, 3}, {1, 1, 1}});
  const auto faces = faces_at(mesh, 1, 0.0);
  for (Vec3& p : mesh.points) {
    p[0] += 0.05 * std::sin(5.0 * p[0]);
    p[2] += 0.05 * std::sin(5.0 * p[2]);
    if (p[1] < 1e-9)
      p[1] = height(p[0], p[2], solid, r);
  }
  return ContactBench(std::move(mesh),
                      solid ? mechanics::Analysis::solid : mechanics::Analysis::plane_strain,
                      bench_material(), one_tool(still_tool(tool_below(solid, r), friction)),
                      {Form::mixed, 1.0, 1.0}, faces);
}

std::vector<double> sunk(const ContactBench& bench, double by, double along = 0.0) {
  std::vector<double> x = bench.x;
  const auto dim = static_cast<std::size_t>(bench.mesh.dimension());
  for (std::size_t i = 0; i < x.size(); i += dim) {
    x[i] += along;
    x[i + 1] -= by;
  }
  return x;
}

std::vector<geometry::Projection> feet_of(const ContactBench& bench) {
  std::vector<Vec3> points(bench.surface.n_points());
  bench.surface.positions(bench.x, points);
  std::vector<geometry::Projection> feet(points.size());
  bench.tools[0].surface->project(points, ContactBench::reach, feet);
  return feet;
}

/// Largest jump at a node between what two faces of the plane make of it, going on straight from
/// their two points, over the mean.
double jump_at_nodes(const ContactBench& bench,
                     const std::function<double(std::size_t)>& at_point) {
  std::map<mechanics::Index, std::vector<double>> at_node;
  double sum = 0.0;
  for (mechanics::Index f = 0; f < bench.surface.n_faces(); ++f) {
    const auto nodes = bench.surface.scatter().nodes(f);
    const auto k = as_size(2 * f);
    const double mean = 0.5 * (at_point(k) + at_point(k + 1));
    const double slope = 0.5 * std::sqrt(3.0) * (at_point(k + 1) - at_point(k)) *
                         (bench.surface.line_coordinates()[0] < 0.0 ? 1.0 : -1.0);
    at_node[nodes[0]].push_back(mean - slope);
    at_node[nodes[1]].push_back(mean + slope);
    sum += mean;
  }
  double jump = 0.0;
  for (const auto& [node, values] : at_node)
    if (values.size() == 2)
      jump = std::max(jump, std::abs(values[0] - values[1]));
  return jump / (sum / static_cast<double>(bench.surface.n_faces()));
}

TEST(StraightFaces, OnALineAreLevelledByTheirSagitta) {
  for (const double r : {radius, -radius}) {
    const ContactBench bench = on_tool(ElementKind::quad4, r);
    const std::vector<double> offset = sagitta_offsets(bench.surface, bench.x, {}, feet_of(bench));
    std::map<mechanics::Index, std::vector<double>> around;
    std::vector<double> exact;
    for (mechanics::Index f = 0; f < bench.surface.n_faces(); ++f) {
      const auto nodes = bench.surface.scatter().nodes(f);
      const auto place = [&](int a) {
        return Vec2(bench.x[as_size(2 * nodes[as_size(a)])],
                    bench.x[as_size(2 * nodes[as_size(a)] + 1)]);
      };
      exact.push_back((place(1) - place(0)).squaredNorm() / (12.0 * r));
      for (const mechanics::Index node : nodes)
        around[node].push_back(exact.back());
    }
    double largest = 0.0;
    for (mechanics::Index f = 0; f < bench.surface.n_faces(); ++f)
      for (std::size_t i = 0; i < 2; ++i) {
        const double xi = bench.surface.line_coordinates()[i];
        const auto nodes = bench.surface.scatter().nodes(f);
        double expected = exact[as_size(f)];
        for (std::size_t a = 0; a < 2; ++a) {
          const auto& s = around[nodes[a]];
          expected -= 0.5 * (1.0 + (a == 0 ? -xi : xi)) * (s.front() + s.back()) / 2.0;
        }
        const std::size_t k = as_size(2 * f) + i;
        EXPECT_NEAR(offset[k], expected, 1e-4 * std::abs(exact[as_size(f)]));
        largest = std::max(largest, std::abs(offset[k]));
      }
    EXPECT_GT(largest, 0.1 * std::abs(exact[0])) << "faces differ in length";
  }
}

TEST(StraightFaces, SeeATurnedToolAsTheySeeTheSameToolUnturned) {
  // The axis of a cylinder across the body: in space its curvature has a direction.
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::hex8}) {
    const ContactBench bench = on_tool(kind, radius);
    const bool solid = kind == ElementKind::hex8;
    const Vec3 centre(middle, -radius, 0.0), axis = Vec3(0.3, 0.0, 1.0).normalized();
    const auto tool = [&](const Mat3& turned) {
      const Vec3 at = turned.transpose() * centre;
      return solid ? geometry::make_cylinder(at, turned.transpose() * axis, radius, false)
                   : geometry::make_circle(at, radius, false);
    };
    const auto offsets_on = [&](const Mat3& turned) {
      const geometry::SurfacePtr surface = tool(turned);
      geometry::Pose pose;
      pose.rotation = turned;
      std::vector<Vec3> points(bench.surface.n_points());
      bench.surface.positions(bench.x, points);
      for (Vec3& point : points)
        point = pose.to_tool(point);
      std::vector<geometry::Projection> feet(points.size());
      surface->project(points, ContactBench::reach, feet);
      return sagitta_offsets(bench.surface, bench.x, pose, feet);
    };
    const Vec3 about = solid ? Vec3(0.2, 0.5, 0.8).normalized() : Vec3::UnitZ();
    const std::vector<double> unturned = offsets_on(Mat3::Identity());
    const std::vector<double> turned = offsets_on(Eigen::AngleAxisd(0.7, about).matrix());
    double largest = 0.0;
    for (std::size_t k = 0; k < unturned.size(); ++k) {
      EXPECT_NEAR(turned[k], unturned[k], 1e-12) << k;
      largest = std::max(largest, std::abs(unturned[k]));
    }
    EXPECT_GT(largest, 1e-6);
  }
}

TEST(StraightFaces, PressWithoutJumpsWhereFacesMeet) {
  constexpr double deep = 1e-4; // of the order of the sagittas
  ContactBench bench = on_tool(ElementKind::quad4, radius);
  bench.commit(sunk(bench, deep), 1.0);
  const auto pressure = [&](std::size_t k) { return trial_traction(bench.term, 0, k).pressure; };
  const double before = jump_at_nodes(bench, pressure);
  bench.assemble(bench.x, 2.0);
  const double now = jump_at_nodes(bench, pressure);
  std::printf("jump of the pressure at a node: %.1f %% of the mean, with sagitta offsets %.2f %%\n",
              100 * before, 100 * now);
  EXPECT_GT(before, 0.2);
  EXPECT_LT(now, 2e-3);
}

TEST(StraightFaces, InSpaceTakeBothCurvatures) {
  const ContactBench bench = on_tool(ElementKind::hex8, radius);
  const std::vector<double> offset = sagitta_offsets(bench.surface, bench.x, {}, feet_of(bench));
  // Nodes on a sphere: of each face the squares of both its edges count.
  const auto edge = [&](mechanics::Index f, std::size_t axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const mechanics::Index a : bench.surface.scatter().nodes(f)) {
      low = std::min(low, bench.x[as_size(3 * a) + axis]);
      high = std::max(high, bench.x[as_size(3 * a) + axis]);
    }
    return high - low;
  };
  std::vector<double> exact;
  std::map<mechanics::Index, std::vector<double>> around;
  for (mechanics::Index f = 0; f < bench.surface.n_faces(); ++f) {
    exact.push_back((std::pow(edge(f, 0), 2) + std::pow(edge(f, 2), 2)) / (12.0 * radius));
    for (const mechanics::Index a : bench.surface.scatter().nodes(f))
      around[a].push_back(exact.back());
  }
  double largest = 0.0;
  for (mechanics::Index f = 0; f < bench.surface.n_faces(); ++f) {
    double expected = exact[as_size(f)], mean = 0.0;
    for (const mechanics::Index a : bench.surface.scatter().nodes(f)) {
      const std::vector<double>& s = around[a];
      expected -= 0.25 * std::accumulate(s.begin(), s.end(), 0.0) / static_cast<double>(s.size());
    }
    for (std::size_t i = 0; i < 4; ++i)
      mean += 0.25 * offset[as_size(4 * f) + i];
    EXPECT_NEAR(mean, expected, 5e-3 * exact[as_size(f)]); // heights of the edges are left out
    largest = std::max(largest, std::abs(mean) / exact[as_size(f)]);
  }
  EXPECT_GT(largest, 0.1) << "faces differ in length";
}

TEST(StraightFaces, StayAsTheyAreWhereNothingIsToLevel) {
  const auto all_zero = [](const std::vector<double>& offset) {
    return std::all_of(offset.begin(), offset.end(), [](double l) { return l == 0.0; });
  };
  // Quadratic faces follow the tool.
  const ContactBench quadratic = on_tool(ElementKind::quad8, radius);
  EXPECT_TRUE(all_zero(sagitta_offsets(quadratic.surface, quadratic.x, {}, feet_of(quadratic))));
  const ContactBench bench = on_tool(ElementKind::quad4, radius);
  std::vector<geometry::Projection> feet = feet_of(bench);
  // Too far to have been asked for.
  EXPECT_TRUE(all_zero(
      sagitta_offsets(bench.surface, bench.x, {}, std::vector<geometry::Projection>(feet.size()))));
  const auto changed = [&](const std::function<void(geometry::Projection&, std::size_t)>& change) {
    std::vector<geometry::Projection> other = feet;
    for (std::size_t k = 0; k < other.size(); ++k)
      change(other[k], k);
    return sagitta_offsets(bench.surface, bench.x, {}, other);
  };
  // A flat tool; one next to the face; one as sharp as the face is long; an edge under each face.
  EXPECT_TRUE(all_zero(changed([](auto& foot, std::size_t) { foot.dnormal_dx.setZero(); })));
  EXPECT_TRUE(all_zero(changed([](auto& foot, std::size_t) { foot.normal = Vec3::UnitX(); })));
  EXPECT_TRUE(all_zero(changed([](auto& foot, std::size_t) { foot.dnormal_dx *= 100.0; })));
  EXPECT_TRUE(
      all_zero(changed([](auto& foot, std::size_t k) { foot.dnormal_dx *= k % 2 == 0 ? 1 : 4; })));
}

TEST(StraightFaces, KeepTheBooksOfEnergy) {
  // The faces get other lengths on their way, and so other offsets.
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::hex8}) {
    ContactBench bench = on_tool(kind, radius);
    const auto dim = as_size(bench.mesh.dimension());
    bench.commit(sunk(bench, 5e-5), 1.0); // comes down, by no matter what work
    const ContactWork down = bench.term.work();
    const double entered_down = bench.entered;
    for (int increment = 1; increment <= 20; ++increment) {
      std::vector<double> x = bench.x;
      for (std::size_t i = 0; i < x.size(); i += dim)
        x[i] += 2e-3 * std::sin(2.0 * x[i] + increment);
      bench.commit(x, 1.0 + increment);
    }
    bench.commit(sunk(bench, 0.0), 22.0); // what the last offsets do
    const ContactWork& work = bench.term.work();
    const double entered = bench.entered - entered_down;
    const double of_offsets = work.penalty_update - down.penalty_update;
    const double stored = work.stored - down.stored;
    const double error = entered + of_offsets - work.friction - stored;
    std::printf("%s: entered %.4e, offsets %.2e, stored %.4e more N mm: error %.1e\n",
                std::string(mechanics::name(kind)).c_str(), entered, of_offsets, stored, error);
    // The rest is what a contact's area gains, which a penalty's energy does not know.
    EXPECT_GT(std::abs(of_offsets), 20.0 * std::abs(error));
  }
}

TEST(StraightFaces, AreLevelledByAcceptedIncrementsOnly) {
  ContactBench once = on_tool(ElementKind::quad4, radius, Coulomb{0.2});
  ContactBench tried = on_tool(ElementKind::quad4, radius, Coulomb{0.2});
  for (int increment = 1; increment <= 3; ++increment) {
    for (const double by : {3e-3, -1e-2, 7e-4}) {
      tried.term.restart();
      tried.assemble(sunk(tried, by, 0.1), tried.time_old + 1.0);
    }
    tried.term.restart();
    for (ContactBench* bench : {&once, &tried})
      bench->commit(sunk(*bench, 1e-4, 1e-3), increment);
    EXPECT_GT(once.force().norm(), 0.0);
    EXPECT_EQ((once.force() - tried.force()).norm(), 0.0);
  }
}

} // namespace
} // namespace billet::contact::linear_faces_test
