#include "geometry/mesh2d/boundary_measure.h"

#include "geometry/base/index.h"
#include "geometry/surfaces/profile_piece.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

/// The part of the measure that a parabolic side encloses: x dy or x^2 dy / 2, exactly. (G.44)
double enclosed(const Vec2& a, const Vec2& m, const Vec2& b, Measure measure) {
  constexpr std::array<double, 3> weights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const double off = 0.5 * std::sqrt(0.6);
  const std::array<double, 3> points{0.5 - off, 0.5, 0.5 + off};
  const Vec2 along = b - a, bow = 4.0 * m - 2.0 * (a + b);
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = points[i];
    const double x = a.x() + t * along.x() + t * (1.0 - t) * bow.x();
    const double dy = along.y() + (1.0 - 2.0 * t) * bow.y();
    sum += weights[i] * (measure == Measure::area ? x : 0.5 * x * x) * dy;
  }
  return sum;
}

/// Nodes of a new boundary with the way each may be moved.
class Shift {
public:
  Shift(RefinedDomain& domain, std::span<const BoundaryCurve> curves, Measure measure)
      : mesh_(domain.mesh) {
    for (const CurveSide& side : domain.sides) {
      const BoundaryCurve& curve = curves[idx(side.loop)];
      for (const double s : {side.from, side.middle()}) {
        const double freedom = curve.freedom(s);
        ways_.push_back(freedom * normal_of(curve.tangent(s)));
        const double weight = measure == Measure::revolved ? std::abs(curve.point(s).x()) : 1.0;
        slope_ += 0.5 * weight * freedom * (side.to - side.from);
      }
    }
  }
  /// The measure's derivative by the amount of a shift, about; 0: nothing can be done.
  [[nodiscard]] double slope() const { return slope_; }

  void move(double amount) {
    for (std::size_t i = 0; i < mesh_.boundary.size(); ++i) {
      mesh_.points[idx(mesh_.boundary[i].corners[0])] += amount * ways_[2 * i];
      mesh_.boundary[i].middle += amount * ways_[2 * i + 1];
    }
  }

private:
  PlaneMesh& mesh_;
  std::vector<Vec2> ways_; ///< of the first corner and the middle of each side
  double slope_ = 0.0;
};

} // namespace

double enclosed(const SideLoop& loop, const Enclosure& of) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.corners.size(); ++i)
    sum += enclosed(loop.corners[i] - of.origin, loop.middles[i] - of.origin,
                    loop.corners[(i + 1) % loop.corners.size()] - of.origin, of.measure);
  return sum;
}

double enclosed(const PlaneMesh& mesh, const Enclosure& of) {
  double sum = 0.0;
  for (const BoundarySide& side : mesh.boundary)
    sum += enclosed(mesh.points[idx(side.corners[0])] - of.origin, side.middle - of.origin,
                    mesh.points[idx(side.corners[1])] - of.origin, of.measure);
  return sum;
}

void restore_measure(RefinedDomain& domain,
                     std::span<const BoundaryCurve> curves,
                     const Enclosure& of,
                     double wanted) {
  Shift shift(domain, curves, of.measure);
  if (!(shift.slope() > 0.0))
    return;
  double error = enclosed(domain.mesh, of) - wanted;
  double step = -error / shift.slope();
  for (int i = 0; i < 30 && std::abs(error) > 1e-14 * std::abs(wanted) && step != 0.0; ++i) {
    shift.move(step);
    const double before = std::exchange(error, enclosed(domain.mesh, of) - wanted);
    if (error == before)
      return;
    step *= error / (before - error);
  }
}

} // namespace billet::geometry
