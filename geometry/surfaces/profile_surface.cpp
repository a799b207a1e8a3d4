#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/base/limits.h"
#include "geometry/collision/narrow_parts.h"
#include "geometry/surfaces/profile.h"
#include "geometry/surfaces/profile_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace billet::geometry {

namespace {

constexpr double rim_slack = 1e-9; // share of the size by which a point may overshoot an open end
constexpr std::size_t block_size = 16; // pieces that share a bounding box

// The unit vectors and the gap in the plane; `found` false beyond a rim.
struct PlaneProjection {
  double gap;
  Vec2 normal;
  Mat2 dnormal_dx = Mat2::Zero();
  bool found = true;
};

// Derivative of v/|v|. (G.10)
Mat2 turning(const Vec2& unit, double distance) {
  return (Mat2::Identity() - unit * unit.transpose()) / distance;
}

class ProfileSurface final : public RigidSurface {
public:
  explicit ProfileSurface(const Profile& profile);

  [[nodiscard]] Box bounds() const override { return bounds_; }
  [[nodiscard]] DisplayMesh display(const Box& window, bool planar) const override;
  [[nodiscard]] std::vector<ToolCorner> corners(double angle) const override;
  [[nodiscard]] std::vector<InnerBall> narrow_parts(const NarrowSearch& search) const override;

private:
  struct Nearest {
    double distance2 = std::numeric_limits<double>::infinity();
    std::size_t piece = 0;
    Place place = Place::interior;
  };

  void
  do_project(std::span<const Vec3> points, double reach, std::span<Projection> out) const override;
  [[nodiscard, gnu::noinline]] double box_distance2(const Vec2& x, std::size_t block) const;
  [[nodiscard]] ClosestOnPiece closest(const Vec2& x, std::size_t piece, double box2) const;
  [[nodiscard]] Nearest nearest(const Vec2& x, double limit2) const;
  [[nodiscard]] PlaneProjection at(const Vec2& x, const Nearest& nearest) const;
  [[nodiscard]] PlaneProjection on_arc(const Vec2& x, const ProfilePiece& piece) const;
  [[nodiscard]] PlaneProjection
  at_joint(const Vec2& x, const Vec2& corner, const Vec2& pseudo_normal) const;
  [[nodiscard]] PlaneProjection
  at_end(const Vec2& x, const Vec2& end, const Vec2& normal, const Vec2& outward) const;

  Profile profile_;
  std::vector<ProfilePiece> pieces_;
  std::vector<Box> boxes_; // of every block of pieces
  Box bounds_;
  double rounding_ = 0.0; // below this a distance is rounding [mm]
};

ProfileSurface::ProfileSurface(const Profile& profile)
    : profile_(profile), pieces_(pieces(profile)) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (i % block_size == 0)
      boxes_.emplace_back();
    const Box box = pieces_[i].bounds();
    boxes_.back().add(box.low);
    boxes_.back().add(box.high);
    bounds_.add(box.low);
    bounds_.add(box.high);
  }
  const double largest =
      std::max(bounds_.low.cwiseAbs().maxCoeff(), bounds_.high.cwiseAbs().maxCoeff());
  rounding_ = 16.0 * epsilon * largest;
}

DisplayMesh ProfileSurface::display(const Box& /*window*/, bool /*planar*/) const {
  DisplayMesh mesh;
  for (const Vec2& p : polyline(profile_, drawn_angle))
    mesh.points.emplace_back(p.x(), p.y(), 0.0);
  const auto n = static_cast<std::int32_t>(mesh.points.size());
  for (std::int32_t i = 1; i < n; ++i)
    mesh.lines.push_back({i - 1, i});
  if (profile_.closed)
    mesh.lines.push_back({n - 1, 0});
  return mesh;
}

std::vector<ToolCorner> ProfileSurface::corners(double angle) const {
  std::vector<ToolCorner> corners;
  const auto in_space = [](const Vec2& v) { return Vec3(v.x(), v.y(), 0.0); };
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const ProfilePiece& piece = pieces_[i];
    if (piece.radius > 0.0 && piece.sweep > angle) {
      // Its halves turn by less than half a turn, whatever the arc.
      const Vec2 middle = (piece.point(0.5) - piece.centre).normalized();
      corners.push_back({in_space(piece.centre), piece.radius, in_space(normal_of(piece.tangent_a)),
                         in_space(middle)});
      corners.push_back({in_space(piece.centre), piece.radius, in_space(middle),
                         in_space(normal_of(piece.tangent_b))});
    }
    if (i + 1 == pieces_.size() && !profile_.closed)
      break;
    const ProfilePiece& next = pieces_[(i + 1) % pieces_.size()];
    const double turn =
        std::atan2(cross(piece.tangent_b, next.tangent_a), piece.tangent_b.dot(next.tangent_a));
    if (turn > angle)
      corners.push_back({in_space(piece.b), 0.0, in_space(normal_of(piece.tangent_b)),
                         in_space(normal_of(next.tangent_a))});
  }
  return corners;
}

std::vector<InnerBall> ProfileSurface::narrow_parts(const NarrowSearch& search) const {
  std::vector<InnerBall> balls;
  for (const ToolCorner& corner : corners(sharp_turn))
    if (corner.radius < search.width)
      balls.push_back({corner.centre, corner.radius});
  return balls;
}

void ProfileSurface::do_project(std::span<const Vec3> points,
                                double reach,
                                std::span<Projection> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 x = points[i].head<2>();
    double limit2 = reach * reach;
    const auto hint = static_cast<std::size_t>(out[i].patch);
    if (out[i].patch >= 0 && hint < pieces_.size())
      limit2 = std::min(limit2, closest(x, hint, box_distance2(x, hint / block_size)).distance2);
    const Nearest near = nearest(x, limit2);
    out[i] = {};
    if (!(near.distance2 <= reach * reach))
      continue;
    const PlaneProjection p = at(x, near);
    if (!p.found)
      continue;
    out[i].gap = p.gap;
    out[i].normal.head<2>() = p.normal;
    out[i].foot = points[i] - p.gap * out[i].normal;
    out[i].dnormal_dx.topLeftCorner<2, 2>() = p.dnormal_dx;
    out[i].patch = static_cast<std::int32_t>(near.piece);
  }
}

double ProfileSurface::box_distance2(const Vec2& x, std::size_t block) const {
  const Vec2 low = boxes_[block].low.head<2>(), high = boxes_[block].high.head<2>();
  return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm();
}

// A piece is never counted nearer than the box of its block, whatever the rounding, so that leaving
// out boxes cannot change the result. (The distance to a box is not inlined, so that the compiler
// contracts it to fused multiply-adds in one way only.)
ClosestOnPiece ProfileSurface::closest(const Vec2& x, std::size_t piece, double box2) const {
  ClosestOnPiece closest = pieces_[piece].closest(x);
  closest.distance2 = std::max(closest.distance2, box2);
  return closest;
}

// The piece with the smallest (distance, number) among those no farther than `limit2`.
ProfileSurface::Nearest ProfileSurface::nearest(const Vec2& x, double limit2) const {
  Nearest best;
  for (std::size_t block = 0; block < boxes_.size(); ++block) {
    const double box2 = box_distance2(x, block);
    if (box2 > limit2)
      continue;
    const std::size_t last = std::min((block + 1) * block_size, pieces_.size());
    for (std::size_t i = block * block_size; i < last; ++i) {
      const ClosestOnPiece candidate = closest(x, i, box2);
      if (candidate.distance2 >= best.distance2)
        continue;
      best = {candidate.distance2, i, candidate.place};
      limit2 = std::min(limit2, candidate.distance2);
    }
  }
  return best;
}

PlaneProjection ProfileSurface::at(const Vec2& x, const Nearest& nearest) const {
  const ProfilePiece& piece = pieces_[nearest.piece];
  if (nearest.place == Place::interior) {
    if (piece.is_arc())
      return on_arc(x, piece);
    const Vec2 normal = normal_of(piece.tangent_a);
    return {(x - piece.a).dot(normal), normal};
  }
  const bool at_start = nearest.place == Place::start;
  const Vec2 normal = normal_of(at_start ? piece.tangent_a : piece.tangent_b);
  const std::size_t n = pieces_.size();
  const std::size_t other = at_start ? (nearest.piece + n - 1) % n : (nearest.piece + 1) % n;
  const bool end_of_chain = at_start ? nearest.piece == 0 : other == 0;
  const Vec2 corner = at_start ? piece.a : piece.b;
  if (end_of_chain && !profile_.closed)
    return at_end(x, corner, normal, at_start ? Vec2(-piece.tangent_a) : piece.tangent_b);
  const Vec2 neighbour = at_start ? pieces_[other].tangent_b : pieces_[other].tangent_a;
  return at_joint(x, corner, (normal + normal_of(neighbour)).normalized());
}

// (G.9)
PlaneProjection ProfileSurface::on_arc(const Vec2& x, const ProfilePiece& piece) const {
  // With more digits: a large arc's distances leave none for the gap.
  const Eigen::Matrix<long double, 2, 1> wide =
      x.cast<long double>() - piece.centre.cast<long double>();
  const long double wide_distance = wide.norm();
  const Vec2 v = wide.cast<double>();
  const auto distance = static_cast<double>(wide_distance);
  const double turn = std::copysign(1.0, piece.radius);
  const double gap = turn * static_cast<double>(wide_distance - std::abs(piece.radius));
  // At the centre the middle of the arc is as close as any other point of it.
  if (distance <= 4.0 * epsilon * std::abs(piece.radius))
    return {gap, turn * (piece.point(0.5) - piece.centre).normalized()};
  const Vec2 unit = v / distance;
  return {gap, turn * unit, turn * turning(unit, distance)};
}

// (G.10)
PlaneProjection
ProfileSurface::at_joint(const Vec2& x, const Vec2& corner, const Vec2& pseudo_normal) const {
  const Vec2 v = x - corner;
  const double distance = v.norm(), height = v.dot(pseudo_normal);
  if (distance <= rounding_)
    return {height, pseudo_normal};
  const double sign = height >= 0.0 ? 1.0 : -1.0;
  const Vec2 unit = v / distance;
  return {sign * distance, sign * unit, sign * turning(unit, distance)};
}

// (G.11)
PlaneProjection ProfileSurface::at_end(const Vec2& x,
                                       const Vec2& end,
                                       const Vec2& normal,
                                       const Vec2& outward) const {
  const Vec2 v = x - end;
  const double distance = v.norm(), height = v.dot(normal);
  if (height >= 0.0 && distance > rounding_) {
    const Vec2 unit = v / distance;
    return {distance, unit, turning(unit, distance)};
  }
  return {height, normal, Mat2::Zero(), v.dot(outward) <= rim_slack * bounds_.size()};
}

} // namespace

SurfacePtr make_profile(const Profile& profile) {
  std::vector<Complaint> complaints;
  for (const std::string& what : flaws(profile))
    complaints.push_back({"", what, ""});
  if (!complaints.empty())
    throw Error(Fault::geometry, std::move(complaints));
  return std::make_unique<const ProfileSurface>(profile);
}

} // namespace billet::geometry
