#include "geometry/mesh2d/long_sides.h"

#include "geometry/base/angle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <utility>

namespace billet::geometry {

namespace {

/// Ratio of the lengths that are tried.
constexpr double step = std::numbers::sqrt2;

/// Between the boundary and a side that stands for it, 60 degrees: the lips of a fold are not
/// passed over.
constexpr double least_cosine = 0.5;

/// Three times around, so that no stretch is broken by where the way begins.
std::vector<double> around(const std::vector<double>& places, double length) {
  std::vector<double> result;
  for (const double turn : {-1.0, 0.0, 1.0})
    for (const double place : places)
      result.push_back(place + turn * length);
  return result;
}

} // namespace

LongSides::LongSides(ClosedWay way, const std::vector<double>& stops, double turn)
    : way_(std::move(way)), stops_(around(stops, way_.length)), turn_(turn) {
  way_.places = around(way_.places, way_.length);
  const std::vector<Vec2> once = way_.points;
  for (int turns = 0; turns < 2; ++turns)
    way_.points.insert(way_.points.end(), once.begin(), once.end());
}

Vec2 LongSides::point(double place) const {
  const auto after = std::upper_bound(way_.places.begin(), way_.places.end(), place);
  const auto k = std::clamp<std::ptrdiff_t>(after - way_.places.begin(), 1,
                                            static_cast<std::ptrdiff_t>(way_.places.size()) - 1);
  const auto b = static_cast<std::size_t>(k), a = b - 1;
  const double share = (place - way_.places[a]) / (way_.places[b] - way_.places[a]);
  return way_.points[a] + share * (way_.points[b] - way_.points[a]);
}

bool LongSides::stands(double place, double length) const {
  const auto next = std::upper_bound(stops_.begin(), stops_.end(), place);
  const double first = next == stops_.begin() ? -way_.length : *std::prev(next);
  const double last = next == stops_.end() ? 2.0 * way_.length : *next;
  const double from = std::max(first, std::min(place, last - 0.5 * length) - 0.5 * length);
  const double to = std::min(last, from + length);
  const Vec2 a = point(from), chord = point(to) - a;
  const Vec2 along = chord.normalized();
  const double most = 0.125 * turn_ * chord.norm();
  auto k = static_cast<std::size_t>(std::lower_bound(way_.places.begin(), way_.places.end(), from) -
                                    way_.places.begin());
  for (Vec2 before = a; k < way_.places.size() && way_.places[k] < to; before = way_.points[k++]) {
    const Vec2 way = way_.points[k] - before;
    const bool turns_back = along.dot(way) < least_cosine * way.norm();
    if (turns_back || std::abs(cross(along, way_.points[k] - a)) > most)
      return false;
  }
  return true;
}

double LongSides::longest(double place, double least, double most) const {
  double length = std::min(most, 0.5 * way_.length);
  while (length >= least && !stands(place, length))
    length /= step;
  return length >= least ? length : 0.0;
}

} // namespace billet::geometry
