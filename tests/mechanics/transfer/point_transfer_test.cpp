#include "mechanics/bulk/element_rings.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/transfer/point_transfer.h"
#include "tests/support/figures.h"
#include "tests/support/tensors.h"
#include "tests/support/transfer_meshes.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <numeric>

namespace billet::mechanics::point_transfer_test {
namespace {

using support::PointwiseField;
using support::shifted_strip;
using support::transfer_kinds;

constexpr std::array every_method{TransferMethod::nearest, TransferMethod::nodal,
                                  TransferMethod::patch};
constexpr std::array method_names{"nearest", "nodal", "patch"};

std::string label(ElementKind kind, TransferMethod method) {
  return std::string(name(kind)) + " " + method_names[static_cast<std::size_t>(method)];
}

TransferredField transfer(const PointwiseField& from,
                          const PointwiseField& to,
                          TransferMethod method = TransferMethod::patch) {
  constexpr std::array one{1};
  const auto at = MeshLocator(from.mesh, from.x).locate(to.points);
  return transfer_field({&from.mesh, from.points, from.values, one}, to.points, at, method);
}

/// Integration points along a unit length of a strip of unit cells, on average.
double points_along(ElementKind kind) {
  if (!is_simplex(kind))
    return 2.0;
  return dimension(kind) == 2 ? std::sqrt(6.0) : std::cbrt(24.0);
}

struct Wave {
  double amplitude; ///< of what is left of a wave of amplitude 1
  double error;     ///< root of the mean square
};

/// What ten transfers forth and back between meshes shifted by `shift` cells leave of a wave.
Wave after_ten_transfers(ElementKind kind, double shift, TransferMethod method) {
  constexpr double points_a_wave = 16.0;
  const double length = points_a_wave / points_along(kind);
  const int cells = static_cast<int>(std::ceil(4.0 * length));
  const auto wave = [&](const Vec3& p) { return std::sin(2.0 * std::numbers::pi * p[0] / length); };
  PointwiseField one(shifted_strip(kind, cells, 3, 0.0, 0.0), wave);
  PointwiseField other(shifted_strip(kind, cells, 3, shift, 0.0));
  for (int i = 0; i < 5; ++i) {
    other.values = transfer(one, other, method).values;
    one.values = transfer(other, one, method).values;
  }
  double product = 0.0;
  double square = 0.0;
  double error = 0.0;
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    const double exact = wave(one.points[i]);
    product += exact * one.values[i];
    square += exact * exact;
    error += (one.values[i] - exact) * (one.values[i] - exact);
  }
  return {product / square, std::sqrt(error / static_cast<double>(one.points.size()))};
}

TEST(PointTransfer, RM_02_ten_transfers_leave_a_wave) {
  constexpr double linear = 0.8236; // rm02_transfer_diffusion.csv
  constexpr double wanted = 0.95;
  for (const ElementKind kind : transfer_kinds)
    for (const double shift : {0.25, 0.5})
      for (const TransferMethod method : every_method) {
        const Wave left = after_ten_transfers(kind, shift, method);
        support::show("RM-02", fmt::format("{} shift {} amplitude", label(kind, method), shift),
                      left.amplitude, linear);
        fmt::print("[RM-02]   error {:.4f}\n", left.error);
        if (method == TransferMethod::patch) {
          EXPECT_GE(left.amplitude, wanted) << name(kind);
          EXPECT_LE(left.amplitude, 1.0) << name(kind);
        }
      }
}

struct Errors {
  double mean_square;
  double new_extreme; ///< how far values lie outside 0 to 1
};

Errors errors_of_one_transfer(ElementKind kind, int n, TransferMethod method) {
  const auto hill = [](const Vec3& p) {
    return std::sin(std::numbers::pi * p[0]) * std::sin(std::numbers::pi * p[1]);
  };
  const auto square = [&](int cells) {
    const int layers = dimension(kind) == 3 ? 2 : 1;
    return box_mesh(
        {.kind = kind, .high = Vec3(1.0, 1.0, 2.0 / cells), .cells = {cells, cells, layers}});
  };
  const PointwiseField from(square(n), hill);
  Mesh finer = square(n + 3);
  for (Vec3& p : finer.points)
    p[2] *= (n + 3.0) / n;
  const PointwiseField to(finer, hill);
  const std::vector<double> values = transfer(from, to, method).values;
  Errors errors{0.0, 0.0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    errors.mean_square += (values[i] - to.values[i]) * (values[i] - to.values[i]);
    errors.new_extreme = std::max({errors.new_extreme, -values[i], values[i] - 1.0});
  }
  errors.mean_square = std::sqrt(errors.mean_square / static_cast<double>(values.size()));
  return errors;
}

TEST(PointTransfer, RM_03_one_transfer_is_of_second_order_and_makes_no_extremes) {
  constexpr std::array allowed{1.33e-2, 3.37e-3, 8.4e-4, 2.1e-4}; // rm03_transfer_error.csv
  for (const ElementKind kind : transfer_kinds) {
    const std::size_t sizes = dimension(kind) == 3 ? 2 : 4;
    for (const TransferMethod method : every_method) {
      std::vector<double> errors;
      for (std::size_t k = 0; k < sizes; ++k) {
        const Errors at = errors_of_one_transfer(kind, 8 << k, method);
        errors.push_back(at.mean_square);
        support::show("RM-03", fmt::format("{} n = {}", label(kind, method), 8 << k),
                      at.mean_square, allowed[k]);
        if (method == TransferMethod::patch) {
          EXPECT_LE(at.mean_square, allowed[k]) << name(kind);
          EXPECT_LE(at.new_extreme, 0.01) << name(kind);
        }
      }
      const double order =
          std::log2(errors.front() / errors.back()) / static_cast<double>(sizes - 1);
      fmt::print("[RM-03]   order {:.2f}\n", order);
      if (method == TransferMethod::patch) {
        EXPECT_GE(order, 2.0) << name(kind);
      }
    }
  }
}

TEST(PointTransfer, a_linear_field_is_exact_up_to_the_boundary) {
  constexpr double tolerance = 1e-12; // of values up to 20
  const auto plane = [](const Vec3& p) { return 1.0 + 2.0 * p[0] - 3.0 * p[1] + 0.7 * p[2]; };
  for (const ElementKind kind : transfer_kinds)
    for (const TransferMethod method : every_method) {
      const PointwiseField from(shifted_strip(kind, 6, 3, 0.0, 0.12), plane);
      const PointwiseField to(shifted_strip(kind, 6, 4, 0.4, 0.1), plane);
      PointwiseField narrower = to; // within the body that is 3 across
      for (Vec3& p : narrower.mesh.points)
        p.tail<2>() *= 0.75;
      narrower = PointwiseField(narrower.mesh, plane);
      const TransferredField result = transfer(from, narrower, method);
      double worst = 0.0;
      for (std::size_t i = 0; i < result.values.size(); ++i)
        worst = std::max(worst, std::abs(result.values[i] - narrower.values[i]));
      support::show_error("RM-03 linear", label(kind, method), worst, tolerance);
      if (method == TransferMethod::patch) {
        EXPECT_LE(worst, tolerance) << name(kind);
        EXPECT_EQ(std::count(result.limited.begin(), result.limited.end(), 1), 0) << name(kind);
      }
    }
}

/// Largest overshoot of a step of height 1 at several places and slants, and of a bend.
struct Overshoots {
  double step = 0.0;
  double bend = 0.0;
};

Overshoots overshoots(ElementKind kind, TransferMethod method) {
  Overshoots worst;
  PointwiseField from(shifted_strip(kind, 6, 4, 0.0, 0.12));
  const PointwiseField to(shifted_strip(kind, 6, 4, 0.4, 0.15));
  for (const double place : {2.0, 2.3, 2.5, 2.79, 2.9, 3.1, 4.6})
    for (const double slant : {0.0, 0.5, 1.0}) {
      std::vector<double> beyond(from.points.size());
      for (std::size_t i = 0; i < beyond.size(); ++i)
        beyond[i] = from.points[i][0] + slant * (from.points[i][1] - 2.0) - place;
      for (std::size_t i = 0; i < beyond.size(); ++i)
        from.values[i] = beyond[i] > 0.0 ? 1.0 : 0.0;
      for (const double v : transfer(from, to, method).values)
        worst.step = std::max({worst.step, -v, v - 1.0});
      for (std::size_t i = 0; i < beyond.size(); ++i)
        from.values[i] = std::max(beyond[i], 0.0);
      const double top = *std::max_element(from.values.begin(), from.values.end());
      for (const double v : transfer(from, to, method).values)
        worst.bend = std::max(worst.bend, -v / top);
    }
  return worst;
}

TEST(PointTransfer, RM_03_steps_and_bends_do_not_overshoot) {
  constexpr double allowed = 0.01;
  for (const ElementKind kind : transfer_kinds)
    for (const TransferMethod method : every_method) {
      const Overshoots worst = overshoots(kind, method);
      support::show_error("RM-03 step", label(kind, method), worst.step, allowed);
      support::show_error("RM-03 bend", label(kind, method), worst.bend, allowed);
      if (method == TransferMethod::patch) {
        EXPECT_LE(worst.step, allowed) << name(kind);
        EXPECT_LE(worst.bend, allowed) << name(kind);
      }
    }
}

TEST(PointTransfer, RM_05_points_in_the_same_place_keep_their_value_to_the_bit) {
  support::Random random(11);
  for (const ElementKind kind : transfer_kinds) {
    PointwiseField field(shifted_strip(kind, 4, 3, 0.3, 0.1));
    field.values = random.list(field.values.size(), 1.0);
    const TransferredField same = transfer(field, field);
    EXPECT_EQ(same.values, field.values) << name(kind);
    for (std::size_t i = 0; i < field.points.size(); ++i)
      EXPECT_EQ(same.coincident[i], static_cast<Index>(i));
  }
}

TEST(PointTransfer, nothing_leaks_across_a_gap) {
  constexpr double gap = 1e-3; // of the cells' size
  for (const ElementKind kind : transfer_kinds) {
    const auto halves = [&](int n) {
      const Vec3 size(4.0, 2.0, 2.0);
      Mesh both = box_mesh({.kind = kind, .high = size, .cells = {n, n, n}});
      const Mesh upper = box_mesh({.kind = kind,
                                   .low = Vec3(0.0, 2.0 + gap, 0.0),
                                   .high = Vec3(4.0, 4.0, 2.0),
                                   .cells = {n, n, n}});
      const Index first = both.n_points();
      both.points.insert(both.points.end(), upper.points.begin(), upper.points.end());
      for (const Index node : upper.cells)
        both.cells.push_back(first + node);
      return both;
    };
    const auto side = [](const Vec3& p) { return p[1] > 2.0 + 0.5 * gap ? 1.0 : 0.0; };
    const PointwiseField from(halves(3), side);
    const PointwiseField to(halves(4), side);
    EXPECT_EQ(transfer(from, to).values, to.values) << name(kind);
  }
}

/// Moves a mesh and turns it.
Mesh turned(Mesh mesh, const Mat3& Q, const Vec3& by) {
  for (Vec3& p : mesh.points)
    p = (Q * p + by).eval();
  return mesh;
}

TEST(PointTransfer, a_vector_turns_with_the_frame) {
  constexpr double tolerance = 1e-11;
  for (const ElementKind kind : transfer_kinds) {
    const bool solid = dimension(kind) == 3;
    const Mat3 Q = support::rotation(solid ? Vec3(1, 2, 3) : Vec3(0, 0, 1), 37 * support::degree);
    const Vec3 by = solid ? Vec3(5, -3, 2) : Vec3(5, -3, 0);
    const PointwiseField from(shifted_strip(kind, 4, 3, 0.0, 0.1));
    const PointwiseField to(shifted_strip(kind, 4, 3, 0.37, 0.1));
    const PointwiseField from_turned(turned(from.mesh, Q, by));
    const PointwiseField to_turned(turned(to.mesh, Q, by));
    // Smooth here, rough there, so that the bounds act too.
    std::vector<double> values;
    std::vector<double> values_turned;
    for (const Vec3& p : from.points) {
      const Vec3 v(std::sin(p[0] + p[1]), p[0] > 2.0 ? 1.0 : 0.2 * p[1], std::cos(2.0 * p[0]));
      const Vec3 w = Q * v;
      values.insert(values.end(), v.data(), v.data() + 3);
      values_turned.insert(values_turned.end(), w.data(), w.data() + 3);
    }
    constexpr std::array three{3};
    const auto at = MeshLocator(from.mesh, from.x).locate(to.points);
    const auto at_turned = MeshLocator(from_turned.mesh, from_turned.x).locate(to_turned.points);
    const auto result = transfer_field({&from.mesh, from.points, values, three}, to.points, at,
                                       TransferMethod::patch);
    const auto result_turned =
        transfer_field({&from_turned.mesh, from_turned.points, values_turned, three},
                       to_turned.points, at_turned, TransferMethod::patch);
    double worst = 0.0;
    for (std::size_t i = 0; i < to.points.size(); ++i) {
      const Vec3 v = Eigen::Map<const Vec3>(&result.values[3 * i]);
      const Vec3 w = Eigen::Map<const Vec3>(&result_turned.values[3 * i]);
      worst = std::max(worst, (w - Q * v).norm());
    }
    EXPECT_GT(std::count(result.limited.begin(), result.limited.end(), 1), 0) << name(kind);
    support::show_error("transfer turned", std::string(name(kind)), worst, tolerance);
    EXPECT_LE(worst, tolerance) << name(kind);
  }
}

TEST(PointTransfer, no_unit_of_length_matters_and_no_number_of_threads) {
  for (const ElementKind kind : transfer_kinds) {
    const PointwiseField from(shifted_strip(kind, 4, 3, 0.0, 0.1),
                              [](const Vec3& p) { return p[0] > 2.0 ? 1.0 : std::sin(p[1]); });
    const PointwiseField to(shifted_strip(kind, 4, 3, 0.37, 0.1));
    const std::vector<double> values = transfer(from, to).values;
    for (const double unit : {0x1p-20, 0x1p20}) {
      const Mat3 scale = unit * Mat3::Identity();
      PointwiseField small(turned(from.mesh, scale, Vec3::Zero()));
      small.values = from.values;
      const PointwiseField target(turned(to.mesh, scale, Vec3::Zero()));
      EXPECT_EQ(transfer(small, target).values, values) << name(kind);
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(transfer(from, to).values, values) << name(kind);
  }
}

TEST(PointTransfer, long_thin_cells_and_a_single_layer_do_no_harm) {
  const auto wave = [](const Vec3& p) { return std::sin(p[0]) + 0.1 * p[1] + 0.2 * p[2]; };
  for (const ElementKind kind : transfer_kinds) {
    const auto plate = [&](int n) {
      return box_mesh({.kind = kind, .high = Vec3(6.0, 0.02, 0.02), .cells = {n, 1, 1}});
    };
    const PointwiseField from(plate(24), wave);
    const PointwiseField to(plate(31), wave);
    const std::vector<double> values = transfer(from, to).values;
    double worst = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
      worst = std::max(worst, std::abs(values[i] - to.values[i]));
    // A cubic term of the wave over two spacings.
    constexpr double spacing = 6.0 / 48.0;
    support::show_error("thin plate", std::string(name(kind)), worst, spacing * spacing * spacing);
    EXPECT_LE(worst, spacing * spacing * spacing) << name(kind);
  }
}

TEST(PointTransfer, one_cell_is_enough_for_a_linear_field) {
  constexpr double tolerance = 1e-13;
  const auto plane = [](const Vec3& p) { return 1.0 + 2.0 * p[0] - 3.0 * p[1] + p[2]; };
  for (const ElementKind kind : {ElementKind::quad4, ElementKind::quad8, ElementKind::hex20}) {
    const PointwiseField from(box_mesh({.kind = kind}), plane);
    const PointwiseField to(box_mesh({.kind = kind, .cells = {2, 2, 2}}), plane);
    const std::vector<double> values = transfer(from, to).values;
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], to.values[i], tolerance) << name(kind);
  }
}

TEST(PointTransfer, rings_are_the_neighbours_across_corners) {
  const Mesh mesh = box_mesh({.kind = ElementKind::quad8, .cells = {5, 5, 1}});
  const ElementRings rings(mesh);
  const auto first = rings.first(12); // the middle one
  EXPECT_EQ(std::vector<Index>(first.begin(), first.end()),
            (std::vector<Index>{6, 7, 8, 11, 12, 13, 16, 17, 18}));
  std::vector<Index> all(25);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(rings.second(12), all);
  EXPECT_EQ(rings.first(0).size(), 4U);
}

} // namespace
} // namespace billet::mechanics::point_transfer_test
