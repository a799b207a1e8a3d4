#include "mechanics/loads/loads.h"

#include "mechanics/bulk/bulk.h"
#include "mechanics/elements/elements.h"
#include "mechanics/equilibrium/face_area.h"
#include "mechanics/equilibrium/faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

namespace billet::mechanics {

namespace {

class Pressure final : public Load {
public:
  Pressure(const Mesh& mesh,
           Analysis analysis,
           const BlockPattern& pattern,
           const std::vector<Face>& faces,
           TimeFunction pressure)
      : kind_(mesh.kind), analysis_(analysis), pattern_(&pattern), pressure_(std::move(pressure)) {
    std::vector<Index> groups;
    for (const Face& face : faces)
      groups.insert(groups.end(), face.nodes.begin(), face.nodes.end());
    const int size = visit_face(kind_, [](auto shape) { return decltype(shape)::nodes; });
    scatter_ = Scatter(pattern, std::move(groups), size);
  }

  [[nodiscard]] Outcome<Assembled> assemble(const Trial& trial, System& system) override {
    const double p = pressure_(trial.time);
    if (p == 0.0)
      return Assembled{};
    system.symmetric = false;
    for (const Index g : scatter_.order())
      visit_face(kind_, [&](auto shape) { assemble_face(shape, g, p, trial.x, system); });
    return Assembled{};
  }

private:
  template <class Shape>
  void assemble_face(Shape, Index g, double p, std::span<const double> x, System& system) const {
    using Rule = typename FaceRules<Shape>::Full;
    constexpr std::size_t dim = Shape::dim + 1;
    constexpr std::size_t size = Shape::nodes * dim;
    std::array<double, size> local{};
    gather(x, scatter_.nodes(g), static_cast<int>(dim), local.data());
    std::array<double, size> force{};
    std::array<double, size * size> tangent{};
    for (int i = 0; i < Rule::points; ++i) {
      const FacePoint<Shape> at(analysis_, local.data(), Rule::point(i), Rule::weight(i));
      for (std::size_t a = 0; a < Shape::nodes; ++a)
        for (std::size_t d = 0; d < dim; ++d)
          force[a * dim + d] += p * at.N[a] * at.area[static_cast<Eigen::Index>(d)];
      for (std::size_t b = 0; b < Shape::nodes; ++b) {
        const Mat3 D = p * area_derivative(at, b, analysis_, Rule::weight(i));
        for (std::size_t a = 0; a < Shape::nodes; ++a)
          for (std::size_t d = 0; d < dim; ++d)
            for (std::size_t e = 0; e < dim; ++e)
              tangent[(a * dim + d) * size + b * dim + e] +=
                  at.N[a] * D(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(e));
      }
    }
    scatter_.add(static_cast<int>(dim), g, force.data(), system.residual);
    scatter_.add(*pattern_, g, tangent.data(), system.tangent.values);
  }

  void add_force(double time, std::span<const double> x, std::span<double> out) const override {
    const double p = pressure_(time);
    visit_face(kind_, [&](auto shape) {
      using Shape = decltype(shape);
      using Rule = typename FaceRules<Shape>::Full;
      constexpr std::size_t dim = Shape::dim + 1;
      std::array<double, Shape::nodes * dim> local{};
      for (const Index g : scatter_.order()) {
        gather(x, scatter_.nodes(g), static_cast<int>(dim), local.data());
        std::array<double, Shape::nodes * dim> force{};
        for (int i = 0; i < Rule::points; ++i) {
          const FacePoint<Shape> at(analysis_, local.data(), Rule::point(i), Rule::weight(i));
          for (std::size_t a = 0; a < Shape::nodes; ++a)
            for (std::size_t d = 0; d < dim; ++d)
              force[a * dim + d] -= p * at.N[a] * at.area[static_cast<Eigen::Index>(d)];
        }
        scatter_.add(static_cast<int>(dim), g, force.data(), out);
      }
    });
  }

  ElementKind kind_;
  Analysis analysis_;
  const BlockPattern* pattern_;
  TimeFunction pressure_;
  Scatter scatter_;
};

class DeadLoad final : public Load {
public:
  DeadLoad(std::vector<double> forces, TimeFunction amplitude)
      : forces_(std::move(forces)), amplitude_(std::move(amplitude)) {}

  [[nodiscard]] Outcome<Assembled> assemble(const Trial& trial, System& system) override {
    const double factor = amplitude_(trial.time);
    for (std::size_t i = 0; i < forces_.size(); ++i)
      system.residual[i] -= factor * forces_[i];
    return Assembled{};
  }

private:
  void add_force(double time, std::span<const double>, std::span<double> out) const override {
    const double factor = amplitude_(time);
    for (std::size_t i = 0; i < forces_.size(); ++i)
      out[i] += factor * forces_[i];
  }

  std::vector<double> forces_;
  TimeFunction amplitude_;
};

} // namespace

double Load::work_in(const Trial& trial) const {
  std::vector<double> force(trial.x.size(), 0.0);
  add_force(trial.time_old, trial.x_old, force);
  add_force(trial.time, trial.x, force);
  double work = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i)
    work += 0.5 * force[i] * (trial.x[i] - trial.x_old[i]);
  return work;
}

double Load::norm(double time, std::span<const double> x) const {
  std::vector<double> force(x.size(), 0.0);
  add_force(time, x, force);
  return std::sqrt(std::inner_product(force.begin(), force.end(), force.begin(), 0.0));
}

void Load::commit(const Trial& trial) { work_ += work_in(trial); }

std::unique_ptr<Load> make_pressure(const Mesh& mesh,
                                    Analysis analysis,
                                    const BlockPattern& pattern,
                                    const std::vector<Face>& faces,
                                    TimeFunction pressure) {
  return std::make_unique<Pressure>(mesh, analysis, pattern, faces, std::move(pressure));
}

std::unique_ptr<Load> make_dead_load(std::vector<double> forces, TimeFunction amplitude) {
  return std::make_unique<DeadLoad>(std::move(forces), std::move(amplitude));
}

namespace {

/// Calls `at_point(f, point)` for the points of the full rule on each of several faces.
template <class AtPoint>
void integrate(const Mesh& mesh,
               Analysis analysis,
               const std::vector<Face>& faces,
               std::span<const double> x,
               const AtPoint& at_point) {
  visit_face(mesh.kind, [&](auto shape) {
    using Shape = decltype(shape);
    using Rule = typename FaceRules<Shape>::Full;
    constexpr int dim = Shape::dim + 1;
    std::array<double, static_cast<std::size_t>(Shape::nodes * dim)> local{};
    for (std::size_t f = 0; f < faces.size(); ++f) {
      gather(x, faces[f].nodes, dim, local.data());
      for (int i = 0; i < Rule::points; ++i)
        at_point(f, FacePoint<Shape>(analysis, local.data(), Rule::point(i), Rule::weight(i)));
    }
  });
}

} // namespace

std::vector<double> traction_forces(const Mesh& mesh,
                                    Analysis analysis,
                                    const std::vector<Face>& faces,
                                    std::span<const Vec3> tractions) {
  const std::vector<double> x = node_positions(mesh);
  std::vector<double> forces(x.size(), 0.0);
  const int dim = mesh.dimension();
  integrate(mesh, analysis, faces, x, [&](std::size_t f, const auto& at) {
    for (std::size_t a = 0; a < at.nodes; ++a)
      for (int d = 0; d < dim; ++d)
        forces[idx(faces[f].nodes[a] * dim + d)] += at.N[a] * at.measure * tractions[f][d];
  });
  return forces;
}

std::vector<double> traction_forces(const Mesh& mesh,
                                    Analysis analysis,
                                    const std::vector<Face>& faces,
                                    const Vec3& traction) {
  return traction_forces(mesh, analysis, faces, std::vector<Vec3>(faces.size(), traction));
}

std::vector<double> face_areas(const Mesh& mesh,
                               Analysis analysis,
                               const std::vector<Face>& faces,
                               std::span<const double> x) {
  std::vector<double> areas(faces.size(), 0.0);
  integrate(mesh, analysis, faces, x,
            [&](std::size_t f, const auto& at) { areas[f] += at.measure; });
  return areas;
}

std::vector<double> body_forces(const Mesh& mesh, Analysis analysis, const Vec3& force) {
  const std::vector<double> x = node_positions(mesh);
  std::vector<double> forces(x.size(), 0.0);
  const int dim = mesh.dimension();
  visit_element(mesh.kind, [&](auto element) {
    using Element = decltype(element);
    std::array<double, static_cast<std::size_t>(Element::Shape::nodes * Element::Shape::dim)>
        local{};
    std::array<double, static_cast<std::size_t>(Element::Rule::points)> volumes{};
    for (Index e = 0; e < mesh.n_elements(); ++e) {
      gather(x, mesh.cell(e), dim, local.data());
      point_volumes(mesh.kind, analysis, local.data(), volumes);
      for (int g = 0; g < Element::Rule::points; ++g) {
        const auto N = Element::Shape::values(Element::Rule::point(g));
        for (std::size_t a = 0; a < N.size(); ++a)
          for (int d = 0; d < dim; ++d)
            forces[idx(mesh.cell(e)[a] * dim + d)] += N[a] * volumes[idx(g)] * force[d];
      }
    }
  });
  return forces;
}

} // namespace billet::mechanics
