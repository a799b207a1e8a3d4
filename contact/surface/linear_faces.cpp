#include "contact/surface/linear_faces.h"

#include "mechanics/equilibrium/faces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace billet::contact {

namespace {

using geometry::Projection;
using mechanics::FacePoint;

/// Of its length: a face that takes more off the tool is no small part of its curve.
constexpr double max_of_length = 0.02;
/// Of their mean, between the sagittas that the points of a face find: more, and the face lies on
/// an edge, a corner or a fillet of the tool.
constexpr double max_of_difference = 0.5;
/// Cosine between the tool's normal and the face's inward one: less, and it does not lie on it.
constexpr double facing = 0.5;

/// How far the points of a face are inside the tool when its nodes lie on it, by the curvature at
/// the feet of the points; none: see the constants.
template <class Shape, class Rule>
std::optional<double> sagitta(mechanics::Analysis analysis,
                              const double* local,
                              const geometry::Pose& pose,
                              std::span<const Projection> feet) {
  double sum = 0.0, least = 0.0, most = 0.0, length = 0.0;
  for (int i = 0; i < Rule::points; ++i) {
    const Projection& foot = feet[idx(i)];
    if (!foot.found())
      return std::nullopt;
    const FacePoint<Shape> at(analysis, local, Rule::point(i), Rule::weight(i));
    if (-at.area.dot(pose.rotation * foot.normal) < facing * at.area.norm())
      return std::nullopt;
    // xi^2 is 1 at nodes and 1/3 at the points of the rule.
    double here = 0.0;
    for (std::size_t d = 0; d < Shape::dim; ++d) {
      const Vec3 half = pose.rotation.transpose() * at.tangents[d];
      here += 0.5 * (1.0 - 1.0 / 3.0) * half.dot(foot.dnormal_dx * half);
      length = std::max(length, 2.0 * half.norm());
    }
    least = i == 0 ? here : std::min(least, here);
    most = i == 0 ? here : std::max(most, here);
    sum += here;
  }
  const double mean = sum / Rule::points;
  if (std::abs(mean) > max_of_length * length || most - least > max_of_difference * std::abs(mean))
    return std::nullopt;
  return mean;
}

/// Mean over the faces around each node.
struct NodeMean {
  std::vector<double> sum;
  std::vector<int> count;

  explicit NodeMean(std::size_t n) : sum(n, 0.0), count(n, 0) {}
  void add(Index node, double value) {
    sum[idx(node)] += value;
    ++count[idx(node)];
  }
  [[nodiscard]] double operator()(Index node) const { return sum[idx(node)] / count[idx(node)]; }
};

} // namespace

std::vector<double> sagitta_offsets(const ContactSurface& surface,
                                    std::span<const double> x,
                                    const geometry::Pose& pose,
                                    std::span<const Projection> feet) {
  std::vector<double> offsets(surface.n_points(), 0.0);
  visit_contact_face(surface.kind(), surface.form(), [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    if constexpr (of_linear_element<Shape>) {
      constexpr int dim = Shape::dim + 1;
      const mechanics::Scatter& faces = surface.scatter();
      std::vector<std::optional<double>> sagittas(idx(surface.n_faces()));
      NodeMean around(x.size() / std::size_t{dim});
      std::array<double, std::size_t{Shape::nodes} * dim> local{};
      for (Index f = 0; f < surface.n_faces(); ++f) {
        const auto own = feet.subspan(idx(f * Rule::points), std::size_t{Rule::points});
        if (!own[0].found())
          continue;
        mechanics::gather(x, faces.nodes(f), dim, local.data());
        sagittas[idx(f)] = sagitta<Shape, Rule>(surface.analysis(), local.data(), pose, own);
        if (sagittas[idx(f)])
          for (const Index node : faces.nodes(f))
            around.add(node, *sagittas[idx(f)]);
      }
      for (Index f = 0; f < surface.n_faces(); ++f)
        for (int i = 0; sagittas[idx(f)] && i < Rule::points; ++i) {
          const auto N = Shape::values(Rule::point(i));
          double agreed = 0.0;
          for (std::size_t a = 0; a < N.size(); ++a)
            agreed += N[a] * around(faces.nodes(f)[a]);
          offsets[idx(f * Rule::points + i)] = *sagittas[idx(f)] - agreed;
        }
    }
  });
  return offsets;
}

} // namespace billet::contact
