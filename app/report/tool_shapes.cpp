#include "app/report/tool_shapes.h"

#include "geometry/base/box.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace billet::report {

namespace {

using mechanics::Index;
using nlohmann::ordered_json;
using Pose = Eigen::Matrix4d;

constexpr std::size_t most_triangles_of_a_tool = 30000;

/// The rigid motion from points to others; none: they differ by more than that.
std::optional<Pose> motion_between(std::span<const Vec3> from, std::span<const Vec3> to) {
  if (from.size() != to.size() || from.empty())
    return std::nullopt;
  const auto n = static_cast<Eigen::Index>(from.size());
  // Of any number of rows: of three g++ 12 warns that their mean is read beyond its end.
  const Eigen::Map<const Eigen::MatrixXd> a(from.front().data(), 3, n);
  const Eigen::Map<const Eigen::MatrixXd> b(to.front().data(), 3, n);
  const Pose pose = Eigen::umeyama(a, b, false);
  const Eigen::Matrix3Xd moved =
      (pose.topLeftCorner<3, 3>() * a).colwise() + pose.topRightCorner<3, 1>();
  constexpr double unseen = 1e-5; // of the tool's size
  const double largest = (moved - b).colwise().norm().maxCoeff();
  return largest <= unseen * box_of(from).size() ? std::optional(pose) : std::nullopt;
}

/// Number of the cell of a grid in which a point lies.
std::array<long, 3> cell_of(const Vec3& point, const Vec3& low, double length) {
  std::array<long, 3> cell{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto axis = static_cast<Eigen::Index>(d);
    cell[d] = std::lround(std::floor((point[axis] - low[axis]) / length));
  }
  return cell;
}

/// For each point the number of its cell, and the mean of the points of each cell.
std::pair<std::vector<Index>, std::vector<Vec3>> clustered(std::span<const Vec3> points,
                                                           double length) {
  const Box box = box_of(points);
  std::map<std::array<long, 3>, Index> numbers;
  std::vector<Index> number_of;
  std::vector<Vec3> sums;
  std::vector<double> counts;
  for (const Vec3& point : points) {
    const auto [at, is_new] =
        numbers.try_emplace(cell_of(point, box.low, length), static_cast<Index>(sums.size()));
    if (is_new) {
      sums.emplace_back(Vec3::Zero());
      counts.push_back(0.0);
    }
    number_of.push_back(at->second);
    sums[idx(at->second)] += point;
    counts[idx(at->second)] += 1.0;
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] /= counts[i];
  return {std::move(number_of), std::move(sums)};
}

/// The polygons that keep three different points, once their points are numbered anew.
std::vector<std::size_t> remaining(const std::vector<std::vector<Index>>& polygons,
                                   const std::vector<Index>& number_of) {
  std::vector<std::size_t> stay;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::vector<Index> nodes;
    for (const Index node : polygons[i])
      nodes.push_back(number_of[idx(node)]);
    std::sort(nodes.begin(), nodes.end());
    if (std::unique(nodes.begin(), nodes.end()) - nodes.begin() >= 3)
      stay.push_back(i);
  }
  return stay;
}

/// Drops all polygons but these, and their values.
void keep_polygons(io::SurfaceFrame& surface, const std::vector<std::size_t>& stay) {
  std::vector<std::vector<Index>> polygons;
  for (const std::size_t i : stay)
    polygons.push_back(surface.polygons[i]);
  surface.polygons = std::move(polygons);
  for (io::Field& field : surface.cell_fields) {
    const auto width = static_cast<std::size_t>(field.components);
    std::vector<double> values;
    for (const std::size_t i : stay)
      for (std::size_t c = 0; c < width; ++c)
        values.push_back(field.values[i * width + c]);
    field.values = std::move(values);
  }
}

/// Lines of any length as pairs of points, polygons as triangles about their first point.
std::vector<Index> pieces(const std::vector<std::vector<Index>>& cells, std::size_t corners) {
  std::vector<Index> all;
  for (const std::vector<Index>& cell : cells)
    for (std::size_t i = 1; i + corners - 1 <= cell.size(); ++i) {
      if (corners == 3)
        all.push_back(cell[0]);
      all.insert(all.end(), {cell[corners == 3 ? i : i - 1], cell[corners == 3 ? i + 1 : i]});
    }
  return all;
}

/// Values of cells, once for each piece that a cell becomes.
std::vector<double> of_pieces(const io::Field& field, const io::SurfaceFrame& surface) {
  std::vector<double> values;
  std::size_t cell = 0;
  const auto width = static_cast<std::size_t>(field.components);
  const auto add = [&](std::size_t n_pieces) {
    for (std::size_t i = 0; i < n_pieces; ++i)
      for (std::size_t c = 0; c < width; ++c)
        values.push_back(field.values[cell * width + c]);
    ++cell;
  };
  for (const auto& line : surface.lines)
    add(line.size() - 1);
  for (const auto& polygon : surface.polygons)
    add(polygon.size() - 2);
  return values;
}

} // namespace

std::vector<std::size_t> thin(io::SurfaceFrame& surface, std::size_t most_triangles) {
  if (surface.polygons.size() <= most_triangles || !surface.lines.empty())
    return {};
  constexpr double finest = 1e-3, coarser = 1.3; // of the tool's size; each time
  for (double length = finest * box_of(surface.points).size();; length *= coarser) {
    auto [number_of, points] = clustered(surface.points, length);
    std::vector<std::size_t> stay = remaining(surface.polygons, number_of);
    if (stay.size() > most_triangles)
      continue;
    keep_polygons(surface, stay);
    for (std::vector<Index>& polygon : surface.polygons)
      for (Index& node : polygon)
        node = number_of[idx(node)];
    surface.points = std::move(points);
    surface.point_fields.clear();
    return stay;
  }
}

std::size_t ToolShapes::store(const io::SurfaceFrame& surface) {
  Blob blob;
  ordered_json about;
  const std::span<const double> flat(
      surface.points.empty() ? nullptr : surface.points.front().data(), 3 * surface.points.size());
  for (std::size_t c = 0; c < 3; ++c)
    about["points"].push_back(blob.add_numbers(flat, c, 3, Blob::fine));
  about["lines"] = blob.add_integers(pieces(surface.lines, 2));
  about["triangles"] = blob.add_integers(pieces(surface.polygons, 3));
  about_.push_back(std::move(about));
  blobs_.push_back(blob.text());
  return blobs_.size() - 1;
}

ordered_json ToolShapes::add(const std::string& tool, io::SurfaceFrame surface, Blob& frame) {
  ordered_json about{{"tool", tool}};
  auto found = latest_.find(tool);
  std::optional<Pose> pose;
  if (found != latest_.end() && found->second.lines == surface.lines &&
      found->second.polygons == surface.polygons)
    pose = motion_between(found->second.points, surface.points);
  if (pose) {
    if (!found->second.stay.empty())
      keep_polygons(surface, found->second.stay); // for the sake of its fields
  } else {
    pose = Pose::Identity();
    Shape shape{surface.points, surface.lines, surface.polygons, {}, 0};
    shape.stay = thin(surface, most_triangles_of_a_tool);
    if (!shape.stay.empty())
      thinned_[tool] = shape.polygons.size();
    shape.number = store(surface);
    found = latest_.insert_or_assign(tool, std::move(shape)).first;
  }
  about["shape"] = found->second.number;
  if (!pose->isIdentity(0.0))
    for (Eigen::Index row = 0; row < 3; ++row)
      for (Eigen::Index c = 0; c < 4; ++c)
        about["pose"].push_back((*pose)(row, c));
  for (const io::Field& field : surface.cell_fields)
    about["fields"][field.name] = frame.add_numbers(
        of_pieces(field, surface), 0, static_cast<std::size_t>(field.components), Blob::coarse);
  return about;
}

} // namespace billet::report
