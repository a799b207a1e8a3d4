#include "process/measures/shape_measures.h"

#include "mechanics/elements/mesh_locator.h"
#include "mechanics/equilibrium/faces.h"
#include "process/scene/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace billet::process {

namespace {

using mechanics::Face;

/// Points of the surface and which of them are next to each other on a face.
struct SurfaceSamples {
  std::vector<Vec3> points; ///< [mm]
  std::vector<std::array<std::size_t, 2>> neighbours;
};

/// Steps along an edge of a face: a curved one is followed to a hundredth of its height.
constexpr int steps_in_plane = 8, steps_in_space = 4;

template <class Shape> void add_face(const Run& run, const Face& face, SurfaceSamples& samples) {
  constexpr int dim = Shape::dim + 1;
  constexpr bool in_space = Shape::dim == 2;
  constexpr bool triangle = contact::is_triangle<Shape>;
  constexpr int steps = in_space ? steps_in_space : steps_in_plane;
  std::array<double, std::size_t{Shape::nodes} * dim> local{};
  mechanics::gather(run.positions(), face.nodes, dim, local.data());
  const auto coordinate = [](int i) {
    const double share = static_cast<double>(i) / steps;
    return triangle ? share : 2.0 * share - 1.0;
  };
  const auto in_row = [](int j) { return triangle ? steps - j : steps; };
  for (int j = 0; j <= (in_space ? steps : 0); ++j)
    for (int i = 0; i <= in_row(j); ++i) {
      mechanics::RefPoint<Shape::dim> xi{};
      xi[0] = coordinate(i);
      if constexpr (in_space)
        xi[1] = coordinate(j);
      const std::size_t at = samples.points.size();
      samples.points.push_back(
          mechanics::FacePoint<Shape>(run.part().analysis, local.data(), xi, 1.0).position);
      if (i > 0)
        samples.neighbours.push_back({at - 1, at});
      if (j > 0) // below, in a row that is as long or one longer
        samples.neighbours.push_back({at - static_cast<std::size_t>(in_row(j - 1) + 1), at});
    }
}

bool lies_on_axis(const Run& run, const Face& face) {
  const int dim = run.mesh().dimension();
  return std::all_of(face.nodes.begin(), face.nodes.end(), [&](mechanics::Index node) {
    return mechanics::node_position(run.positions(), dim, node)[0] == 0.0;
  });
}

SurfaceSamples surface_of(const Run& run) {
  SurfaceSamples samples;
  const bool has_axis = run.part().analysis == mechanics::Analysis::axisymmetric;
  for (const Face& face : mechanics::boundary_faces(run.mesh()))
    if (!has_axis || !lies_on_axis(run, face))
      mechanics::visit_face(run.mesh().kind,
                            [&](auto shape) { add_face<decltype(shape)>(run, face, samples); });
  return samples;
}

bool counts(const Measure& measure, const Vec3& point) {
  return !measure.within || ((point.array() >= measure.within->low.array()).all() &&
                             (point.array() <= measure.within->high.array()).all());
}

/// The ends of what a box leaves of a straight line; none: nothing.
std::optional<std::array<Vec3, 2>> within(const Box& box, const Vec3& from, const Vec3& to) {
  double first = 0.0, last = 1.0; // shares of the line
  for (int i = 0; i < 3; ++i) {
    const double way = to[i] - from[i];
    if (way == 0.0) {
      if (from[i] < box.low[i] || from[i] > box.high[i])
        return std::nullopt;
      continue;
    }
    const double a = (box.low[i] - from[i]) / way, b = (box.high[i] - from[i]) / way;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last)
    return std::nullopt;
  return {{from + first * (to - from), from + last * (to - from)}};
}

/// Smallest and largest of a figure of the surface's points, and of those in which its lines
/// between them leave the box; nothing counts: both not a number.
template <class Figure>
std::pair<double, double>
range(const SurfaceSamples& surface, const Measure& measure, const Figure& figure) {
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
  const auto take = [&](const Vec3& point) {
    low = std::fmin(low, figure(point));
    high = std::fmax(high, figure(point));
  };
  for (const Vec3& point : surface.points)
    if (counts(measure, point))
      take(point);
  if (!measure.within)
    return {low, high};
  for (const auto& [a, b] : surface.neighbours)
    if (const auto ends = within(*measure.within, surface.points[a], surface.points[b])) {
      take((*ends)[0]);
      take((*ends)[1]);
    }
  return {low, high};
}

double radius(const Measure& measure, const Vec3& point) {
  const Vec3 from = point - measure.point;
  return (from - from.dot(measure.axis) * measure.axis).norm();
}

/// Gaps of points to a tool as it stands now, shape (n_points); infinite: there is no tool [mm].
std::vector<double> gaps_to(const Run& run, std::size_t tool, std::span<const Vec3> points) {
  const geometry::Pose pose = run.model.contact->pose(tool, run.state.time, run.state.x);
  std::vector<Vec3> local(points.size());
  std::transform(points.begin(), points.end(), local.begin(),
                 [&](const Vec3& x) { return pose.to_tool(x); });
  std::vector<geometry::Projection> feet(points.size());
  run.tools()[tool].surface->project(local, box_of(points).size(), feet);
  std::vector<double> gaps(points.size());
  std::transform(feet.begin(), feet.end(), gaps.begin(),
                 [](const geometry::Projection& foot) { return foot.gap; });
  return gaps;
}

/// Touching ends between two points of a face where the gap, linear between them, is as large as
/// touching allows.
double contact_radius(const Run& run, const Measure& measure, const SurfaceSamples& surface) {
  if (run.contact() == nullptr)
    return 0.0;
  constexpr double share_of_body = 1e-4; // more of it counts what is about to roll on
  const double touching = measure.touching.value_or(share_of_body * body_size(run.scene.part.mesh));
  const std::vector<double> gaps = gaps_to(run, measure.tool, surface.points);
  double largest = 0.0;
  const auto note = [&](const Vec3& point) {
    if (counts(measure, point))
      largest = std::max(largest, radius(measure, point));
  };
  for (auto [in, out] : surface.neighbours) {
    if (gaps[in] > gaps[out])
      std::swap(in, out);
    if (gaps[in] > touching)
      continue;
    note(surface.points[in]);
    const bool parts = gaps[out] > touching;
    if (!parts || std::isfinite(gaps[out])) {
      const double share = parts ? (touching - gaps[in]) / (gaps[out] - gaps[in]) : 1.0;
      note(surface.points[in] + share * (surface.points[out] - surface.points[in]));
    }
  }
  return largest;
}

/// Digits of a number, mirrored at the point: 0, 1/2, 1/4, 3/4, 1/8, ... with the base 2. van der
/// Corput (1935)
double mirrored_digits(int number, int base) {
  double value = 0.0, digit = 1.0;
  for (; number > 0; number /= base) {
    digit /= base;
    value += digit * (number % base);
  }
  return value;
}

/// Points that fill a box so evenly that their share of a part of it is its volume to 0.15 % of the
/// box, wherever its walls are. In rows along its edges they would count a whole row or none at a
/// wall. Halton (1960)
std::vector<Vec3> evenly_spread(const Box& box, int dim) {
  const int n = dim == 2 ? 16384 : 40000;
  std::vector<Vec3> points;
  points.reserve(idx(n));
  for (int i = 1; i <= n; ++i) {
    const Vec3 share(mirrored_digits(i, 2), mirrored_digits(i, 3), mirrored_digits(i, 5));
    points.push_back(box.low + share.cwiseProduct(box.high - box.low));
    if (dim == 2)
      points.back()[2] = 0.0;
  }
  return points;
}

double filling(const Run& run, const Measure& measure) {
  std::vector<Vec3> points = evenly_spread(*measure.within, run.mesh().dimension());
  for (std::size_t tool = 0; run.contact() != nullptr && tool < run.tools().size(); ++tool) {
    const std::vector<double> gaps = gaps_to(run, tool, points);
    std::vector<Vec3> free;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (gaps[i] >= 0.0)
        free.push_back(points[i]);
    points = std::move(free);
  }
  const bool revolved = run.part().analysis == mechanics::Analysis::axisymmetric;
  const auto weight = [&](const Vec3& point) { return revolved ? point[0] : 1.0; };
  const double inside = 1e-9 * measure.within->size();
  const std::vector<mechanics::MeshLocation> at =
      mechanics::MeshLocator(run.mesh(), run.positions()).locate(points, inside);
  double cavity = 0.0, metal = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cavity += weight(points[i]);
    metal += at[i].element >= 0 ? weight(points[i]) : 0.0;
  }
  return cavity > 0.0 ? metal / cavity : 1.0;
}

double measured(const Run& run, const Measure& measure, const SurfaceSamples& surface) {
  const auto radii = [&] {
    return range(surface, measure, [&](const Vec3& x) { return radius(measure, x); });
  };
  const auto places = [&] {
    return range(surface, measure, [&](const Vec3& x) { return x.dot(measure.direction); });
  };
  switch (measure.kind) {
  case Measure::Kind::equator_radius:
    return radii().second;
  case Measure::Kind::contact_radius:
    return contact_radius(run, measure, surface);
  case Measure::Kind::barrelling: {
    const double contact = contact_radius(run, measure, surface);
    return contact > 0.0 ? radii().second / contact : 1.0;
  }
  case Measure::Kind::bore:
    return radii().first;
  case Measure::Kind::height: {
    const auto [low, high] = places();
    return high - low;
  }
  case Measure::Kind::reach:
    return places().second;
  case Measure::Kind::filling:
    return filling(run, measure);
  }
  return 0.0;
}

} // namespace

std::vector<double> measured(const Run& run) {
  std::vector<double> values;
  if (run.scene.measures.empty())
    return values;
  const SurfaceSamples surface = surface_of(run);
  for (const Measure& measure : run.scene.measures)
    values.push_back(measured(run, measure, surface));
  return values;
}

} // namespace billet::process
