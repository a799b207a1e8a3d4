#include "geometry/mesh2d/boundary_curve.h"

#include "geometry/base/angle.h"
#include "geometry/mesh2d/long_sides.h"
#include "geometry/surfaces/profile_piece.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace billet::geometry {

namespace {

/// Cosine below which the tangent is too far off the chord for an arc, as at (G.18).
constexpr double least_tangent_cosine = 0.25;

/// Gauss points and weights on [0, 1].
constexpr std::array<double, 5> gauss_points{0.046910077030668, 0.230765344947158, 0.5,
                                             0.769234655052842, 0.953089922969332};
constexpr std::array<double, 5> gauss_weights{
    0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683, 0.118463442528095};

double angle(const Vec2& from, const Vec2& to) { return std::atan2(cross(from, to), from.dot(to)); }

/// Directions of a parabola at its ends.
struct Ends {
  Vec2 first, last;
};

Ends ends(const SideLoop& loop, std::size_t side) {
  const Vec2& a = loop.corners[side];
  const Vec2& b = loop.corners[(side + 1) % loop.corners.size()];
  const Vec2 to_middle = loop.middles[side] - a, from_middle = b - loop.middles[side];
  return {3.0 * to_middle - from_middle, 3.0 * from_middle - to_middle};
}

/// Tangent at p of the circle through p - before, p and p + after. (G.41)
Vec2 tangent_between(const Vec2& before, const Vec2& after) {
  const Vec2 sum = before / before.squaredNorm() + after / after.squaredNorm();
  return sum.squaredNorm() > 0.0 ? sum.normalized() : after.normalized();
}

/// Tangent at p of the circle through p, p + first and p + first + second.
Vec2 tangent_at_end(const Vec2& first, const Vec2& second) {
  const Vec2 both = first + second;
  const Vec2 tangent = both.squaredNorm() > 0.0
                           ? Vec2(first / first.squaredNorm() - both / both.squaredNorm())
                           : first;
  return tangent.dot(first) > 0.0 ? tangent.normalized() : first.normalized();
}

/// How far the next control point lies along the tangent from the end of chord e. (G.41)
Vec2 handle(const Vec2& tangent, const Vec2& e) {
  const double length = e.norm();
  const double cosine = tangent.dot(e) / length;
  return length * (cosine > least_tangent_cosine ? 2.0 / (3.0 * (1.0 + cosine)) : 1.0 / 3.0) *
         tangent;
}

/// Takes those of the sharp corners between free sides away that are none for a longer side.
void pass_over_ripples(const SideLoop& loop,
                       const CornerRule& rule,
                       const std::vector<char>& kept,
                       std::vector<char>& sharp) {
  if (std::find(sharp.begin(), sharp.end(), 1) == sharp.end())
    return;
  ClosedWay way{.points = {}, .places = {}, .length = 0.0};
  std::vector<double> stops;
  const auto add = [&](const Vec2& x, const Vec2& next) {
    way.points.push_back(x);
    way.places.push_back(way.length);
    way.length += (next - x).norm();
  };
  std::vector<char> stop = kept;
  const std::size_t n = loop.corners.size();
  for (std::size_t i = 0; i < n; ++i)
    if (loop.hold[i] != 0)
      stop[i] = stop[(i + 1) % n] = 1;
  for (std::size_t i = 0; i < n; ++i) {
    if (stop[i] != 0)
      stops.push_back(way.length);
    add(loop.corners[i], loop.middles[i]);
    add(loop.middles[i], loop.corners[(i + 1) % n]);
  }
  const LongSides long_sides(way, stops, rule.turn_of_side);
  for (std::size_t i = 0; i < n; ++i) {
    const double half_a_side = way.places[2 * i + 1] - way.places[2 * i];
    if (sharp[i] != 0 && stop[i] == 0 &&
        long_sides.longest(way.places[2 * i], half_a_side, rule.longest_side(loop.corners[i])) >
            0.0)
      sharp[i] = 0;
  }
}

} // namespace

std::vector<char> kept_corners(const SideLoop& loop, const CornerRule& rule) {
  const std::size_t n = loop.corners.size();
  std::vector<char> kept(n), sharp(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const Ends in = ends(loop, before), out = ends(loop, i);
    const double turn = angle(in.last, out.first);
    const double sense = std::copysign(1.0, turn);
    const double beside =
        std::max(sense * angle(in.first, in.last), sense * angle(out.first, out.last));
    kept[i] = loop.part[before] != loop.part[i] || loop.keep[i] != 0;
    sharp[i] = std::abs(turn) > rule.turn && std::abs(turn) > beside;
  }
  if (rule.longest_side)
    pass_over_ripples(loop, rule, kept, sharp);
  for (std::size_t i = 0; i < n; ++i)
    kept[i] = kept[i] != 0 || sharp[i] != 0;
  return kept;
}

Vec2 BoundaryCurve::Piece::point(double t) const {
  if (t >= 1.0)
    return b;
  const double r = 1.0 - t; // from a on, so that a coordinate that is constant stays so to the bit
  return a + 3.0 * r * r * t * u + 3.0 * r * t * t * (b - a - v) + t * t * t * (b - a);
}

Vec2 BoundaryCurve::Piece::derivative(double t) const {
  const double r = 1.0 - t;
  return 3.0 * (r * r * u + 2.0 * r * t * (b - a - v - u) + t * t * v);
}

double BoundaryCurve::Piece::length(double t) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < gauss_points.size(); ++i)
    sum += gauss_weights[i] * derivative(t * gauss_points[i]).norm();
  return t * sum;
}

BoundaryCurve::BoundaryCurve(const SideLoop& loop, std::int32_t number, const CornerRule& rule)
    : part_(loop.part), held_(loop.hold), number_(number) {
  const std::vector<char> kept = kept_corners(loop, rule);
  const auto first = std::find_if(kept.begin(), kept.end(), [](char k) { return k != 0; });
  const bool any = first != kept.end();
  const std::size_t start = any ? static_cast<std::size_t>(first - kept.begin()) : 0;
  if (rule.parabolas)
    add_parabolas(loop, start);
  else
    add_pieces(loop, start, kept);
  for (Piece& piece : pieces_) {
    piece.start = length_;
    if (piece.xi == 0.0 && kept[static_cast<std::size_t>(piece.side)] != 0)
      kept_.push_back(length_);
    piece.turn =
        std::abs(angle(piece.u, piece.b - piece.a)) + std::abs(angle(piece.b - piece.a, piece.v));
    length_ += piece.length(1.0);
  }
  find_free_stretches(loop);
}

void BoundaryCurve::add_pieces(const SideLoop& loop,
                               std::size_t first,
                               const std::vector<char>& kept) {
  const std::size_t n = 2 * loop.corners.size();
  const auto node = [&](std::size_t i) -> const Vec2& {
    const std::size_t side = (first + i / 2) % loop.corners.size();
    return i % 2 == 0 ? loop.corners[side] : loop.middles[side];
  };
  const auto is_kept = [&](std::size_t i) {
    return i % 2 == 0 && kept[(first + i / 2) % loop.corners.size()] != 0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = node(i), &b = node(i + 1);
    const Vec2 e = b - a, before = a - node(i + n - 1), after = node(i + 2) - b;
    Piece piece;
    piece.a = a;
    piece.b = b;
    piece.u = handle(is_kept(i) ? tangent_at_end(e, after) : tangent_between(before, e), e);
    piece.v =
        handle(is_kept(i + 1) ? Vec2(-tangent_at_end(-e, -before)) : tangent_between(e, after), e);
    piece.side = static_cast<std::int32_t>((first + i / 2) % loop.corners.size());
    piece.xi = i % 2 == 0 ? 0.0 : 0.5;
    pieces_.push_back(piece);
  }
}

/// Each half of a side as the cubic that is the same parabola.
void BoundaryCurve::add_parabolas(const SideLoop& loop, std::size_t first) {
  constexpr double of_half = 1.0 / 6.0; // a third, for the control point, of half a side
  const std::size_t n = loop.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t side = (first + i) % n;
    const Vec2 &a = loop.corners[side], &m = loop.middles[side], &b = loop.corners[(side + 1) % n];
    const Ends along = ends(loop, side);
    Piece piece;
    piece.side = static_cast<std::int32_t>(side);
    piece.a = a;
    piece.b = m;
    piece.u = of_half * along.first;
    piece.v = of_half * (b - a);
    piece.xi = 0.0;
    pieces_.push_back(piece);
    piece.a = m;
    piece.b = b;
    piece.u = piece.v;
    piece.v = of_half * along.last;
    piece.xi = 0.5;
    pieces_.push_back(piece);
  }
}

void BoundaryCurve::find_free_stretches(const SideLoop& loop) {
  for (std::size_t i = 0; i < pieces_.size(); i += 2) {
    const Piece& piece = pieces_[i];
    if (loop.hold[static_cast<std::size_t>(piece.side)] != 0)
      continue;
    const double end = i + 2 < pieces_.size() ? pieces_[i + 2].start : length_;
    const bool goes_on = !free_.empty() && free_.back().to == piece.start &&
                         !std::binary_search(kept_.begin(), kept_.end(), piece.start);
    if (goes_on)
      free_.back().to = end;
    else
      free_.push_back({piece.start, end, false});
  }
  if (!kept_.empty() || free_.empty() || free_.front().from > 0.0 || free_.back().to < length_)
    return;
  if (free_.size() == 1) {
    free_.front().endless = true;
  } else { // one stretch through the start of the loop
    free_.front().from = free_.back().from - length_;
    free_.back().to = free_.front().to + length_;
  }
}

BoundaryCurve::At BoundaryCurve::at(double s) const {
  if (s >= length_)
    s -= length_;
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), s,
                                     [](double x, const Piece& p) { return x < p.start; });
  const Piece& piece = *(next - 1);
  const double way = s - piece.start;
  if (way <= 0.0)
    return {piece, 0.0};
  const double whole = (next == pieces_.end() ? length_ : next->start) - piece.start;
  double t = std::min(1.0, way / whole);
  for (int i = 0; i < 20; ++i) { // Newton's method; the speed along the cubic varies little
    const double step = (way - piece.length(t)) / piece.derivative(t).norm();
    t = std::clamp(t + step, 0.0, 1.0);
    if (!(std::abs(step) > 1e-14))
      break;
  }
  return {piece, t};
}

Vec2 BoundaryCurve::point(double s) const {
  const At here = at(s);
  return here.piece.point(here.t);
}

double BoundaryCurve::place_at(double s, double distance, double sense) const {
  const Vec2 x = point(s);
  double way = distance;
  for (int i = 0; i < 5; ++i) { // the chord grows about as the way does
    const double there = std::clamp(s + sense * way, 0.0, length_);
    way *= distance / (point(there) - x).norm();
  }
  return s + sense * way;
}

double BoundaryCurve::turn_at(std::size_t kept) const {
  const auto out = std::lower_bound(pieces_.begin(), pieces_.end(), kept_[kept],
                                    [](const Piece& p, double x) { return p.start < x; });
  const Piece& in = out == pieces_.begin() ? pieces_.back() : *(out - 1);
  return angle(in.v, out->u);
}

Vec2 BoundaryCurve::tangent(double s) const {
  const At here = at(s);
  return here.piece.derivative(here.t).normalized();
}

BoundaryPlace BoundaryCurve::place(double s) const {
  const At here = at(s);
  return {number_, here.piece.side, here.piece.xi + 0.5 * here.t};
}

std::int32_t BoundaryCurve::part(double s) const {
  return part_[static_cast<std::size_t>(at(s).piece.side)];
}

bool BoundaryCurve::is_held(double s) const {
  return held_[static_cast<std::size_t>(at(s).piece.side)] != 0;
}

double BoundaryCurve::freedom(double s) const {
  for (const Stretch& stretch : free_) {
    if (stretch.endless)
      return 1.0;
    if (s > stretch.from && s < stretch.to) {
      const double sigma = (s - stretch.from) / (stretch.to - stretch.from);
      return 4.0 * sigma * (1.0 - sigma);
    }
  }
  return 0.0;
}

std::vector<double> BoundaryCurve::stations(double turn, double step) const {
  std::vector<double> result;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double end = i + 1 < pieces_.size() ? pieces_[i + 1].start : length_;
    const double way = end - pieces_[i].start;
    const double parts = std::ceil(std::max({1.0, pieces_[i].turn / turn, way / step}));
    for (std::size_t k = 0; k < static_cast<std::size_t>(parts); ++k)
      result.push_back(pieces_[i].start + way * (static_cast<double>(k) / parts));
  }
  return result;
}

double BoundaryCurve::curvature(double s) const {
  const Piece& piece = at(s).piece;
  return piece.turn / piece.length(1.0);
}

} // namespace billet::geometry
