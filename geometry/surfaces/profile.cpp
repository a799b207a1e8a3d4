#include "geometry/surfaces/profile.h"

#include "geometry/base/angle.h"
#include "geometry/surfaces/profile_piece.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace billet::geometry {

namespace {

// Angles are dimensionless, the others are shares of the size of the profile.
constexpr double fold_angle = 1e-6; // closer to a half turn, two segments lie on each other
constexpr double touching = 1e-12;  // rounding of coordinates
constexpr double joint_zone = 1e-6; // tangent neighbours meet in a double root, wrong by sqrt(eps)
constexpr double radius_slack = 1e-9; // radius written with fewer digits than half its chord

using Hits = std::array<std::optional<Vec2>, 2>;

Hits line_line(const ProfilePiece& p, const ProfilePiece& q) {
  const Vec2 u = p.b - p.a, v = q.b - q.a, w = q.a - p.a;
  const double denominator = cross(u, v);
  if (denominator == 0.0)
    return {}; // parallel: an overlap shows up as an end that touches
  const double s = cross(w, v) / denominator, t = cross(w, u) / denominator;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0)
    return {};
  return {p.a + s * u, std::nullopt};
}

Hits line_arc(const ProfilePiece& line, const ProfilePiece& arc) {
  const double length = (line.b - line.a).norm();
  const Vec2 t = line.tangent_a, v = arc.centre - line.a;
  const double middle = v.dot(t), height = cross(t, v), radius = std::abs(arc.radius);
  if (std::abs(height) > radius)
    return {};
  const double half = std::sqrt((radius - height) * (radius + height));
  Hits hits;
  for (int i = 0; i < 2; ++i) {
    const double s = middle + (i == 0 ? -half : half);
    const Vec2 x = line.a + s * t;
    if (s >= 0.0 && s <= length && arc.sweeps(x - arc.centre))
      hits[static_cast<std::size_t>(i)] = x;
  }
  return hits;
}

Hits arc_arc(const ProfilePiece& p, const ProfilePiece& q) {
  const Vec2 v = q.centre - p.centre;
  const double d = v.norm(), r = std::abs(p.radius), s = std::abs(q.radius);
  if (d == 0.0 || d > r + s || d < std::abs(r - s))
    return {};
  const double along = 0.5 * (d + (r - s) * (r + s) / d);
  const double across = std::sqrt(std::max((r - along) * (r + along), 0.0));
  Hits hits;
  for (int i = 0; i < 2; ++i) {
    const Vec2 x = p.centre + along * v / d + (i == 0 ? across : -across) * Vec2(-v.y(), v.x()) / d;
    if (p.sweeps(x - p.centre) && q.sweeps(x - q.centre))
      hits[static_cast<std::size_t>(i)] = x;
  }
  return hits;
}

Hits crossings(const ProfilePiece& p, const ProfilePiece& q) {
  if (p.is_arc() && q.is_arc())
    return arc_arc(p, q);
  if (!p.is_arc() && !q.is_arc())
    return line_line(p, q);
  return p.is_arc() ? line_arc(q, p) : line_arc(p, q);
}

// Where two pieces cross or touch other than at a joint they share.
std::optional<Vec2>
meeting(const ProfilePiece& p, const ProfilePiece& q, bool p_then_q, bool q_then_p, double extent) {
  const auto shared = [&](const Vec2& x) {
    return (p_then_q && (x - p.b).norm() <= joint_zone * extent) ||
           (q_then_p && (x - p.a).norm() <= joint_zone * extent);
  };
  for (const std::optional<Vec2>& hit : crossings(p, q))
    if (hit && !shared(*hit))
      return hit;
  const double limit = touching * extent;
  for (const Vec2& end : {p.a, p.b})
    if (!shared(end) && q.closest(end).distance2 <= limit * limit)
      return end;
  for (const Vec2& end : {q.a, q.b})
    if (!shared(end) && p.closest(end).distance2 <= limit * limit)
      return end;
  return std::nullopt;
}

void find_crossings(const std::vector<ProfilePiece>& all,
                    bool closed,
                    double extent,
                    std::vector<std::string>& flaws) {
  std::vector<Box> boxes;
  boxes.reserve(all.size());
  for (const ProfilePiece& piece : all)
    boxes.push_back(piece.bounds());
  const std::size_t n = all.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      if (!boxes[i].overlaps(boxes[j], touching * extent))
        continue;
      const bool around = closed && i == 0 && j + 1 == n;
      if (const auto x = meeting(all[i], all[j], j == i + 1, around, extent))
        flaws.push_back(fmt::format("segments {} and {} of the profile meet at ({:g}, {:g})", i + 1,
                                    j + 1, x->x(), x->y()));
    }
}

} // namespace

Profile polygon(std::span<const Vec2> points, bool closed) {
  Profile profile;
  profile.closed = closed;
  if (!points.empty()) {
    profile.start = points.front();
    for (const Vec2& point : points.subspan(1))
      profile.segments.push_back({point});
  }
  return profile;
}

Profile reversed(const Profile& profile) {
  Profile result;
  result.closed = profile.closed;
  result.start = profile.segments.empty() ? profile.start : profile.segments.back().to;
  for (std::size_t i = profile.segments.size(); i-- > 0;) {
    const ProfileSegment& segment = profile.segments[i];
    result.segments.push_back(
        {i > 0 ? profile.segments[i - 1].to : profile.start, -segment.radius, segment.large});
  }
  return result;
}

std::optional<std::string> flaw(const Vec2& from, const ProfileSegment& segment) {
  if (!from.allFinite() || !segment.to.allFinite() || !std::isfinite(segment.radius))
    return "a coordinate or radius is not a finite number";
  const double chord = (segment.to - from).norm();
  const double coordinate = std::max(from.cwiseAbs().maxCoeff(), segment.to.cwiseAbs().maxCoeff());
  if (chord <= 8.0 * std::numeric_limits<double>::epsilon() * coordinate)
    return fmt::format("the segment from ({:g}, {:g}) to ({:g}, {:g}) has no length", from.x(),
                       from.y(), segment.to.x(), segment.to.y());
  if (segment.radius != 0.0 && std::abs(segment.radius) < (1.0 - radius_slack) * 0.5 * chord)
    return fmt::format("radius {:g} is too small for a chord of {:g}: at least {:.10g} is needed",
                       segment.radius, chord, 0.5 * chord);
  if (segment.large && segment.radius == 0.0)
    return "large = true needs a radius";
  return std::nullopt;
}

std::vector<std::string> flaws(const Profile& profile) {
  if (profile.segments.empty())
    return {"the profile has no segment"};
  std::vector<std::string> found;
  Vec2 from = profile.start;
  for (const ProfileSegment& segment : profile.segments) {
    if (const auto what = flaw(from, segment))
      found.push_back(*what);
    from = segment.to;
  }
  if (!found.empty())
    return found;
  const double extent = size(profile);
  if (!profile.closed && (from - profile.start).norm() <= radius_slack * extent)
    return {"the profile ends where it starts but is not closed; set closed = true"};
  const std::vector<ProfilePiece> all = pieces(profile);
  if (profile.closed && all.size() < 2)
    return {"a closed profile needs at least two segments"};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t next = (i + 1) % all.size();
    if (next == 0 && !profile.closed)
      break;
    if ((all[i].tangent_b + all[next].tangent_a).norm() < fold_angle)
      found.push_back(fmt::format("the profile folds back on itself at ({:g}, {:g})", all[i].b.x(),
                                  all[i].b.y()));
  }
  find_crossings(all, profile.closed, extent, found);
  return found;
}

std::vector<Vec2> polyline(const Profile& profile, double max_angle) {
  std::vector<Vec2> points{profile.start};
  for (const ProfilePiece& piece : pieces(profile)) {
    const int chords = piece.is_arc() ? static_cast<int>(std::ceil(piece.sweep / max_angle)) : 1;
    for (int i = 1; i < chords; ++i)
      points.push_back(piece.point(static_cast<double>(i) / chords));
    points.push_back(piece.b);
  }
  if (profile.closed)
    points.pop_back();
  return points;
}

} // namespace billet::geometry
