#include "contact/corners/corner_contact.h"

#include "contact/faces/line_face.h"
#include "geometry/base/box.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/AutoDiff>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace billet::contact {

namespace {

/// Corners and roundings turn by more than this [rad].
constexpr double min_turn = 10.0 * std::numbers::pi / 180.0;
/// Of the parent element: as far outside a new mesh a corner that pressed on the old one still
/// does.
constexpr double still_presses = 0.02;

/// Coordinates of the nodes of a face, then the travel and the turn of the tool.
constexpr int max_nodal = 6;
constexpr int max_unknowns = 8;
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, max_unknowns, 1>>;
using Dual2 = Eigen::Matrix<Dual, 2, 1>;

Dual2 dual(const Vec2& v) { return {Dual(v.x()), Dual(v.y())}; }
Vec2 value(const Dual2& v) { return {v.x().value(), v.y().value()}; }
Dual cross_of(const Dual2& u, const Dual2& v) { return u.x() * v.y() - u.y() * v.x(); }
Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0.0}; }

/// A vector with the derivative that the tool's free degrees of freedom give it.
///
/// @param rate  its rate by one of them
template <class Rate>
Dual2 moving(const Vec2& v, std::span<const PlaceRate> drives, const Rate& rate) {
  Dual2 moved = dual(v);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const Vec3 by = rate(drives[i]);
    for (int d = 0; d < 2; ++d)
      moved[d].derivatives()[max_nodal + static_cast<int>(i)] = by[d];
  }
  return moved;
}

PlacedCorner placed(const geometry::ToolCorner& corner, const geometry::Pose& pose) {
  const auto in_plane = [](const Vec3& v) -> Vec2 { return v.head<2>(); };
  return {in_plane(pose.to_space(corner.centre)), corner.radius,
          in_plane(pose.rotation * corner.from), in_plane(pose.rotation * corner.to)};
}

/// Pressure that needs no depth, as of contact points. (N.10)
double carried(const CornerState& corner, double multiplier, double softening) {
  const PointHistory& history = corner.history;
  const double pressed = history.closed() ? history.pressure - multiplier : 0.0;
  return multiplier + (1.0 - softening) * pressed;
}

/// The place of a face under a corner, with derivatives.
template <class Shape> struct DualFoot {
  Dual step; ///< of its coordinate from where it is
  Dual2 place, normal;
  Dual depth;
};

template <class Shape>
DualFoot<Shape> dual_foot(const OnLine<Shape>& at,
                          const std::array<Dual2, Shape::nodes>& nodes,
                          const Dual2& centre,
                          double radius) {
  const Dual2 x = at.sum(at.N, nodes), along = at.sum(at.dN, nodes), bend = at.sum(at.ddN, nodes);
  const Dual2 off = centre - x;
  constexpr double at_node = 1e-12; // of the face: the way to it has no direction
  if (std::abs(at.xi) == 1.0 && value(off).norm() > at_node * value(along).norm()) {
    const Dual distance = sqrt(off.dot(off));
    return {Dual(0.0), x, off / distance, distance + radius};
  }
  // One step of Newton's method from the root has the root's derivative.
  const double slope = value(off).dot(value(bend)) - value(along).squaredNorm();
  const Dual step = -off.dot(along) / slope;
  const Dual2 place = x + step * along;
  const Dual2 tangent = along + step * bend;
  const Dual length = sqrt(tangent.dot(tangent));
  const Dual2 normal(-tangent.y() / length, tangent.x() / length);
  return {step, place, normal, (centre - place).dot(normal) + radius};
}

/// A corner that moves with its tool, and the free degrees of freedom that move it.
struct DualCorner {
  std::vector<PlaceRate> drives;
  Dual2 centre, from, to;
  double radius;

  DualCorner(const PlacedCorner& place, std::vector<PlaceRate> rates)
      : drives(std::move(rates)), centre(moving(place.centre, drives, velocity)),
        from(turning(place.from)), to(turning(place.to)), radius(place.radius) {}

  static Vec3 velocity(const PlaceRate& rate) { return rate.velocity; }

private:
  [[nodiscard]] Dual2 turning(const Vec2& v) const {
    return moving(v, drives,
                  [&](const PlaceRate& rate) -> Vec3 { return rate.spin.cross(in_space(v)); });
  }
};

/// Nodes of a face now, and where the tool has carried along what was there at the beginning.
template <class Shape> struct DualFace {
  std::array<Dual2, Shape::nodes> now, carried_along;

  DualFace(const CornerContact::At& at, Index face) {
    const LineNodes<Shape> x = line_nodes<Shape>(at.surface, at.trial.x, face);
    const LineNodes<Shape> old = line_nodes<Shape>(at.surface, at.trial.x_old, face);
    for (std::size_t a = 0; a < x.size(); ++a) {
      now[a] = dual(x[a]);
      for (int d = 0; d < 2; ++d)
        now[a][d].derivatives()[static_cast<int>(2 * a) + d] = 1.0;
      const Vec3 there = at.pose.to_space(at.pose_old.to_tool(in_space(old[a])));
      carried_along[a] = moving(there.head<2>(), at.rates(there), DualCorner::velocity);
    }
  }
};

/// The traction of a corner whose metal has slid along the tangent.
///
/// @param normal, along  the frame of its place, in the tool's frame
Traction rub(const CornerContact::At& at,
             const CornerState& corner,
             double pressure,
             double slide,
             const Vec3& normal,
             const Vec3& along) {
  PointHistory start = corner.history;
  start.position = Vec3::Zero();
  if (start.closed()) { // the shear turns with the place
    start.shear = start.shear.dot(Vec3::UnitZ().cross(start.normal)) * along;
    start.normal = normal;
  }
  InterfaceInput in{slide * along, {}};
  in.projection.gap = -pressure / at.penalty.normal;
  in.projection.normal = normal;
  in.shared = SharedPressure{pressure, 0.0};
  in.shear_yield = corner.shear_yield;
  in.dt = at.trial.time - at.trial.time_old;
  in.softening = at.trial.softening.slip;
  return traction(at.friction, at.penalty, start, in, at.surface.scheme());
}

/// What a corner's force adds to the equations of a face's nodes.
template <class Shape> class FaceEquations {
public:
  static constexpr int size = 2 * Shape::nodes;
  using Square = Eigen::Matrix<double, size, size, Eigen::RowMajor>;

  /// @param stiffness  of the penalty along the normal [N/mm]
  FaceEquations(const OnLine<Shape>& line,
                const DualFoot<Shape>& foot,
                const Dual2& force,
                double stiffness) {
    Eigen::Matrix<double, size, 1> gradient;
    for (std::size_t a = 0; a < line.N.size(); ++a)
      for (int d = 0; d < 2; ++d) {
        const int row = static_cast<int>(2 * a) + d;
        const Dual r = -(line.N[a] + line.dN[a] * foot.step) * force[d];
        residual_[row] = r.value();
        tangent_.row(row) = r.derivatives().template head<size>().transpose();
        by_drives_.row(row) = r.derivatives().template tail<max_unknowns - max_nodal>().transpose();
        gradient[row] = line.N[a] * foot.normal[d].value();
      }
    unsymmetric_ = tangent_ - stiffness * gradient * gradient.transpose();
  }

  void add(const ContactSurface& surface,
           const mechanics::BlockPattern& pattern,
           Index face,
           std::span<const PlaceRate> drives,
           mechanics::System& system) const {
    system.symmetric = false;
    surface.scatter().add(2, face, residual_.data(), system.residual);
    surface.scatter().add(pattern, face, tangent_.data(), system.tangent.values);
    surface.scatter().list(pattern, face, unsymmetric_.data(), system.tangent.unsymmetric);
    const auto nodes = surface.scatter().nodes(face);
    for (std::size_t i = 0; i < drives.size(); ++i)
      for (int row = 0; row < size; ++row)
        system.borders[drives[i].drive].column[idx(2 * nodes[idx(row / 2)] + row % 2)] +=
            by_drives_(row, static_cast<int>(i));
  }

private:
  Eigen::Matrix<double, size, 1> residual_;
  Square tangent_, unsymmetric_;
  Eigen::Matrix<double, size, max_unknowns - max_nodal> by_drives_;
};

/// What a corner's force does over the rates of its tool's free degrees of freedom. (C.14)
///
/// @param arm  from the corner's centre to where it presses
void add_to_drives(const DualCorner& corner,
                   const Dual2& arm,
                   const Dual2& force,
                   std::span<const Index> nodes,
                   std::size_t n_dofs,
                   mechanics::System& system) {
  for (const PlaceRate& drive : corner.drives) {
    // The axis of a turn travels with the tool, as the corner does, so only turns change it.
    const Dual2 of_centre =
        moving(drive.velocity.head<2>(), corner.drives, [&](const PlaceRate& by) -> Vec3 {
          return by.spin.isZero(0.0) ? by.spin : Vec3(drive.spin.cross(by.velocity));
        });
    const Dual r = force.dot(of_centre + drive.spin.z() * Dual2(-arm.y(), arm.x()));
    mechanics::Border& border = system.borders[drive.drive];
    system.residual[n_dofs + drive.drive] += r.value();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int d = 0; d < 2; ++d)
        border.row[idx(2 * nodes[a] + d)] += r.derivatives()[static_cast<int>(2 * a) + d];
    for (std::size_t j = 0; j < corner.drives.size(); ++j)
      border.corner[corner.drives[j].drive] += r.derivatives()[max_nodal + static_cast<int>(j)];
  }
}

} // namespace

struct CornerContact::Pressing {
  PlacedCorner place;
  CornerFoot foot;
  const CornerState& state;
  double carried; ///< pressure that needs no depth [MPa]
};

CornerContact::CornerContact(const ContactSurface& surface, const geometry::RigidSurface& tool) {
  if (surface.analysis() == mechanics::Analysis::solid || surface.n_faces() == 0)
    return;
  shapes_ = tool.corners(min_turn);
  if (shapes_.empty())
    return;
  search_ = CornerSearch(surface);
  for (Index f = 0; f < surface.n_faces(); ++f)
    largest_depth_ = std::max(largest_depth_, surface.depth(f));
}

void add_corner_forces(const ContactSurface& surface,
                       std::span<const CornerState> corners,
                       std::span<double> forces) {
  for (const CornerState& corner : corners)
    if (const auto& foot = corner.press.foot)
      visit_line(surface.kind(), [&](auto shape) {
        const auto nodes = surface.scatter().nodes(foot->face);
        const auto N = decltype(shape)::values({foot->xi});
        for (std::size_t a = 0; a < N.size(); ++a)
          for (int d = 0; d < 2; ++d)
            forces[idx(2 * nodes[a] + d)] += N[a] * corner.press.force[d];
      });
}

std::vector<CornerState> CornerContact::mapped(std::span<const CornerState> before,
                                               const Placed& tool,
                                               double penalty) const {
  std::vector<CornerState> now(shapes_.size());
  for (std::size_t c = 0; c < shapes_.size(); ++c) {
    PointHistory& history = now[c].history;
    const double slack = still_presses * largest_depth_;
    const auto foot = search_.find(tool.surface, tool.x, placed(shapes_[c], tool.pose), slack);
    history = PointHistory{.sliding = before[c].history.sliding};
    now[c].shear_yield = before[c].shear_yield;
    if (foot && before[c].history.closed()) {
      history = before[c].history;
      history.offset = foot->depth - (history.pressure - history.multiplier) / penalty;
    } else if (foot) {
      history.offset = std::max(0.0, foot->depth); // touches without pressure, if at all
    }
  }
  return now;
}

int CornerContact::add(const At& at,
                       std::span<const CornerState> committed,
                       std::span<CornerTrial> trial,
                       mechanics::System& system) const {
  int changes = 0;
  Box around; // of the faces; most corners of a knurled roll are far from them
  if (!shapes_.empty())
    for (Index f = 0; f < at.surface.n_faces(); ++f)
      for (const Index node : at.surface.scatter().nodes(f))
        around.add(in_space({at.trial.x[idx(2 * node)], at.trial.x[idx(2 * node + 1)]}));
  for (std::size_t c = 0; c < shapes_.size(); ++c) {
    CornerPress& now = trial[c].press;
    const Status before = now.traction.status;
    now = CornerPress{};
    PlacedCorner place = placed(shapes_[c], at.pose);
    place.radius -= at.drawn_back; // below zero it is farther away than the corner
    const double softening = at.trial.softening.penetration;
    const double needs_no_depth = carried(committed[c], trial[c].multiplier, softening);
    const double slack = std::max(0.0, needs_no_depth / (softening * at.penalty.normal) -
                                           committed[c].history.offset);
    const double margin = std::abs(place.radius) + slack + largest_depth_;
    Box here;
    here.add(in_space(place.centre));
    const auto foot = around.overlaps(here, margin)
                          ? search_.find(at.surface, at.trial.x, place, slack)
                          : std::nullopt;
    if (foot)
      visit_line(at.surface.kind(), [&](auto shape) {
        press<decltype(shape)>(at, {place, *foot, committed[c], needs_no_depth}, now, system);
      });
    changes += now.traction.status != before ? 1 : 0;
  }
  return changes;
}

template <class Shape>
void CornerContact::press(const At& at,
                          const Pressing& corner,
                          CornerPress& trial,
                          mechanics::System& system) const {
  const auto& [place, foot, state, carried] = corner;
  const OnLine<Shape> line(foot.xi);
  const DualCorner dual_corner(place, at.rates(in_space(place.centre)));
  const DualFace<Shape> face(at, foot.face);
  const DualFoot<Shape> on_face =
      dual_foot<Shape>(line, face.now, dual_corner.centre, place.radius);
  const Dual2& n = on_face.normal;
  const Dual facing = taken_over<Dual>(cross_of(dual_corner.from, n)) *
                      taken_over<Dual>(cross_of(n, dual_corner.to));
  const double softening = at.trial.softening.penetration;
  const Dual pressure =
      facing * (softening * at.penalty.normal * (on_face.depth - state.history.offset) + carried);
  if (!(pressure.value() > 0.0))
    return;

  // The material slides along the tangent, from where it was under the tool.
  const Dual2 tangent(-n.y(), n.x());
  const Dual2 was =
      line.sum(line.N, face.carried_along) + on_face.step * line.sum(line.dN, face.carried_along);
  const Dual slide = (on_face.place - was).dot(tangent);
  const Mat3 to_tool = at.pose.rotation.transpose();
  const Vec3 along = to_tool * in_space(value(tangent));
  trial.traction =
      rub(at, state, pressure.value(), slide.value(), to_tool * in_space(value(n)), along);
  const Traction& T = trial.traction;
  if (T.status == Status::open)
    return;
  Dual shear(T.shear.dot(along));
  shear.derivatives() = along.dot(T.dtraction_dx * along) * slide.derivatives() +
                        along.dot(T.dtraction_dp) * pressure.derivatives();

  // A point of half an element, and its way around the axis.
  const std::array<double, 2>& depths = search_.depths(foot.face);
  const bool turns = at.surface.analysis() == mechanics::Analysis::axisymmetric;
  const double around = turns ? 2.0 * std::numbers::pi * std::max(0.0, place.centre.x()) : 1.0;
  trial.foot = foot;
  trial.depth = 0.5 * ((1.0 - foot.xi) * depths[0] + (1.0 + foot.xi) * depths[1]);
  const Dual area = 0.5 * around * (trial.depth + 0.5 * (depths[1] - depths[0]) * on_face.step);
  trial.area = area.value();
  const Dual2 force = area * (pressure * n + shear * tangent);
  trial.force = in_space(value(force));
  trial.place = in_space(place.centre + place.radius * value(n));

  const double stiffness = trial.area * softening * at.penalty.normal * facing.value();
  FaceEquations<Shape>(line, on_face, force, stiffness)
      .add(at.surface, at.pattern, foot.face, dual_corner.drives, system);
  add_to_drives(dual_corner, place.radius * n, force, at.surface.scatter().nodes(foot.face),
                idx(at.pattern.n_dofs()), system);
}

} // namespace billet::contact
