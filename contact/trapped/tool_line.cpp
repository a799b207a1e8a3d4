#include "contact/trapped/tool_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace billet::contact {

ToolLine::ToolLine(const geometry::RigidSurface& surface,
                   const geometry::Pose& pose,
                   const Box& window) {
  constexpr double rounding = 1e-9;
  Box in_tool;
  for (int corner = 0; corner < 4; ++corner)
    in_tool.add(pose.to_tool({(corner & 1) != 0 ? window.low.x() : window.high.x(),
                              (corner & 2) != 0 ? window.low.y() : window.high.y(), 0.0}));
  geometry::DisplayMesh drawn = surface.display(in_tool, true);
  lines_ = std::move(drawn.lines);
  points_.reserve(drawn.points.size());
  for (const Vec3& point : drawn.points)
    points_.push_back(pose.to_space(point));
  tolerance_ = rounding * window.size();
  std::vector<std::int32_t> begins(points_.size(), -1);
  for (std::size_t i = 0; i < lines_.size(); ++i)
    begins[static_cast<std::size_t>(lines_[i][0])] = static_cast<std::int32_t>(i);
  next_.assign(lines_.size(), -1);
  previous_.assign(lines_.size(), -1);
  for (std::size_t i = 0; i < lines_.size(); ++i)
    if (const std::int32_t after = begins[static_cast<std::size_t>(lines_[i][1])]; after >= 0) {
      next_[i] = after;
      previous_[static_cast<std::size_t>(after)] = static_cast<std::int32_t>(i);
    }
}

LinePlace ToolLine::nearest(const Vec3& point) const {
  LinePlace best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Vec3& a = points_[static_cast<std::size_t>(lines_[i][0])];
    const Vec3 along = points_[static_cast<std::size_t>(lines_[i][1])] - a;
    const double square = along.squaredNorm();
    const double share = square > 0.0 ? std::clamp((point - a).dot(along) / square, 0.0, 1.0) : 0.0;
    const Vec3 foot = a + share * along;
    if (const double distance = (point - foot).norm(); distance < best.distance)
      best = {i, share, foot, distance};
  }
  return best;
}

std::int32_t ToolLine::after(std::size_t piece, bool forward) const {
  return forward ? next_[piece] : previous_[piece];
}

std::optional<std::vector<Vec3>>
ToolLine::way(const LinePlace& from, const LinePlace& to, bool forward) const {
  std::vector<Vec3> points{from.point};
  std::size_t piece = from.piece;
  if (piece == to.piece && (forward ? from.share <= to.share : from.share >= to.share)) {
    points.push_back(to.point);
    return points;
  }
  for (std::size_t steps = 0; steps <= lines_.size(); ++steps) {
    points.push_back(points_[static_cast<std::size_t>(lines_[piece][forward ? 1 : 0])]);
    const std::int32_t following = after(piece, forward);
    if (following < 0)
      return std::nullopt;
    piece = static_cast<std::size_t>(following);
    if (piece == to.piece) {
      points.push_back(to.point);
      return points;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Vec3>>
ToolLine::way(const LinePlace& from, const SymmetryLine& to, bool forward) const {
  std::vector<Vec3> points{from.point};
  std::size_t piece = from.piece;
  for (std::size_t steps = 0; steps <= lines_.size(); ++steps) {
    const Vec3 last = points.back();
    const Vec3& end = points_[static_cast<std::size_t>(lines_[piece][forward ? 1 : 0])];
    const double before = last[to.component] - to.at, behind = end[to.component] - to.at;
    if (std::abs(behind) <= tolerance_ || (before > 0.0) != (behind > 0.0)) {
      const double share = before != behind ? before / (before - behind) : 1.0;
      points.emplace_back(last + std::clamp(share, 0.0, 1.0) * (end - last));
      return points;
    }
    points.push_back(end);
    const std::int32_t following = after(piece, forward);
    if (following < 0)
      return std::nullopt;
    piece = static_cast<std::size_t>(following);
  }
  return std::nullopt;
}

} // namespace billet::contact
