#include "geometry/mesh2d/closed_folds.h"

#include "geometry/base/angle.h"
#include "geometry/triangles/box_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::geometry {

namespace {

constexpr double most_way = 0.25;  // of the loop's length that a fold may take
constexpr double most_area = 0.02; // of the loop's area
/// Sides that bulge may cross each other in a twelfth of their length next to their corner.
constexpr std::size_t chords_of_side = 12;

/// A place on a side's parabola.
Vec2 on_side(const SideLoop& loop, std::size_t side, double xi) {
  const Vec2& a = loop.corners[side];
  const Vec2& b = loop.corners[(side + 1) % loop.corners.size()];
  const Vec2 bulge = 2.0 * (2.0 * loop.middles[side] - a - b);
  return a + xi * (b - a) + xi * (1.0 - xi) * bulge;
}

/// A loop as chords, in turn.
struct Chords {
  std::vector<Vec2> points;
  std::vector<double> ways{0.0}; ///< to each of them, and all round

  explicit Chords(const SideLoop& loop) {
    for (std::size_t side = 0; side < loop.corners.size(); ++side)
      for (std::size_t k = 0; k < chords_of_side; ++k)
        points.push_back(
            on_side(loop, side, static_cast<double>(k) / static_cast<double>(chords_of_side)));
    for (std::size_t i = 0; i < points.size(); ++i)
      ways.push_back(ways.back() + (next(i) - points[i]).norm());
  }
  [[nodiscard]] const Vec2& next(std::size_t i) const { return points[(i + 1) % points.size()]; }
  [[nodiscard]] double length(std::size_t i) const { return ways[i + 1] - ways[i]; }
  [[nodiscard]] double way(std::size_t i, double share) const {
    return ways[i] + share * length(i);
  }
};

/// Where two chords meet: shares of the way along each.
struct Meeting {
  double first, second;
};

std::optional<Meeting> crossing(const Chords& all, std::size_t i, std::size_t j) {
  const Vec2 a = all.next(i) - all.points[i];
  const Vec2 b = all.next(j) - all.points[j];
  const Vec2 d = all.points[j] - all.points[i];
  const double area = cross(a, b);
  if (area == 0.0)
    return std::nullopt;
  const double s = cross(d, b) / area, t = cross(d, a) / area;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0)
    return std::nullopt;
  return Meeting{s, t};
}

/// The nearest place of chord `i` to a point, as a share of it.
double foot_on(const Chords& all, std::size_t i, const Vec2& x) {
  const Vec2 a = all.next(i) - all.points[i];
  return std::clamp((x - all.points[i]).dot(a) / a.squaredNorm(), 0.0, 1.0);
}

/// Where two chords that do not cross are nearest to each other: at an end of one of them.
Meeting nearest(const Chords& all, std::size_t i, std::size_t j) {
  const auto at = [&](std::size_t k, double share) -> Vec2 {
    return all.points[k] + share * (all.next(k) - all.points[k]);
  };
  Meeting best{0.0, 0.0};
  double least = HUGE_VAL;
  const auto offer = [&](const Meeting& m) {
    const double distance = (at(i, m.first) - at(j, m.second)).norm();
    if (distance < least) {
      least = distance;
      best = m;
    }
  };
  for (const double end : {0.0, 1.0}) {
    offer({end, foot_on(all, j, at(i, end))});
    offer({foot_on(all, i, at(j, end)), end});
  }
  return best;
}

/// Twice the area that chords from one place to another and the way back across enclose.
double doubled_area(const Chords& all, std::size_t from, std::size_t to, const Vec2& at) {
  const std::size_t n = all.points.size();
  double area = 0.0;
  Vec2 last = Vec2::Zero();
  for (std::size_t k = from; k != to; k = (k + 1) % n) {
    const Vec2 x = all.next(k) - at;
    area += cross(last, x);
    last = x;
  }
  return area;
}

class Finder {
public:
  Finder(const SideLoop& loop,
         std::span<const char> stays,
         double near,
         double deepest,
         std::span<const Vec2> welds)
      : loop_(loop), chords_(loop), stays_(stays), near_(near), deepest_(deepest), welds_(welds) {
    const std::size_t n = chords_.points.size();
    area_ = doubled_area(chords_, 0, n - 1, chords_.points.front());
  }

  [[nodiscard]] std::optional<ClosedFold> longest() const {
    const std::size_t n = chords_.points.size();
    std::vector<Box> boxes(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double reach = 0.5 * near_;
      for (const Vec2& x : {chords_.points[i], chords_.next(i)}) {
        boxes[i].add({x.x() - reach, x.y() - reach, 0.0});
        boxes[i].add({x.x() + reach, x.y() + reach, 0.0});
      }
    }
    std::optional<ClosedFold> found;
    visit_box_pairs(boxes, [&](std::int32_t i, std::int32_t j) {
      const auto first = static_cast<std::size_t>(i), second = static_cast<std::size_t>(j);
      if (second - first > 1 && !(first == 0 && second == n - 1))
        if (const auto fold = fold_between(first, second);
            fold && (!found || is_before(*fold, *found)))
          found = fold;
      return true;
    });
    return found;
  }

private:
  /// The order of the visits is not ours.
  static bool is_before(const ClosedFold& a, const ClosedFold& b) {
    return a.way != b.way ? a.way > b.way : a.from.side < b.from.side;
  }

  [[nodiscard]] std::optional<Meeting> meeting(std::size_t i, std::size_t j) const {
    if (auto cross = crossing(chords_, i, j))
      return cross;
    if (near_ == 0.0)
      return std::nullopt;
    const Meeting m = nearest(chords_, i, j);
    const double apart = (point(i, m.first) - point(j, m.second)).norm();
    // Round a bend the boundary comes near itself as well.
    constexpr double least_way = 4.0; // over the distance
    const double total = chords_.ways.back();
    const double way = chords_.way(j, m.second) - chords_.way(i, m.first);
    if (apart > near_ || std::min(way, total - way) < least_way * apart)
      return std::nullopt;
    return m;
  }

  [[nodiscard]] Vec2 point(std::size_t i, double share) const {
    return chords_.points[i] + share * (chords_.next(i) - chords_.points[i]);
  }

  [[nodiscard]] std::optional<ClosedFold> fold_between(std::size_t i, std::size_t j) const {
    const auto m = meeting(i, j);
    if (!m)
      return std::nullopt;
    const double total = chords_.ways.back();
    const double way = chords_.way(j, m->second) - chords_.way(i, m->first);
    const Vec2 at = 0.5 * (point(i, m->first) + point(j, m->second));
    const bool forward = way <= total - way;
    const ClosedFold fold =
        forward ? ClosedFold{place(i, m->first), place(j, m->second), at, way}
                : ClosedFold{place(j, m->second), place(i, m->first), at, total - way};
    const double area = forward ? doubled_area(chords_, i, j, at) : doubled_area(chords_, j, i, at);
    const bool crosses = crossing(chords_, i, j).has_value();
    if (fold.way > most_way * total || fold.depth() > deepest_ ||
        std::abs(area) > most_area * std::abs(area_) || (!crosses && area > 0.0) ||
        is_rest_of_weld(fold) || holds_what_stays(fold))
      return std::nullopt;
    return fold;
  }

  [[nodiscard]] static BoundaryPlace place(std::size_t chord, double share) {
    const double chords = static_cast<double>(chords_of_side);
    return {0, static_cast<std::int32_t>(chord / chords_of_side),
            (static_cast<double>(chord % chords_of_side) + share) / chords};
  }

  [[nodiscard]] bool is_rest_of_weld(const ClosedFold& fold) const {
    return std::any_of(welds_.begin(), welds_.end(),
                       [&](const Vec2& weld) { return (weld - fold.at).norm() <= 2.0 * deepest_; });
  }

  [[nodiscard]] bool holds_what_stays(const ClosedFold& fold) const {
    const std::size_t n = loop_.corners.size();
    const auto last = static_cast<std::size_t>(fold.to.side);
    for (auto side = static_cast<std::size_t>(fold.from.side);; side = (side + 1) % n) {
      if (stays_[side] != 0)
        return true;
      if (side == last)
        return false;
    }
  }

  const SideLoop& loop_;
  Chords chords_;
  std::span<const char> stays_;
  double near_;
  double deepest_;
  std::span<const Vec2> welds_;
  double area_ = 0.0;
};

} // namespace

std::optional<ClosedFold> closed_fold(const SideLoop& loop,
                                      std::span<const char> stays,
                                      double near,
                                      double deepest,
                                      std::span<const Vec2> welds) {
  return Finder(loop, stays, near, deepest, welds).longest();
}

WeldedLoop without_fold(const SideLoop& loop, const ClosedFold& fold, double rest) {
  const std::size_t n = loop.corners.size();
  const auto is_near = [&](std::size_t corner) {
    const std::size_t before = (corner + n - 1) % n;
    return loop.keep[corner] == 0 && loop.part[before] == loop.part[corner] &&
           (loop.corners[corner] - fold.at).norm() < rest;
  };
  auto first = static_cast<std::size_t>(fold.from.side); // begins the last side before the weld
  auto last = (static_cast<std::size_t>(fold.to.side) + 1) % n; // ends the first one after it
  while (is_near(first) && first != last)
    first = (first + n - 1) % n;
  while (is_near(last) && first != last)
    last = (last + 1) % n;
  WeldedLoop welded;
  const auto add = [&](const Vec2& corner, const Vec2& middle, std::size_t side, char keep,
                       std::int32_t old) {
    welded.loop.corners.push_back(corner);
    welded.loop.middles.push_back(middle);
    welded.loop.part.push_back(loop.part[side]);
    welded.loop.hold.push_back(loop.hold[side]);
    welded.loop.keep.push_back(keep);
    welded.sides.push_back(static_cast<std::int32_t>(side));
    welded.corners.push_back(old);
  };
  // From the weld round to the weld again.
  add(fold.at, 0.5 * (fold.at + loop.corners[last]), (last + n - 1) % n, 1, -1);
  for (std::size_t side = last; side != first; side = (side + 1) % n)
    add(loop.corners[side], loop.middles[side], side, loop.keep[side],
        static_cast<std::int32_t>(side));
  add(loop.corners[first], 0.5 * (loop.corners[first] + fold.at), first, loop.keep[first],
      static_cast<std::int32_t>(first));
  return welded;
}

} // namespace billet::geometry
