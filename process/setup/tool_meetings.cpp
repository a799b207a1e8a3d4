#include "process/setup/tool_meetings.h"

#include "geometry/base/box.h"
#include "geometry/collision/facet_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace billet::process {

namespace {

using geometry::FacetBody;
using geometry::PlacedBody;
using geometry::Pose;

// Overlaps below this share of the workpiece's size are clearances closed by facets, and nobody's
// concern.
constexpr double tolerated_share = 1e-3;
constexpr int most_steps = 400;           // that a pair near to each other takes along its motion
constexpr std::size_t most_places = 8000; // asked for their depth in the other tool
constexpr double closed_gap = 1e-9;       // share of the size at which a clearance is none
constexpr int most_closing_steps = 60;
constexpr int halvings = 25;
constexpr double most_delay = 20.0; // tolerated overlaps between closing and its being seen

std::vector<Vec3> corners(const Box& box) {
  std::vector<Vec3> list;
  list.reserve(8);
  for (int i = 0; i < 8; ++i)
    list.emplace_back((i & 1) != 0 ? box.high.x() : box.low.x(),
                      (i & 2) != 0 ? box.high.y() : box.low.y(),
                      (i & 4) != 0 ? box.high.z() : box.low.z());
  return list;
}

bool bounded(const contact::Tool& tool) { return std::isfinite(tool.surface->bounds().size()); }
bool driven(const contact::Tool& tool) { return tool.motion.force || tool.motion.torque; }

/// What unbounded tools are cut to: all of the workpiece and of the bounded tools at the start.
Box window_of(const Scene& scene) {
  Box window = box_of(scene.part.mesh.points);
  for (const contact::Tool& tool : scene.tools)
    if (bounded(tool))
      for (const Vec3& corner : corners(tool.surface->bounds()))
        window.add(tool.motion.pose(0.0).to_space(corner));
  return window;
}

FacetBody body_of(const Scene& scene, const contact::Tool& tool, const Box& window) {
  Box in_tool;
  for (const Vec3& corner : corners(window))
    in_tool.add(tool.motion.pose(0.0).to_tool(corner));
  const bool planar = scene.part.analysis != mechanics::Analysis::solid;
  return {tool.surface->display(in_tool, planar), window.size()};
}

/// A time span within which two tools act.
struct Span {
  double from;
  double to;
};

std::vector<Span> common_spans(const Scene& scene, std::size_t i, std::size_t j) {
  std::vector<Span> spans;
  double start = 0.0;
  for (const Stage& stage : scene.stages) {
    const contact::Tool &a = scene.tools[i], &b = scene.tools[j];
    const Span span{std::max({start, a.active_from, b.active_from}),
                    std::min({stage.end, a.active_to, b.active_to})};
    if (!stage.unload && stage.tools[i] != 0 && stage.tools[j] != 0 && span.from <= span.to) {
      if (!spans.empty() && spans.back().to == span.from)
        spans.back().to = span.to;
      else
        spans.push_back(span);
    }
    start = stage.end;
  }
  return spans;
}

/// Whether a tool has acted before a time, and a load drives it: where it is then is not known.
bool moved_by_load(const Scene& scene, std::size_t tool, double time) {
  if (!driven(scene.tools[tool]))
    return false;
  const std::vector<Span> acts = common_spans(scene, tool, tool);
  return !acts.empty() && acts.front().from < time;
}

/// Largest distance of points in space from the axis that a tool turns about [mm].
double longest_arm(const geometry::Motion& motion, double time, std::span<const Vec3> points) {
  const Vec3 on_axis = motion.axis_point() + motion.offset + motion.translation(time);
  double longest = 0.0;
  for (const Vec3& p : points) {
    const Vec3 v = p - on_axis;
    longest = std::max(longest, (v - v.dot(motion.axis()) * motion.axis()).norm());
  }
  return longest;
}

/// How far a pair moves relative to each other: a bound of every point's way over time.
class RelativeWay {
public:
  RelativeWay(const Scene& scene,
              const contact::Tool& a,
              const contact::Tool& b,
              const Span& span,
              std::span<const double> arms) {
    constexpr int pieces = 200; // of speeds that are not constant between corners of tables
    times_ = {span.from, span.to};
    for (int k = 1; k < pieces; ++k)
      times_.push_back(span.from + (span.to - span.from) * k / pieces);
    for (const double t : scene.landing_times)
      if (t > span.from && t < span.to)
        times_.push_back(t);
    std::sort(times_.begin(), times_.end());
    for (std::size_t k = 1; k < times_.size(); ++k) {
      const double t0 = times_[k - 1], t1 = times_[k];
      const Vec3 shift = a.motion.translation(t1) - a.motion.translation(t0) -
                         b.motion.translation(t1) + b.motion.translation(t0);
      ways_.push_back(ways_.back() + shift.norm() +
                      std::abs(a.motion.angle(t1) - a.motion.angle(t0)) * arms[0] +
                      std::abs(b.motion.angle(t1) - b.motion.angle(t0)) * arms[1]);
    }
  }

  [[nodiscard]] double total() const { return ways_.back(); }
  [[nodiscard]] double between(double from, double to) const {
    return interpolated(times_, ways_, to) - interpolated(times_, ways_, from);
  }
  /// The time at which `way` more has been travelled since `time`; the end if that is sooner.
  [[nodiscard]] double later(double time, double way) const {
    const double wanted = interpolated(times_, ways_, time) + way;
    return wanted >= total() ? times_.back() : interpolated(ways_, times_, wanted);
  }

private:
  static double
  interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const auto after = std::clamp<std::ptrdiff_t>(
        std::upper_bound(x.begin(), x.end(), at) - x.begin(), 1, std::ssize(x) - 1);
    const auto k = static_cast<std::size_t>(after);
    const double length = x[k] - x[k - 1];
    const double share = length > 0.0 ? std::clamp((at - x[k - 1]) / length, 0.0, 1.0) : 1.0;
    return y[k - 1] + share * (y[k] - y[k - 1]);
  }

  std::vector<double> times_;
  std::vector<double> ways_{0.0};
};

/// Corners of a drawing, and middles of its facets: of two punches of one section no facets cut and
/// no corner is deep in the other, however far they have gone through each other.
std::vector<Vec3> places(const geometry::DisplayMesh& drawing) {
  std::vector<Vec3> list = drawing.points;
  const auto point = [&](std::int32_t i) { return drawing.points[static_cast<std::size_t>(i)]; };
  for (const auto& [a, b, c] : drawing.triangles)
    list.push_back((point(a) + point(b) + point(c)) / 3.0);
  for (const auto& [a, b] : drawing.lines)
    list.push_back(0.5 * (point(a) + point(b)));
  return list;
}

/// Two tools and how they lie to each other at a time.
class Pair {
public:
  Pair(const contact::Tool& a,
       const contact::Tool& b,
       const FacetBody& body_a,
       const FacetBody& body_b,
       const std::array<bool, 2>& solid,
       double size)
      : tools_{&a, &b}, bodies_{&body_a, &body_b}, solid_(solid), size_(size) {}

  /// From now on they are where they have been taken to, whatever the time.
  void place(const Pose& a, const Pose& b) { taken_ = {a, b}; }

  [[nodiscard]] double clearance(double time) const {
    return geometry::clearance(placed(0, time), placed(1, time));
  }

  /// The deepest overlap: of facets that cut, and of places of one in the solid of the other.
  [[nodiscard]] geometry::Cut overlap(double time) const {
    geometry::Cut deepest =
        geometry::deepest_cut(placed(0, time), placed(1, time)).value_or(geometry::Cut{});
    for (const std::size_t i : {0u, 1u})
      add_places(i, time, deepest);
    return deepest;
  }

  /// Longest lever of a tool's drawing about its axis [mm].
  [[nodiscard]] double arm(std::size_t i, double time) const {
    std::vector<Vec3> points = bodies_[i]->drawing().points;
    for (Vec3& p : points)
      p = tools_[i]->motion.pose(time).to_space(p);
    return longest_arm(tools_[i]->motion, time, points);
  }

private:
  [[nodiscard]] PlacedBody placed(std::size_t i, double time) const {
    return {*bodies_[i], pose(i, time)};
  }
  [[nodiscard]] Pose pose(std::size_t i, double time) const {
    return taken_ ? (*taken_)[i] : tools_[i]->motion.pose(time);
  }

  /// Places of tool i that lie in the other one, if that has an inside.
  void add_places(std::size_t i, double time, geometry::Cut& deepest) const {
    const contact::Tool& other = *tools_[1 - i];
    if (!solid_[1 - i])
      return;
    const Pose here = pose(i, time), there = pose(1 - i, time);
    const std::vector<Vec3> all = places(bodies_[i]->drawing());
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < all.size(); k += 1 + all.size() / most_places)
      points.push_back(there.to_tool(here.to_space(all[k])));
    std::vector<geometry::Projection> feet(points.size());
    other.surface->project(points, size_, feet);
    for (std::size_t k = 0; k < feet.size(); ++k)
      if (-feet[k].gap > deepest.depth)
        deepest = {-feet[k].gap, there.to_space(points[k])};
  }

  std::array<const contact::Tool*, 2> tools_;
  std::array<const FacetBody*, 2> bodies_;
  std::array<bool, 2> solid_; ///< which have an inside
  double size_;
  std::optional<std::array<Pose, 2>> taken_ = std::nullopt;
};

/// Follows one pair.
class Follower {
public:
  Follower(const Pair& pair, double size, double tolerated)
      : pair_(pair), size_(size), tolerated_(tolerated) {}

  [[nodiscard]] bool overlapping(double time) const {
    return pair_.overlap(time).depth > tolerated_;
  }

  /// The time of the meeting and the overlap just after it, if there is one in the span.
  [[nodiscard]] std::optional<std::pair<double, geometry::Cut>>
  meeting(const Span& span, const RelativeWay& way) const {
    const double shortest = std::max(way.total() / most_steps, closed_gap * size_);
    double open = span.from; // the last time at which the clearance was open
    for (double time = span.from; time < span.to && way.total() > 0.0;) {
      const double clearance = pair_.clearance(time);
      if (clearance > closed_gap * size_)
        open = time;
      const double next = way.later(time, std::max(clearance, shortest));
      if (overlapping(next)) {
        const double seen = first_overlap(time, next);
        const double closed = closing(open, seen, way);
        // What has been closed for longer glided, and the overlap is another thing.
        const bool at_once = way.between(closed, seen) <= most_delay * tolerated_;
        return std::pair(at_once ? closed : seen, pair_.overlap(seen));
      }
      time = next;
    }
    return std::nullopt;
  }

private:
  /// Between a time without overlap and one with it.
  [[nodiscard]] double first_overlap(double clear, double seen) const {
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (clear + seen);
      (overlapping(middle) ? seen : clear) = middle;
    }
    return seen;
  }

  /// When the clearance closes: not before the way is that long. (G.15)
  [[nodiscard]] double closing(double time, double latest, const RelativeWay& way) const {
    for (int k = 0; k < most_closing_steps && time < latest; ++k) {
      const double clearance = pair_.clearance(time);
      if (clearance <= closed_gap * size_)
        break;
      time = std::min(way.later(time, clearance), latest);
    }
    return time;
  }

  const Pair& pair_;
  double size_;
  double tolerated_;
};

/// What all pairs have in common; tools are drawn when they are first asked for.
class Shop {
public:
  explicit Shop(const Scene& scene)
      : scene_(scene), window_(window_of(scene)),
        tolerated_(tolerated_share * box_of(scene.part.mesh.points).size()),
        drawn_(scene.tools.size()) {}

  [[nodiscard]] std::optional<ToolMeeting> meeting(std::size_t i, std::size_t j) {
    if (!within_reach(i, j))
      return std::nullopt;
    const contact::Tool &a = scene_.tools[i], &b = scene_.tools[j];
    const Drawn &body_a = drawn(i), &body_b = drawn(j);
    const Pair pair(a, b, body_a.body, body_b.body, {body_a.solid, body_b.solid}, window_.size());
    const Follower follower(pair, window_.size(), tolerated_);
    for (const Span& span : common_spans(scene_, i, j)) {
      if (moved_by_load(scene_, i, span.from) || moved_by_load(scene_, j, span.from))
        break;
      if (follower.overlapping(span.from)) {
        if (!bounded(a) || !bounded(b))
          continue;
        const geometry::Cut deepest = pair.overlap(span.from);
        return ToolMeeting{i, j, span.from, true, deepest.depth, deepest.place};
      }
      if (driven(a) || driven(b))
        continue;
      const std::array arms{pair.arm(0, span.from), pair.arm(1, span.from)};
      const RelativeWay way(scene_, a, b, span, arms);
      if (const auto met = follower.meeting(span, way))
        return ToolMeeting{i, j, met->first, false, 0.0, met->second.place};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ToolMeeting>
  overlap(std::size_t i, std::size_t j, double time, std::span<const Pose> poses) {
    const contact::Tool &a = scene_.tools[i], &b = scene_.tools[j];
    const std::vector<Span> spans = common_spans(scene_, i, j);
    const auto now = std::find_if(spans.begin(), spans.end(), [&](const Span& span) {
      return span.from <= time && time <= span.to;
    });
    if (now == spans.end() || !(driven(a) || driven(b)))
      return std::nullopt;
    const Drawn &body_a = drawn(i), &body_b = drawn(j);
    Pair pair(a, b, body_a.body, body_b.body, {body_a.solid, body_b.solid}, window_.size());
    if (pair.overlap(0.0).depth > tolerated_)
      return std::nullopt; // meant, or told before anything was solved
    pair.place(poses[i], poses[j]);
    const geometry::Cut deepest = pair.overlap(time);
    if (!(deepest.depth > tolerated_))
      return std::nullopt;
    return ToolMeeting{i, j, time, false, deepest.depth, deepest.place};
  }

private:
  struct Drawn {
    FacetBody body;
    bool solid; ///< it has an inside
  };

  /// Whether two tools' boxes are no farther apart than the way they make: most are, and large
  /// surfaces need no trees then.
  [[nodiscard]] bool within_reach(std::size_t i, std::size_t j) const {
    const contact::Tool &a = scene_.tools[i], &b = scene_.tools[j];
    if (!bounded(a) || !bounded(b))
      return true;
    const std::array places{placed_corners(a), placed_corners(b)};
    const std::array arms{longest_arm(a.motion, 0.0, places[0]),
                          longest_arm(b.motion, 0.0, places[1])};
    const RelativeWay way(scene_, a, b, {0.0, scene_.stages.back().end}, arms);
    return box_of(places[0]).overlaps(box_of(places[1]), way.total() + tolerated_);
  }

  static std::vector<Vec3> placed_corners(const contact::Tool& tool) {
    std::vector<Vec3> list = corners(tool.surface->bounds());
    for (Vec3& corner : list)
      corner = tool.motion.pose(0.0).to_space(corner);
    return list;
  }

  [[nodiscard]] const Drawn& drawn(std::size_t i) {
    if (!drawn_[i]) {
      const contact::Tool& tool = scene_.tools[i];
      FacetBody body = body_of(scene_, tool, window_);
      const bool solid = !bounded(tool) || geometry::closed(body.drawing());
      drawn_[i].emplace(Drawn{std::move(body), solid});
    }
    return *drawn_[i];
  }

  const Scene& scene_;
  Box window_;
  double tolerated_; ///< overlap [mm]
  std::vector<std::optional<Drawn>> drawn_;
};

} // namespace

std::vector<ToolMeeting> tool_meetings(const Scene& scene) {
  Shop shop(scene);
  std::vector<ToolMeeting> meetings;
  for (std::size_t i = 0; i < scene.tools.size(); ++i)
    for (std::size_t j = i + 1; j < scene.tools.size(); ++j)
      if (const auto meeting = shop.meeting(i, j))
        meetings.push_back(*meeting);
  return meetings;
}

std::vector<ToolMeeting>
overlaps_by_loads(const Scene& scene, double time, std::span<const Pose> poses) {
  Shop shop(scene);
  std::vector<ToolMeeting> overlaps;
  for (std::size_t i = 0; i < scene.tools.size(); ++i)
    for (std::size_t j = i + 1; j < scene.tools.size(); ++j)
      if (const auto overlap = shop.overlap(i, j, time, poses))
        overlaps.push_back(*overlap);
  return overlaps;
}

} // namespace billet::process
