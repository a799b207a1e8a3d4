#include "geometry/mesh2d/snapped_loops.h"

#include "geometry/base/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace billet::geometry {

namespace {

/// A side that has to go this share of its length anywhere is divided.
constexpr double far = 0.05;

/// Pieces of a side at most.
constexpr int most_pieces = 32;

/// Sides shorter than this share of the least length are where several places went to one.
constexpr double no_length = 1e-3;

/// Where a side is tried.
constexpr std::array<double, 9> sampled_shares{0.0,   0.125, 0.25,  0.375, 0.5,
                                               0.625, 0.75,  0.875, 1.0};

Vec2 place_on(const SideLoop& loop, std::size_t i, double xi) {
  const Vec2 &a = loop.corners[i], &m = loop.middles[i],
             &b = loop.corners[(i + 1) % loop.corners.size()];
  if (xi == 0.0)
    return a;
  if (xi == 0.5)
    return m;
  if (xi == 1.0)
    return b;
  return (1.0 - xi) * (1.0 - 2.0 * xi) * a + 4.0 * xi * (1.0 - xi) * m + xi * (2.0 * xi - 1.0) * b;
}

} // namespace

SnappedLoops::SnappedLoops(std::span<const SideLoop> loops, const Snap& snap, double least) {
  for (std::size_t l = 0; l < loops.size(); ++l)
    add(loops[l], static_cast<std::int32_t>(l), snap, least);
}

void SnappedLoops::add(const SideLoop& loop, std::int32_t number, const Snap& snap, double least) {
  const std::size_t n = loop.corners.size();
  const auto snapped = [&](std::size_t i, double xi, const Vec2& x) {
    return snap ? snap(loop.part[i], {number, static_cast<std::int32_t>(i), xi}, x) : x;
  };
  SideLoop result;
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < n; ++i) {
    const double chord = (loop.corners[(i + 1) % n] - loop.corners[i]).norm();
    const auto goes_far = [&](double xi) {
      const Vec2 x = place_on(loop, i, xi);
      return (snapped(i, xi, x) - x).norm() > far * chord;
    };
    const bool divided =
        snap && std::any_of(sampled_shares.begin(), sampled_shares.end(), goes_far);
    const int count =
        divided ? std::clamp(static_cast<int>(std::ceil(chord / least)), 2, most_pieces) : 1;
    for (int k = 0; k < count; ++k) {
      const double from = static_cast<double>(k) / count, to = static_cast<double>(k + 1) / count;
      const double middle = 0.5 * (from + to);
      // A corner belongs to the sides on both its sides.
      const Vec2 corner = place_on(loop, i, from);
      const Vec2 start = k == 0 ? snapped((i + n - 1) % n, 1.0, corner) : corner;
      result.corners.push_back(snapped(i, from, start));
      result.middles.push_back(snapped(i, middle, place_on(loop, i, middle)));
      result.part.push_back(loop.part[i]);
      result.keep.push_back(static_cast<char>(k == 0 ? loop.keep[i] : 0));
      result.hold.push_back(loop.hold[i]);
      pieces.push_back({static_cast<std::int32_t>(i), from, to});
    }
  }
  join_short(result, pieces, no_length * least);
  loops_.push_back(std::move(result));
  pieces_.push_back(std::move(pieces));
}

void SnappedLoops::join_short(SideLoop& loop, std::vector<Piece>& pieces, double shortest) {
  for (std::size_t i = 0; i < pieces.size();) {
    const std::size_t next = (i + 1) % pieces.size();
    Vec2& middle = loop.middles[i];
    const Vec2 &a = loop.corners[i], &b = loop.corners[next];
    if ((b - a).norm() > shortest) {
      if ((middle - a).norm() <= shortest || (middle - b).norm() <= shortest)
        middle = 0.5 * (a + b);
      ++i;
      continue;
    }
    if (next > i && pieces[next].side == pieces[i].side) { // the corner after it goes
      loop.keep[next] = loop.keep[i];
      loop.corners[next] = a;
      pieces[next].from = pieces[i].from;
      erase(loop, pieces, i);
    } else if (i > 0 && pieces[i - 1].side == pieces[i].side) { // the corner before it goes
      pieces[i - 1].to = pieces[i].to;
      erase(loop, pieces, i);
    } else {
      ++i; // a whole side of the loop before: to be refused
    }
  }
}

void SnappedLoops::erase(SideLoop& loop, std::vector<Piece>& pieces, std::size_t i) {
  const auto n = static_cast<std::ptrdiff_t>(i);
  loop.corners.erase(loop.corners.begin() + n);
  loop.middles.erase(loop.middles.begin() + n);
  loop.part.erase(loop.part.begin() + n);
  loop.keep.erase(loop.keep.begin() + n);
  loop.hold.erase(loop.hold.begin() + n);
  pieces.erase(pieces.begin() + n);
}

BoundaryPlace SnappedLoops::original(const BoundaryPlace& place) const {
  const Piece& piece = pieces_[idx(place.loop)][idx(place.side)];
  const double xi = place.xi == 0.0   ? piece.from
                    : place.xi == 1.0 ? piece.to
                                      : piece.from + place.xi * (piece.to - piece.from);
  return {place.loop, piece.side, xi};
}

} // namespace billet::geometry
