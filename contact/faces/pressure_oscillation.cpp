#include "contact/faces/pressure_oscillation.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstddef>
#include <map>

namespace billet::contact {

namespace {

/// Corners of a face come first among its nodes.
template <class Shape>
constexpr std::size_t n_corners = Shape::dim == 1 ? 2 : (Shape::nodes % 4 == 0 ? 4 : 3);

struct FaceMean {
  bool lies = false;         ///< on the tool
  double pressure = 0.0;     ///< [MPa]
  Vec3 place = Vec3::Zero(); ///< its centre [mm]
};

std::vector<FaceMean> face_means(std::span<const char> lying,
                                 std::span<const PointHistory> history,
                                 std::span<const Vec3> positions,
                                 std::span<const double> areas) {
  const std::size_t points = history.size() / lying.size();
  std::vector<FaceMean> means(lying.size());
  for (std::size_t f = 0; f < means.size(); ++f) {
    if (lying[f] == 0)
      continue;
    FaceMean& mean = means[f];
    double area = 0.0;
    for (std::size_t k = f * points; k < (f + 1) * points; ++k) {
      mean.pressure += areas[k] * history[k].pressure;
      mean.place += areas[k] * positions[k];
      area += areas[k];
    }
    mean.lies = area > 0.0; // it is none on the axis of revolution
    if (!mean.lies)
      continue;
    mean.pressure /= area;
    mean.place /= area;
  }
  return means;
}

/// Faces with a corner in common with each, itself among them, in order.
class Neighbours {
public:
  Neighbours(const ContactSurface& surface, const std::vector<FaceMean>& means, std::size_t corners)
      : surface_(&surface), corners_(corners) {
    for (std::size_t f = 0; f < means.size(); ++f)
      if (means[f].lies)
        for (const Index node : corners_of(f))
          at_node_[node];
    for (std::size_t f = 0; f < means.size(); ++f)
      for (const Index node : corners_of(f))
        if (const auto found = at_node_.find(node); found != at_node_.end())
          found->second.push_back(f);
  }

  [[nodiscard]] std::vector<std::size_t> of(std::size_t face) const {
    std::vector<std::size_t> faces;
    for (const Index node : corners_of(face)) {
      const std::vector<std::size_t>& here = at_node_.at(node);
      faces.insert(faces.end(), here.begin(), here.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

private:
  [[nodiscard]] std::span<const Index> corners_of(std::size_t face) const {
    return surface_->scatter().nodes(static_cast<Index>(face)).first(corners_);
  }

  const ContactSurface* surface_;
  std::size_t corners_;
  std::map<Index, std::vector<std::size_t>> at_node_; ///< of faces that lie on the tool
};

/// The gradient along a face that the means around it tell, by least squares [MPa/mm].
Vec3 rise(const std::vector<FaceMean>& means,
          std::size_t face,
          const std::vector<std::size_t>& around) {
  Mat3 squares = Mat3::Zero();
  Vec3 products = Vec3::Zero();
  for (const std::size_t other : around) {
    const Vec3 way = means[other].place - means[face].place;
    squares += way * way.transpose();
    products += (means[other].pressure - means[face].pressure) * way;
  }
  // On a curved contact the ways have a small part off the face's plane, which says nothing.
  constexpr double off_plane = 0.01; // of the square of the way
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(squares);
  Vec3 gradient = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (axes.eigenvalues()[i] > off_plane * axes.eigenvalues()[2]) {
      const Vec3 axis = axes.eigenvectors().col(i);
      gradient += axis.dot(products) / axes.eigenvalues()[i] * axis;
    }
  return gradient;
}

} // namespace

SmoothedPressure smoothed_pressure(const ContactSurface& surface,
                                   std::span<const char> lying,
                                   std::span<const PointHistory> history,
                                   std::span<const Vec3> positions,
                                   std::span<const double> areas) {
  const auto points = idx(surface.points());
  const std::vector<FaceMean> means = face_means(lying, history, positions, areas);
  SmoothedPressure smoothed{std::vector<char>(means.size(), 0),
                            std::vector<double>(surface.n_points()),
                            std::vector<double>(surface.n_points())};
  const std::size_t corners =
      mechanics::visit_face(surface.kind(), [](auto shape) { return n_corners<decltype(shape)>; });
  const Neighbours neighbours(surface, means, corners);
  for (std::size_t f = 0; f < means.size(); ++f) {
    if (!means[f].lies)
      continue;
    const std::vector<std::size_t> around = neighbours.of(f);
    if (!std::all_of(around.begin(), around.end(),
                     [&](std::size_t face) { return means[face].lies; }))
      continue;
    smoothed.known[f] = 1;
    const Vec3 gradient = rise(means, f, around);
    for (std::size_t k = f * points; k < (f + 1) * points; ++k) {
      smoothed.mean[k] = means[f].pressure;
      smoothed.rise[k] = gradient.dot(positions[k] - means[f].place);
    }
  }
  return smoothed;
}

std::vector<double> pressure_oscillation(const SmoothedPressure& smoothed,
                                         std::span<const PointHistory> history) {
  std::vector<double> oscillation(history.size(), 0.0);
  const std::size_t points = history.size() / smoothed.known.size();
  for (std::size_t k = 0; k < oscillation.size(); ++k)
    if (smoothed.known[k / points] != 0)
      oscillation[k] = history[k].pressure - smoothed.mean[k] - smoothed.rise[k];
  return oscillation;
}

} // namespace billet::contact
