#include "geometry/surfaces/profile_piece.h"

#include "geometry/base/angle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace billet::geometry {

namespace {

// End and start of a closed profile closer than this share of its size are the same point.
constexpr double closing_slack = 1e-9;

Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }

} // namespace

double ProfilePiece::length() const { return is_arc() ? std::abs(radius) * sweep : (b - a).norm(); }

Vec2 ProfilePiece::point(double s) const {
  if (!is_arc())
    return a + s * (b - a);
  const double angle = std::copysign(s * sweep, radius);
  const Vec2 u = a - centre;
  return centre + std::cos(angle) * u + std::sin(angle) * turned_left(u);
}

bool ProfilePiece::sweeps(const Vec2& v) const {
  const double turn = std::copysign(1.0, radius);
  const Vec2 from = a - centre, to = b - centre;
  if (sweep <= std::numbers::pi)
    return turn * cross(from, v) >= 0.0 && turn * cross(v, to) >= 0.0;
  return !(turn * cross(to, v) > 0.0 && turn * cross(v, from) > 0.0);
}

ClosestOnPiece ProfilePiece::closest(const Vec2& x) const {
  if (is_arc()) {
    const Vec2 v = x - centre;
    if (sweeps(v)) {
      const double distance = v.norm() - std::abs(radius);
      return {distance * distance, Place::interior};
    }
    const double to_a = (x - a).squaredNorm(), to_b = (x - b).squaredNorm();
    return to_a <= to_b ? ClosestOnPiece{to_a, Place::start} : ClosestOnPiece{to_b, Place::end};
  }
  const Vec2 way = b - a, v = x - a;
  const double along = v.dot(way), length2 = way.squaredNorm();
  if (along <= 0.0)
    return {v.squaredNorm(), Place::start};
  if (along >= length2)
    return {(x - b).squaredNorm(), Place::end};
  const double distance = v.dot(normal_of(tangent_a));
  return {distance * distance, Place::interior};
}

Box ProfilePiece::bounds() const {
  Box box;
  box.add({a.x(), a.y(), 0.0});
  box.add({b.x(), b.y(), 0.0});
  if (!is_arc())
    return box;
  for (const Vec2& e : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)})
    if (sweeps(e)) {
      const Vec2 p = centre + std::abs(radius) * e;
      box.add({p.x(), p.y(), 0.0});
    }
  return box;
}

ProfilePiece make_piece(const Vec2& from, const ProfileSegment& segment) {
  ProfilePiece piece;
  piece.a = from;
  piece.b = segment.to;
  const Vec2 chord = piece.b - piece.a;
  const double length = chord.norm();
  piece.tangent_a = piece.tangent_b = chord / length;
  if (segment.radius == 0.0)
    return piece;
  const double turn = std::copysign(1.0, segment.radius);
  // A radius below half the chord by rounding only is half the chord.
  const double radius = std::max(std::abs(segment.radius), 0.5 * length);
  const double height = std::sqrt((radius - 0.5 * length) * (radius + 0.5 * length));
  const double side = segment.large ? -turn : turn;
  piece.radius = turn * radius;
  piece.centre = 0.5 * (piece.a + piece.b) + side * height * turned_left(piece.tangent_a);
  const double minor = 2.0 * std::atan2(0.5 * length, height);
  piece.sweep = segment.large ? 2.0 * std::numbers::pi - minor : minor;
  piece.tangent_a = turn * turned_left(piece.a - piece.centre).normalized();
  piece.tangent_b = turn * turned_left(piece.b - piece.centre).normalized();
  return piece;
}

std::vector<ProfilePiece> pieces(const Profile& profile) {
  std::vector<ProfilePiece> all;
  Vec2 from = profile.start;
  const bool meets =
      !profile.segments.empty() &&
      (profile.segments.back().to - profile.start).norm() <= closing_slack * size(profile);
  for (std::size_t i = 0; i < profile.segments.size(); ++i) {
    ProfileSegment segment = profile.segments[i];
    if (profile.closed && meets && i + 1 == profile.segments.size())
      segment.to = profile.start;
    all.push_back(make_piece(from, segment));
    from = segment.to;
  }
  if (profile.closed && !meets)
    all.push_back(make_piece(from, {profile.start}));
  return all;
}

double size(const Profile& profile) {
  Vec2 low = profile.start, high = profile.start;
  for (const ProfileSegment& segment : profile.segments) {
    low = low.cwiseMin(segment.to);
    high = high.cwiseMax(segment.to);
  }
  return (high - low).norm();
}

} // namespace billet::geometry
