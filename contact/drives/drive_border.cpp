// The equations of tools that a force or a torque drives: loads, borders of the tangent, and where
// the tools are. (C.14)

#include "contact/term/contact_term.h"
#include "mechanics/equilibrium/faces.h"

#include <Eigen/Geometry>

#include <array>

namespace billet::contact {

namespace {

using mechanics::FacePoint;

} // namespace

void ContactTerm::add_loads(const mechanics::Trial& trial, mechanics::System& system) const {
  const auto n = idx(pattern_->n_dofs());
  for (std::size_t j = 0; j < drives_.size(); ++j) {
    const auto& [tool, turns] = drives_[j];
    const geometry::Motion& motion = tools_[tool].motion;
    const double load =
        turns ? motion.torque->load(trial.time) / scale_.length : motion.force->load(trial.time);
    system.residual[n + j] += scale_.stiffness * (trial.x[n + j] - trial.x_old[n + j]) -
                              (follows(drives_[j], trial.time) ? load : 0.0);
    system.borders[j].corner[j] += scale_.stiffness;
  }
}

void ContactTerm::add_borders(const mechanics::Trial& trial, mechanics::System& system) const {
  visit_contact_face(surface_->kind(), surface_->form(), [&](auto shape, auto rule) {
    for (std::size_t j = 0; j < drives_.size(); ++j)
      if (follows(drives_[j], trial.time))
        add_border_of<decltype(shape), decltype(rule)>(j, trial, system);
  });
  for (std::size_t j = 0; j < drives_.size(); ++j)
    if (drives_[j].turns && follows(drives_[j], trial.time)) {
      const FaceStabilization& springs = states_[drives_[j].tool].stabilization;
      const Vec3 spin = tools_[drives_[j].tool].motion.torque->axis / scale_.length;
      system.residual[idx(pattern_->n_dofs()) + j] += spin.dot(springs.moment(*surface_, trial.x));
      springs.add_moment_row(*surface_, trial.x, spin, system.borders[j].row);
    }
}

/// Row, column and residual of a free degree of freedom q: with the velocity v of the tool's
/// material at a point for dq = 1, r_q = sum dA T . v - load. (C.14)
template <class Shape, class Rule>
void ContactTerm::add_border_of(std::size_t drive,
                                const mechanics::Trial& trial,
                                mechanics::System& system) const {
  constexpr int dim = Shape::dim + 1;
  const auto n = idx(pattern_->n_dofs());
  const std::size_t tool = drives_[drive].tool;
  const ToolState& state = states_[tool];
  mechanics::Border& border = system.borders[drive];
  std::array<double, static_cast<std::size_t>(Shape::nodes * dim)> local{};
  for (std::size_t k = 0; k < state.trial.size(); ++k) {
    if (state.trial[k].status == Status::open)
      continue;
    const auto nodes = surface_->scatter().nodes(face_of(k));
    const int i = static_cast<int>(k % idx(Rule::points));
    mechanics::gather(trial.x, nodes, dim, local.data());
    const FacePoint<Shape> at(surface_->analysis(), local.data(), Rule::point(i), Rule::weight(i));
    const Vec3 T = state.rotation * state.trial[k].traction;
    const Mat3 D = state.rotation * state.trial[k].dtraction_dx * state.rotation.transpose();
    const DriveRate rate = drive_rate(drives_[drive], trial.time, trial.x, positions_[k]);
    Vec3 dT_dq = rate.spin.cross(T) - D * rate.velocity;
    const Vec3 row = D.transpose() * rate.velocity + T.cross(rate.spin);
    // On even faces the pressure goes with the gaps of the other points, too. (C.45)
    const EvenFace* even = even_face(state, k);
    const Vec3 dT_dp = state.rotation * state.trial[k].dtraction_dp;
    const auto by_others = [&](const DriveUnknown& unknown) {
      Vec3 change = Vec3::Zero();
      for (int j = 0; even != nullptr && j < Rule::points; ++j)
        if (j != i) {
          const std::size_t by = k - idx(i) + idx(j);
          const Vec3 v = drive_rate(unknown, trial.time, trial.x, positions_[by]).velocity;
          change -= even->now.d_gap(i, j) * v.dot(state.rotation * state.foot[by].normal) * dT_dp;
        }
      return change;
    };
    dT_dq += by_others(drives_[drive]);
    for (int j = 0; even != nullptr && j < Rule::points; ++j) {
      const std::size_t by = k - idx(i) + idx(j);
      if (j == i || even->now.d_gap(i, j) == 0.0)
        continue;
      const auto N = Shape::values(Rule::point(j));
      const Vec3 change = at.measure * dT_dp.dot(rate.velocity) * even->now.d_gap(i, j) *
                          (state.rotation * state.foot[by].normal);
      for (std::size_t a = 0; a < Shape::nodes; ++a)
        for (int d = 0; d < dim; ++d)
          border.row[idx(nodes[a] * dim + d)] += N[a] * change[d];
    }
    system.residual[n + drive] += at.measure * T.dot(rate.velocity);
    for (std::size_t a = 0; a < Shape::nodes; ++a)
      for (int d = 0; d < dim; ++d) {
        const auto unknown = idx(nodes[a] * dim + d);
        border.column[unknown] -= at.N[a] * at.measure * dT_dq[d];
        border.row[unknown] +=
            at.N[a] * at.measure * row[d] + T.dot(rate.velocity) * at.dmeasure[a][d];
      }
    for (std::size_t other = 0; other < drives_.size(); ++other) {
      if (drives_[other].tool != tool || !follows(drives_[other], trial.time))
        continue;
      const DriveRate by = drive_rate(drives_[other], trial.time, trial.x, positions_[k]);
      // The axis of a turn travels with the tool.
      const Vec3 dv =
          drives_[other].turns ? Vec3(Vec3::Zero()) : Vec3(-rate.spin.cross(by.velocity));
      border.corner[other] +=
          at.measure *
          (rate.velocity.dot(by.spin.cross(T) - D * by.velocity + by_others(drives_[other])) +
           T.dot(dv));
    }
  }
}

ContactTerm::DriveRate ContactTerm::drive_rate(const DriveUnknown& drive,
                                               double time,
                                               std::span<const double> x,
                                               const Vec3& position) const {
  const geometry::Motion& motion = tools_[drive.tool].motion;
  if (!drive.turns)
    return {motion.force->axis, Vec3::Zero()};
  const Vec3 on_axis =
      motion.torque->point + motion.offset + motion.translation(time, driven(drive.tool, x));
  const Vec3 spin = motion.torque->axis / scale_.length;
  return {spin.cross(position - on_axis), spin};
}

geometry::Driven ContactTerm::driven(std::size_t tool, std::span<const double> x) const {
  const auto n = idx(pattern_->n_dofs());
  geometry::Driven driven;
  for (std::size_t j = 0; j < drives_.size(); ++j)
    if (drives_[j].tool == tool)
      (drives_[j].turns ? driven.turn : driven.travel) =
          drives_[j].turns ? x[n + j] / scale_.length : x[n + j];
  return driven;
}

std::vector<DriveUnknown> drive_unknowns(std::span<const Tool> tools) {
  std::vector<DriveUnknown> drives;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (tools[t].motion.force)
      drives.push_back({t, false});
    if (tools[t].motion.torque)
      drives.push_back({t, true});
  }
  return drives;
}

} // namespace billet::contact
