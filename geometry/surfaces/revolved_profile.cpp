#include "geometry/surfaces/revolved_profile.h"

#include "geometry/base/error.h"
#include "geometry/collision/narrow_parts.h"
#include "geometry/surface_check.h"
#include "geometry/surfaces/profile_piece.h"
#include "geometry/surfaces/surface_of_revolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

namespace billet::geometry {

namespace {

constexpr double axis_slack = 1e-9; // share of the size within which a point is on the axis

std::vector<Vec2> corners_of(const Profile& profile) {
  std::vector<Vec2> points{profile.start};
  for (const ProfileSegment& segment : profile.segments)
    points.push_back(segment.to);
  return points;
}

bool on_axis(const Vec2& end, double slack) { return std::abs(end.y()) <= slack; }

// Ends that are on the axis but for rounding are put on it.
Profile with_ends_on_axis(Profile profile) {
  const double slack = axis_slack * size(profile);
  if (on_axis(profile.start, slack))
    profile.start.y() = 0.0;
  if (!profile.segments.empty() && on_axis(profile.segments.back().to, slack))
    profile.segments.back().to.y() = 0.0;
  return profile;
}

Vec2 mirrored(const Vec2& x) { return {x.x(), -x.y()}; }

// The way back along the mirror image, from the end to the start; the tool stays on the left, and
// arcs turn as before.
std::vector<ProfileSegment> way_back(const Profile& profile) {
  const std::vector<Vec2> points = corners_of(profile);
  std::vector<ProfileSegment> back;
  for (std::size_t i = profile.segments.size(); i-- > 0;)
    back.push_back({mirrored(points[i]), profile.segments[i].radius, profile.segments[i].large});
  return back;
}

// Whether the way between two points is a flat end of the solid, and its mirror image its other
// half.
bool flat(const Vec2& from, const ProfileSegment& way) {
  return way.radius == 0.0 && from.x() == way.to.x();
}

// The section of the solid by a whole plane through the axis, where the axis closes the profile.
Profile whole_section(const Profile& profile) {
  const bool starts = profile.start.y() == 0.0, ends = profile.segments.back().to.y() == 0.0;
  if (profile.closed || (!starts && !ends))
    return profile;
  const std::vector<Vec2> points = corners_of(profile);
  std::vector<ProfileSegment> there = profile.segments, back = way_back(profile);
  Profile whole{profile.start, {}, starts && ends};
  if (starts && flat(points[0], there.front())) { // both halves in one, from the end of the first
    whole.start = points[1];
    there.erase(there.begin());
    back.back().to = points[1];
  }
  if (ends && flat(points[points.size() - 2], profile.segments.back()))
    there.pop_back();
  if (!ends) { // the mirror image comes first
    whole.start = mirrored(points.back());
    std::swap(there, back);
  }
  whole.segments = std::move(there);
  whole.segments.insert(whole.segments.end(), back.begin(), back.end());
  return whole;
}

class RevolvedProfile final : public RigidSurface {
public:
  RevolvedProfile(const Axis& axis, Profile profile)
      : axis_(axis), profile_(std::move(profile)), section_(make_profile(whole_section(profile_))) {
    for (const Vec2& p : corners_of(profile_))
      size_ = std::max(size_, p.cwiseAbs().maxCoeff());
  }

  [[nodiscard]] Box bounds() const override;
  [[nodiscard]] DisplayMesh display(const Box& window, bool planar) const override;
  [[nodiscard]] std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const override;

private:
  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override;

  Axis axis_;
  Profile profile_;
  SurfacePtr section_;
  double size_ = 0.0; // largest coordinate [mm]
};

// The farthest point of a circle about the axis along a coordinate is h a_i + r sqrt(1 - a_i^2): a
// direction of the meridian plane, along which each piece has its farthest point.
Box RevolvedProfile::bounds() const {
  const Vec3 extent = disk_extent(axis_);
  Box box;
  const auto add = [&](const Vec2& p) {
    const Vec3 centre = axis_.origin + p.x() * axis_.direction;
    box.add(centre - p.y() * extent);
    box.add(centre + p.y() * extent);
  };
  for (const ProfilePiece& piece : pieces(profile_)) {
    add(piece.a);
    add(piece.b);
    for (int i = 0; piece.is_arc() && i < 3; ++i)
      for (const double sign : {1.0, -1.0}) {
        const Vec2 out(sign * axis_.direction[i], extent[i]);
        if (piece.sweeps(out))
          add(piece.centre + std::abs(piece.radius) * out.normalized());
      }
  }
  return box;
}

DisplayMesh RevolvedProfile::display(const Box& /*window*/, bool planar) const {
  std::vector<Vec2> line = polyline(profile_, drawn_angle);
  if (profile_.closed)
    line.push_back(line.front());
  return revolved_display(axis_, line, planar, false);
}

std::vector<InnerBall> RevolvedProfile::narrow_parts(const NarrowSearch& search) const {
  std::vector<InnerBall> balls;
  for (const InnerBall& ball : section_->narrow_parts(search))
    if (ball.centre.y() >= 0.0) // of the section's two halves
      add_around({axis_.origin + ball.centre.x() * axis_.direction, axis_.direction,
                  ball.centre.y(), ball.radius},
                 search, balls);
  return balls;
}

// (G.39)
void RevolvedProfile::do_project(std::span<const Vec3> points,
                                 double reach,
                                 std::span<Projection> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const AxisCoordinates c = axis_coordinates(axis_, points[i], size_);
    const Vec3 x(static_cast<double>(c.h), static_cast<double>(c.r), 0.0);
    Projection p;
    p.patch = out[i].patch;
    section_->project({&x, 1}, reach, {&p, 1});
    out[i] = {};
    if (!p.found())
      continue;
    // Within rounding of the axis the mirror image may be the nearer one.
    const double side = p.foot.y() < -x.y() ? -1.0 : 1.0;
    const Vec2 s(-p.normal.y(), p.normal.x());
    MeridianPoint at{p.gap, p.normal.x(), side * p.normal.y(), 0.0, 0.0};
    at.k_meridian = s.dot(p.dnormal_dx.topLeftCorner<2, 2>() * s);
    at.gap += at.n_h * static_cast<double>(c.h - x.x()) + at.n_r * static_cast<double>(c.r - x.y());
    if (x.y() > 0.0)
      at.k_hoop = at.n_r / x.y();
    else if (at.n_r == 0.0) // a pole: all meridians curve alike
      at.k_hoop = at.k_meridian;
    out[i] = revolved(axis_, c.e_r, points[i], at, false);
    out[i].patch = p.patch;
  }
}

} // namespace

std::vector<std::string> turning_flaws(const Profile& profile) {
  std::vector<std::string> found = flaws(profile);
  if (!found.empty())
    return found;
  const Profile exact = with_ends_on_axis(profile);
  const double slack = axis_slack * size(exact);
  const std::vector<ProfilePiece> all = pieces(exact);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ProfilePiece& piece = all[i];
    const bool first = !exact.closed && i == 0, last = !exact.closed && i + 1 == all.size();
    const auto touches = [&](const Vec2& x, bool may) { return !may && on_axis(x, slack); };
    if (piece.bounds().low.y() < -slack)
      found.push_back(fmt::format("segment {} of the profile is beyond the axis, at radius {:g}; "
                                  "the second coordinate is the distance from the axis",
                                  i + 1, piece.bounds().low.y()));
    else if (touches(piece.a, first) || touches(piece.b, last) ||
             (piece.is_arc() ? piece.sweeps({0.0, -1.0}) && piece.bounds().low.y() <= slack
                             : on_axis(piece.a, slack) && on_axis(piece.b, slack)))
      found.push_back(fmt::format("segment {} of the profile touches the axis; only the ends of an "
                                  "open profile may lie on it",
                                  i + 1));
  }
  return found.empty() ? flaws(whole_section(exact)) : found;
}

SurfacePtr make_revolved_profile(const Vec3& point, const Vec3& axis, const Profile& profile) {
  require_point(point, "point of the revolution");
  require_direction(axis, "axis of the revolution");
  std::vector<Complaint> complaints;
  for (const std::string& what : turning_flaws(profile))
    complaints.push_back({"", what, ""});
  if (!complaints.empty())
    throw Error(Fault::geometry, std::move(complaints));
  return std::make_unique<const RevolvedProfile>(make_axis(point, axis),
                                                 with_ends_on_axis(profile));
}

} // namespace billet::geometry
