#include "contact/term/drive_equations.h"

#include "contact/term/averaged_faces.h"
#include "mechanics/equilibrium/faces.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <span>

namespace billet::contact {

namespace {

/// Row, column and residual of a free degree of freedom q: with the velocity v of the tool's
/// material at a point for dq = 1, r_q = sum dA T . v - load. (C.14)
template <class Shape, class Rule> class DriveBorder {
public:
  DriveBorder(const ContactView& contact,
              std::size_t drive,
              const mechanics::Trial& trial,
              mechanics::System& system)
      : model_(contact.model), contact_(contact), drive_(drive), trial_(trial), system_(system),
        tool_(contact.state.tools[model_.drives[drive].tool]), tried_(tool_.trial) {}

  void add() {
    for (std::size_t k = 0; k < tried_.traction.size(); ++k)
      if (tried_.traction[k].status != Status::open)
        add_point(k);
  }

private:
  static constexpr int dim = Shape::dim + 1;
  using Place = mechanics::FacePoint<Shape>;

  /// A point, and what its traction does.
  struct AtPoint {
    std::size_t k;
    int i; ///< of its face
    std::span<const Index> nodes;
    Vec3 T;                       ///< in space [MPa]
    Mat3 D;                       ///< d T / d x [MPa/mm]
    Vec3 dT_dp;                   ///< [-]
    DriveRate rate;               ///< of the tool there
    const FacePressure* averaged; ///< null: the pressure follows from the point's own gap
  };

  [[nodiscard]] DriveRate rate(const DriveUnknown& drive, std::size_t point) const {
    return model_.drive_rate(drive, trial_.time, trial_.x, contact_.state.positions[point]);
  }
  /// Normal at the foot of a point, in space.
  [[nodiscard]] Vec3 normal(std::size_t point) const {
    return tried_.rotation * tried_.foot[point].normal;
  }
  /// What a drive changes of the traction by the gaps of the face's other points. (C.45)
  [[nodiscard]] Vec3 by_others(const AtPoint& at, const DriveUnknown& unknown) const {
    Vec3 change = Vec3::Zero();
    for (int j = 0; at.averaged != nullptr && j < Rule::points; ++j)
      if (j != at.i) {
        const std::size_t by = at.k - idx(at.i) + idx(j);
        const Vec3 v = rate(unknown, by).velocity;
        change -= at.averaged->d_gap(at.i, j) * v.dot(normal(by)) * at.dT_dp;
      }
    return change;
  }

  void add_point(std::size_t k) {
    const Mat3& R = tried_.rotation;
    const Traction& traction = tried_.traction[k];
    const AtPoint at{k,
                     static_cast<int>(k % idx(Rule::points)),
                     model_.surface->scatter().nodes(model_.face_of(k)),
                     R * traction.traction,
                     R * traction.dtraction_dx * R.transpose(),
                     R * traction.dtraction_dp,
                     rate(model_.drives[drive_], k),
                     averaged_pressure(tool_, model_.face_of(k))};
    std::array<double, static_cast<std::size_t>(Shape::nodes * dim)> local{};
    mechanics::gather(trial_.x, at.nodes, dim, local.data());
    const Place place(model_.surface->analysis(), local.data(), Rule::point(at.i),
                      Rule::weight(at.i));
    add_row_of_others(at, place.measure);
    add_row_and_column(at, place);
    add_corner(at, place.measure);
  }

  /// On averaged faces the pressure goes with the gaps of the other points, too. (C.45)
  void add_row_of_others(const AtPoint& at, double measure) {
    mechanics::Border& border = system_.borders[drive_];
    for (int j = 0; at.averaged != nullptr && j < Rule::points; ++j) {
      const std::size_t by = at.k - idx(at.i) + idx(j);
      if (j == at.i || at.averaged->d_gap(at.i, j) == 0.0)
        continue;
      const auto N = Shape::values(Rule::point(j));
      const Vec3 change =
          measure * at.dT_dp.dot(at.rate.velocity) * at.averaged->d_gap(at.i, j) * normal(by);
      for (std::size_t a = 0; a < Shape::nodes; ++a)
        for (int d = 0; d < dim; ++d)
          border.row[idx(at.nodes[a] * dim + d)] += N[a] * change[d];
    }
  }

  void add_row_and_column(const AtPoint& at, const Place& place) {
    mechanics::Border& border = system_.borders[drive_];
    Vec3 dT_dq = at.rate.spin.cross(at.T) - at.D * at.rate.velocity;
    const Vec3 row = at.D.transpose() * at.rate.velocity + at.T.cross(at.rate.spin);
    dT_dq += by_others(at, model_.drives[drive_]);
    system_.residual[idx(model_.pattern->n_dofs()) + drive_] +=
        place.measure * at.T.dot(at.rate.velocity);
    for (std::size_t a = 0; a < Shape::nodes; ++a)
      for (int d = 0; d < dim; ++d) {
        const auto unknown = idx(at.nodes[a] * dim + d);
        border.column[unknown] -= place.N[a] * place.measure * dT_dq[d];
        border.row[unknown] +=
            place.N[a] * place.measure * row[d] + at.T.dot(at.rate.velocity) * place.dmeasure[a][d];
      }
  }

  /// What all drives of the tool change of this one's equation.
  void add_corner(const AtPoint& at, double measure) {
    for (std::size_t other = 0; other < model_.drives.size(); ++other) {
      const DriveUnknown& unknown = model_.drives[other];
      if (unknown.tool != model_.drives[drive_].tool || !contact_.follows(unknown, trial_.time))
        continue;
      const DriveRate by = rate(unknown, at.k);
      // The axis of a turn travels with the tool.
      const Vec3 dv = unknown.turns ? Vec3(Vec3::Zero()) : Vec3(-at.rate.spin.cross(by.velocity));
      system_.borders[drive_].corner[other] +=
          measure *
          (at.rate.velocity.dot(by.spin.cross(at.T) - at.D * by.velocity + by_others(at, unknown)) +
           at.T.dot(dv));
    }
  }

  const ContactModel& model_;
  const ContactView& contact_;
  std::size_t drive_;
  const mechanics::Trial& trial_;
  mechanics::System& system_;
  const ToolContact& tool_;
  const TrialContact& tried_;
};

} // namespace

void add_drive_loads(const ContactView& contact,
                     const mechanics::Trial& trial,
                     mechanics::System& system) {
  const ContactModel& model = contact.model;
  const auto n = idx(model.pattern->n_dofs());
  for (std::size_t j = 0; j < model.drives.size(); ++j) {
    const auto& [tool, turns] = model.drives[j];
    const geometry::Motion& motion = model.tools[tool].motion;
    const double load = turns ? motion.torque->load(trial.time) / model.scale.length
                              : motion.force->load(trial.time);
    system.residual[n + j] += model.scale.stiffness * (trial.x[n + j] - trial.x_old[n + j]) -
                              (contact.follows(model.drives[j], trial.time) ? load : 0.0);
    system.borders[j].corner[j] += model.scale.stiffness;
  }
}

void add_drive_borders(const ContactView& contact,
                       const mechanics::Trial& trial,
                       mechanics::System& system) {
  const ContactModel& model = contact.model;
  const ContactSurface& surface = *model.surface;
  visit_contact_face(surface.kind(), surface.form(), [&](auto shape, auto rule) {
    for (std::size_t j = 0; j < model.drives.size(); ++j)
      if (contact.follows(model.drives[j], trial.time))
        DriveBorder<decltype(shape), decltype(rule)>(contact, j, trial, system).add();
  });
  for (std::size_t j = 0; j < model.drives.size(); ++j)
    if (model.drives[j].turns && contact.follows(model.drives[j], trial.time)) {
      const std::size_t tool = model.drives[j].tool;
      const FaceStabilization& springs = contact.state.tools[tool].committed.stabilization;
      const Vec3 spin = model.tools[tool].motion.torque->axis / model.scale.length;
      const geometry::Pose pose = model.pose(tool, trial.time, trial.x);
      const FaceStabilization::Turning turning{pose.rotation, model.tools[tool].reference};
      system.residual[idx(model.pattern->n_dofs()) + j] +=
          spin.dot(springs.moment_about(turning, surface, trial.x));
      springs.add_moment_row(turning, surface, trial.x, spin, system.borders[j].row);
    }
}

} // namespace billet::contact
