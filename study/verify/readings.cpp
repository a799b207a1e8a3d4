#include "study/verify/readings.h"

#include "contact/term/contact_report.h"
#include "geometry/base/index.h"

#include <algorithm>
#include <limits>

namespace billet::study {

std::vector<ContactReading> contact_readings(const process::Run& run) {
  const contact::ContactSurface& surface = *run.model.surface;
  const std::vector<contact::PointResult> results = contact::point_results(*run.contact());
  std::vector<Vec3> at(surface.n_points());
  std::vector<double> areas(surface.n_points());
  surface.positions(run.positions(), at);
  surface.areas(run.positions(), areas);
  std::vector<ContactReading> readings;
  for (std::size_t i = 0; i < results.size(); ++i)
    readings.push_back({at[i], areas[i], results[i].pressure});
  return readings;
}

Vec3 force_on_tool(const process::Run& run, std::size_t tool) {
  return run.contact()->loads()[tool].force;
}

double reaction(const process::Run& run, const std::string& set, int axis) {
  const int dim = run.mesh().dimension();
  double sum = 0.0;
  for (const mechanics::Index node : run.mesh().node_sets.at(set))
    sum += run.state.reactions[idx(dim * node + axis)];
  return sum;
}

Vec3 position(const process::Run& run, mechanics::Index node) {
  const int dim = run.mesh().dimension();
  Vec3 place = Vec3::Zero();
  for (int i = 0; i < dim; ++i)
    place[i] = run.positions()[idx(dim * node + i)];
  return place;
}

mechanics::Index node_at(const process::Run& run, const Vec3& place) {
  const std::vector<Vec3>& points = run.mesh().points;
  const auto nearest =
      std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
        return (a - place).squaredNorm() < (b - place).squaredNorm();
      });
  return static_cast<mechanics::Index>(nearest - points.begin());
}

double largest_coordinate(const process::Run& run, int axis) {
  double largest = -std::numeric_limits<double>::infinity();
  for (mechanics::Index node = 0; node < run.mesh().n_points(); ++node)
    largest = std::max(largest, position(run, node)[axis]);
  return largest;
}

} // namespace billet::study
