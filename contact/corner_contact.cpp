#include "contact/corner_contact.h"

#include "contact/line_face.h"
#include "geometry/base/box.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/AutoDiff>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace billet::contact {

namespace {

/// Corners and roundings turn by more than this [rad].
constexpr double least_turn = 10.0 * std::numbers::pi / 180.0;
/// Of the element beneath: as far outside a new mesh a corner that pressed on the old one still
/// does.
constexpr double still_presses = 0.02;

/// Coordinates of the nodes of a face, then the travel and the turn of the tool.
constexpr int most_nodal = 6;
constexpr int most_unknowns = 8;
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, most_unknowns, 1>>;
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
      moved[d].derivatives()[most_nodal + static_cast<int>(i)] = by[d];
  }
  return moved;
}

PlacedCorner placed(const geometry::ToolCorner& corner, const geometry::Pose& pose) {
  const auto in_plane = [](const Vec3& v) -> Vec2 { return v.head<2>(); };
  return {in_plane(pose.to_space(corner.centre)), corner.radius,
          in_plane(pose.rotation * corner.from), in_plane(pose.rotation * corner.to)};
}

/// Pressure that needs no depth, as of contact points. (N.10)
double carried(const CornerContact::Corner& corner, double softening) {
  const PointHistory& history = corner.history;
  const double pressed = history.closed() ? history.pressure - corner.multiplier : 0.0;
  return corner.multiplier + (1.0 - softening) * pressed;
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
  if (std::abs(at.xi) == 1.0) {
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

} // namespace

CornerContact::CornerContact(const ContactSurface& surface, const geometry::RigidSurface& tool) {
  if (surface.analysis() == mechanics::Analysis::solid || surface.n_faces() == 0)
    return;
  for (geometry::ToolCorner& shape : tool.corners(least_turn))
    corners_.push_back({.shape = shape});
  if (corners_.empty())
    return;
  search_ = CornerSearch(surface);
  for (Index f = 0; f < surface.n_faces(); ++f)
    largest_depth_ = std::max(largest_depth_, surface.depth(f));
}

void CornerContact::part() {
  for (Corner& corner : corners_)
    corner.trial = CornerPress{};
}

void CornerContact::release(const ContactSurface& surface, std::span<double> forces) {
  for (Corner& corner : corners_) {
    if (const auto& foot = corner.committed.foot)
      visit_line(surface.kind(), [&](auto shape) {
        const auto nodes = surface.scatter().nodes(foot->face);
        const auto N = decltype(shape)::values({foot->xi});
        for (std::size_t a = 0; a < N.size(); ++a)
          for (int d = 0; d < 2; ++d)
            forces[idx(2 * nodes[a] + d)] += N[a] * corner.committed.force[d];
      });
    corner = Corner{.shape = corner.shape};
  }
}

void CornerContact::go_on_from(std::span<const Corner> before,
                               const ContactSurface& surface,
                               const geometry::Pose& pose,
                               std::span<const double> x,
                               double penalty) {
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    PointHistory& history = corners_[c].history;
    const double slack = still_presses * largest_depth_;
    const auto foot = search_.find(surface, x, placed(corners_[c].shape, pose), slack);
    history = PointHistory{.sliding = before[c].history.sliding};
    corners_[c].strength = before[c].strength;
    if (foot && before[c].history.closed()) {
      history = before[c].history;
      history.offset = foot->depth - (history.pressure - history.multiplier) / penalty;
    } else if (foot) {
      history.offset = std::max(0.0, foot->depth); // touches without pressure, if at all
    }
    corners_[c].multiplier = history.multiplier;
  }
}

int CornerContact::add(const ContactSurface& surface,
                       const mechanics::BlockPattern& pattern,
                       const At& at,
                       mechanics::System& system) {
  int changes = 0;
  Box around; // of the faces; most corners of a knurled roll are far from them
  if (!corners_.empty())
    for (Index f = 0; f < surface.n_faces(); ++f)
      for (const Index node : surface.scatter().nodes(f))
        around.add(in_space({at.trial.x[idx(2 * node)], at.trial.x[idx(2 * node + 1)]}));
  for (Corner& corner : corners_) {
    const Status before = corner.trial.traction.status;
    corner.trial = CornerPress{};
    PlacedCorner place = placed(corner.shape, at.pose);
    place.radius -= at.drawn_back; // below zero it is farther away than the corner
    const double softening = at.trial.softening.penetration;
    const double slack = std::max(
        0.0, carried(corner, softening) / (softening * at.penalty.normal) - corner.history.offset);
    const double margin = std::abs(place.radius) + slack + largest_depth_;
    Box here;
    here.add(in_space(place.centre));
    const auto foot = around.overlaps(here, margin)
                          ? search_.find(surface, at.trial.x, place, slack)
                          : std::nullopt;
    if (foot)
      visit_line(surface.kind(), [&](auto shape) {
        press<decltype(shape)>(surface, pattern, at, place, *foot, corner, system);
      });
    changes += corner.trial.traction.status != before ? 1 : 0;
  }
  return changes;
}

template <class Shape>
void CornerContact::press(const ContactSurface& surface,
                          const mechanics::BlockPattern& pattern,
                          const At& at,
                          const PlacedCorner& place,
                          const CornerFoot& foot,
                          Corner& corner,
                          mechanics::System& system) const {
  constexpr auto n_nodes = std::size_t{Shape::nodes};
  const auto numbers = surface.scatter().nodes(foot.face);
  const OnLine<Shape> line(foot.xi);
  const auto spin = [](const Vec2& v) {
    return [v = in_space(v)](const PlaceRate& rate) -> Vec3 { return rate.spin.cross(v); };
  };
  const auto velocity = [](const PlaceRate& rate) { return rate.velocity; };

  const std::vector<PlaceRate> drives = at.rates(in_space(place.centre));
  const Dual2 centre = moving(place.centre, drives, velocity);
  const Dual2 from = moving(place.from, drives, spin(place.from));
  const Dual2 to = moving(place.to, drives, spin(place.to));
  std::array<Dual2, n_nodes> nodes, before; // now, and carried along by the tool since then
  const LineNodes<Shape> now = line_nodes<Shape>(surface, at.trial.x, foot.face);
  const LineNodes<Shape> old = line_nodes<Shape>(surface, at.trial.x_old, foot.face);
  for (std::size_t a = 0; a < n_nodes; ++a) {
    nodes[a] = dual(now[a]);
    for (int d = 0; d < 2; ++d)
      nodes[a][d].derivatives()[static_cast<int>(2 * a) + d] = 1.0;
    const Vec3 carried_along = at.pose.to_space(at.pose_old.to_tool(in_space(old[a])));
    before[a] = moving(carried_along.head<2>(), at.rates(carried_along), velocity);
  }

  const DualFoot<Shape> on_face = dual_foot<Shape>(line, nodes, centre, place.radius);
  const Dual2& n = on_face.normal;
  const Dual facing = taken_over<Dual>(cross_of(from, n)) * taken_over<Dual>(cross_of(n, to));
  const double softening = at.trial.softening.penetration;
  const PointHistory& history = corner.history;
  const Dual pressure = facing * (softening * at.penalty.normal * (on_face.depth - history.offset) +
                                  carried(corner, softening));
  if (!(pressure.value() > 0.0))
    return;

  // The material slides along the tangent, from where it was under the tool.
  const Dual2 tangent(-n.y(), n.x());
  const Dual2 was = line.sum(line.N, before) + on_face.step * line.sum(line.dN, before);
  const Dual slide = (on_face.place - was).dot(tangent);
  const Mat3 to_tool = at.pose.rotation.transpose();
  const Vec3 normal = to_tool * in_space(value(n));
  const Vec3 along = to_tool * in_space(value(tangent));
  PointHistory start = history;
  start.position = Vec3::Zero();
  if (history.closed()) {
    start.normal = normal;
    start.shear = history.shear.dot(Vec3::UnitZ().cross(history.normal)) * along;
  }
  InterfaceInput in{slide.value() * along, {}};
  in.projection.gap = -on_face.depth.value();
  in.projection.normal = normal;
  in.shared = SharedPressure{pressure.value(), 0.0};
  in.strength = corner.strength;
  in.dt = at.trial.time - at.trial.time_old;
  in.softening = at.trial.softening.slip;
  CornerPress& trial = corner.trial;
  trial.traction = traction(at.friction, at.penalty, start, in, surface.scheme());
  const Traction& T = trial.traction;
  if (T.status == Status::open)
    return;

  // A point of half an element, and its way around the axis.
  const std::array<double, 2>& depths = search_.depths(foot.face);
  const bool turns = surface.analysis() == mechanics::Analysis::axisymmetric;
  const double around = turns ? 2.0 * std::numbers::pi * std::max(0.0, place.centre.x()) : 1.0;
  Dual shear(T.shear.dot(along));
  shear.derivatives() = along.dot(T.dtraction_dx * along) * slide.derivatives() +
                        along.dot(T.dtraction_dp) * pressure.derivatives();
  trial.foot = foot;
  trial.depth = 0.5 * ((1.0 - foot.xi) * depths[0] + (1.0 + foot.xi) * depths[1]);
  const Dual area = 0.5 * around * (trial.depth + 0.5 * (depths[1] - depths[0]) * on_face.step);
  trial.area = area.value();
  const Dual2 force = area * (pressure * n + shear * tangent);
  trial.force = in_space(value(force));
  trial.place = in_space(place.centre + place.radius * value(n));

  constexpr int size = 2 * Shape::nodes;
  using Square = Eigen::Matrix<double, size, size, Eigen::RowMajor>;
  Eigen::Matrix<double, size, 1> residual, gradient;
  Square tangent_matrix;
  for (std::size_t a = 0; a < n_nodes; ++a)
    for (int d = 0; d < 2; ++d) {
      const int row = static_cast<int>(2 * a) + d;
      const Dual r = -(line.N[a] + line.dN[a] * on_face.step) * force[d];
      residual[row] = r.value();
      tangent_matrix.row(row) = r.derivatives().template head<size>().transpose();
      gradient[row] = line.N[a] * n[d].value();
      for (std::size_t i = 0; i < drives.size(); ++i)
        system.borders[drives[i].drive].column[idx(2 * numbers[a] + d)] +=
            r.derivatives()[most_nodal + static_cast<int>(i)];
    }
  const double stiffness = trial.area * softening * at.penalty.normal * facing.value();
  const Square unsymmetric = tangent_matrix - stiffness * gradient * gradient.transpose();
  system.symmetric = false;
  surface.scatter().add(2, foot.face, residual.data(), system.residual);
  surface.scatter().add(pattern, foot.face, tangent_matrix.data(), system.tangent.values);
  surface.scatter().list(pattern, foot.face, unsymmetric.data(), system.tangent.unsymmetric);

  // A free degree of freedom of the tool: what the force does over its rate. (C.14)
  const Dual2 on_tool = centre + place.radius * n;
  const auto first = idx(pattern.n_dofs());
  for (const PlaceRate& drive : drives) {
    // The axis of a turn travels with the tool, as the corner does, so only turns change it.
    const Dual2 of_centre =
        moving(drive.velocity.head<2>(), drives, [&](const PlaceRate& by) -> Vec3 {
          return by.spin.isZero(0.0) ? by.spin : Vec3(drive.spin.cross(by.velocity));
        });
    const Dual2 arm = on_tool - centre;
    const double spin_z = drive.spin.z();
    const Dual r = force.dot(of_centre + spin_z * Dual2(-arm.y(), arm.x()));
    mechanics::Border& border = system.borders[drive.drive];
    system.residual[first + drive.drive] += r.value();
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (int d = 0; d < 2; ++d)
        border.row[idx(2 * numbers[a] + d)] += r.derivatives()[static_cast<int>(2 * a) + d];
    for (std::size_t j = 0; j < drives.size(); ++j)
      border.corner[drives[j].drive] += r.derivatives()[most_nodal + static_cast<int>(j)];
  }
}

} // namespace billet::contact
