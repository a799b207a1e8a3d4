#include "contact/term/traction_sum.h"

#include "contact/term/averaged_faces.h"
#include "mechanics/equilibrium/faces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>

namespace billet::contact {

namespace {

using mechanics::FacePoint;

/// The derivative of a traction without what couples its shear to the pressure, and symmetric: a
/// stiff normal and a soft tangential spring. (C.40)
Mat3 without_coupling(const Mat3& D, const Vec3& n) {
  const Mat3 plane = Mat3::Identity() - n * n.transpose();
  const Mat3 tangential = plane * D * plane;
  return n.dot(D * n) * n * n.transpose() + 0.5 * (tangential + tangential.transpose());
}

} // namespace

void TractionSum::clear() {
  std::fill(traction_.begin(), traction_.end(), Vec3::Zero());
  std::fill(dtraction_.begin(), dtraction_.end(), Mat3::Zero());
  std::fill(symmetric_.begin(), symmetric_.end(), Mat3::Zero());
  std::fill(touched_.begin(), touched_.end(), char{0});
}

void TractionSum::add(const TrialContact& tool, const geometry::Pose& pose) {
  for (std::size_t k = 0; k < tool.traction.size(); ++k) {
    if (tool.traction[k].status == Status::open)
      continue;
    touched_[k] = 1;
    traction_[k] += pose.rotation * tool.traction[k].traction;
    const Mat3& D = tool.traction[k].dtraction_dx;
    dtraction_[k] += pose.rotation * D * pose.rotation.transpose();
    symmetric_[k] +=
        pose.rotation * without_coupling(D, tool.foot[k].normal) * pose.rotation.transpose();
  }
}

bool TractionSum::touches(std::size_t first, int points) const {
  const auto begin = touched_.begin() + static_cast<std::ptrdiff_t>(first);
  return std::any_of(begin, begin + points, [](char c) { return c != 0; });
}

/// What tractions put on the nodes of one face.
template <class Shape, class Rule> class TractionSum::FaceEquations {
public:
  static constexpr int dim = Shape::dim + 1;
  static constexpr int size = Shape::nodes * dim;
  using Square = Eigen::Matrix<double, size, size, Eigen::RowMajor>;

  FaceEquations(const ContactSurface& surface, std::span<const double> x, Index face)
      : face_(face), first_(idx(face * Rule::points)) {
    std::array<double, std::size_t{size}> local{};
    mechanics::gather(x, surface.scatter().nodes(face), dim, local.data());
    places_.reserve(Rule::points);
    for (int i = 0; i < Rule::points; ++i)
      places_.emplace_back(surface.analysis(), local.data(), Rule::point(i), Rule::weight(i));
  }

  /// Adds what the points bear.
  void add(const TractionSum& sum) {
    for (int i = 0; i < Rule::points; ++i) {
      const std::size_t k = first_ + idx(i);
      if (sum.touched_[k] == 0)
        continue;
      const FacePoint<Shape>& at = places_[idx(i)];
      const Eigen::Matrix<double, dim, 1> T = sum.traction_[k].template head<dim>();
      const Eigen::Matrix<double, dim, dim> D =
          at.measure * sum.dtraction_[k].template topLeftCorner<dim, dim>();
      const Eigen::Matrix<double, dim, dim> C =
          at.measure * sum.symmetric_[k].template topLeftCorner<dim, dim>();
      for (int a = 0; a < Shape::nodes; ++a) {
        const double Na = at.N[idx(a)];
        force_.template segment<dim>(a * dim) -= Na * at.measure * T;
        for (int b = 0; b < Shape::nodes; ++b) {
          const Eigen::Matrix<double, dim, dim> growth =
              T * at.dmeasure[idx(b)].template head<dim>().transpose();
          tangent_.template block<dim, dim>(a * dim, b * dim) -= Na * (at.N[idx(b)] * D + growth);
          near_.template block<dim, dim>(a * dim, b * dim) -= Na * (at.N[idx(b)] * C + growth);
        }
      }
    }
  }
  /// Adds to the tangent what pressures owe to the gaps of other points. (C.45)
  void couple_points(const ToolContact& tool) {
    const FacePressure* averaged = averaged_pressure(tool, face_);
    if (averaged == nullptr)
      return;
    const TrialContact& trial = tool.trial;
    const auto in_space = [&](const Vec3& v) -> Eigen::Matrix<double, dim, 1> {
      return (trial.rotation * v).template head<dim>();
    };
    using Block = Eigen::Matrix<double, dim, dim>;
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (std::size_t j = 0; j < places_.size(); ++j) {
        const double fall = places_[i].measure * averaged->d_gap(static_cast<Eigen::Index>(i),
                                                                 static_cast<Eigen::Index>(j));
        if (i == j || fall == 0.0 || trial.traction[first_ + i].status == Status::open)
          continue;
        const Eigen::Matrix<double, dim, 1> n = in_space(trial.foot[first_ + j].normal);
        const Block D = fall * in_space(trial.traction[first_ + i].dtraction_dp) * n.transpose();
        const Block C = fall * in_space(trial.foot[first_ + i].normal) * n.transpose();
        for (int a = 0; a < Shape::nodes; ++a)
          for (int b = 0; b < Shape::nodes; ++b) {
            const double N = places_[i].N[idx(a)] * places_[j].N[idx(b)];
            tangent_.template block<dim, dim>(a * dim, b * dim) -= N * D;
            near_.template block<dim, dim>(a * dim, b * dim) -= N * C;
          }
      }
  }
  void scatter(const ContactModel& model, mechanics::System& system) const {
    const mechanics::Scatter& faces = model.surface->scatter();
    const Square unsymmetric = tangent_ - 0.5 * (near_ + near_.transpose());
    faces.add(dim, face_, force_.data(), system.residual);
    faces.add(*model.pattern, face_, tangent_.data(), system.tangent.values);
    faces.list(*model.pattern, face_, unsymmetric.data(), system.tangent.unsymmetric);
  }

private:
  Index face_;
  std::size_t first_; ///< point of the face
  std::vector<FacePoint<Shape>> places_;
  Eigen::Matrix<double, size, 1> force_ = Eigen::Matrix<double, size, 1>::Zero();
  Square tangent_ = Square::Zero();
  Square near_ = Square::Zero(); ///< without what couples slip to pressure
};

void TractionSum::scatter(const ContactModel& model,
                          std::span<const ToolContact> tools,
                          std::span<const double> x,
                          mechanics::System& system) const {
  const ContactSurface& surface = *model.surface;
  visit_contact_face(surface.kind(), surface.form(), [&](auto shape, auto rule) {
    using Rule = decltype(rule);
    for (const Index f : surface.scatter().order()) {
      if (!touches(idx(f * Rule::points), Rule::points))
        continue;
      system.symmetric = false;
      FaceEquations<decltype(shape), Rule> equations(surface, x, f);
      equations.add(*this);
      for (const ToolContact& tool : tools)
        equations.couple_points(tool);
      equations.scatter(model, system);
    }
  });
}

} // namespace billet::contact
