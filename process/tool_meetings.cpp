#include "process/tool_meetings.h"

#include "geometry/facet_body.h"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr int most_steps = 400;             // that a pair near to each other takes along its motion
constexpr std::size_t most_vertices = 4000; // asked for their depth in the other tool
constexpr double closed_gap = 1e-9;         // share of the size at which a clearance is none
constexpr int most_closing_steps = 60;
constexpr int halvings = 25;
constexpr double most_delay = 20.0; // tolerated overlaps between closing and its being seen

Box box_of(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points)
    box.add(p);
  return box;
}

std::vector<Vec3> corners(const Box& box) {
  std::vector<Vec3> list;
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
  Box window = box_of(scene.mesh.points);
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
  const bool planar = scene.analysis != mechanics::Analysis::solid;
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

  [[nodiscard]] double clearance(double time) const {
    return geometry::clearance(placed(0, time), placed(1, time));
  }

  /// The deepest overlap: of facets that cut, and of corners of one in the solid of the other.
  [[nodiscard]] geometry::Cut overlap(double time) const {
    geometry::Cut deepest =
        geometry::deepest_cut(placed(0, time), placed(1, time)).value_or(geometry::Cut{});
    for (const std::size_t i : {0u, 1u})
      add_corners(i, time, deepest);
    return deepest;
  }

  /// Longest lever of a tool's drawing about its axis, the other tool within reach included [mm].
  [[nodiscard]] double arm(std::size_t i, double time) const {
    const geometry::Motion& motion = tools_[i]->motion;
    const Pose pose = motion.pose(time);
    const Vec3 point = motion.axis_point() + motion.offset + motion.translation(time);
    double longest = 0.0;
    for (const Vec3& p : bodies_[i]->drawing().points) {
      const Vec3 v = pose.to_space(p) - point;
      longest = std::max(longest, (v - v.dot(motion.axis()) * motion.axis()).norm());
    }
    return longest;
  }

private:
  [[nodiscard]] PlacedBody placed(std::size_t i, double time) const {
    return {*bodies_[i], tools_[i]->motion.pose(time)};
  }

  /// Corners of tool i that lie in the other one, if that has an inside.
  void add_corners(std::size_t i, double time, geometry::Cut& deepest) const {
    const contact::Tool& other = *tools_[1 - i];
    if (!solid_[1 - i])
      return;
    const Pose here = tools_[i]->motion.pose(time), there = other.motion.pose(time);
    const std::vector<Vec3>& all = bodies_[i]->drawing().points;
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < all.size(); k += 1 + all.size() / most_vertices)
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

struct Setting {
  const Scene& scene;
  std::vector<FacetBody> bodies;
  std::vector<char> solid; ///< which have an inside
  double size;             ///< of everything [mm]
  double tolerated;        ///< overlap [mm]
};

std::optional<ToolMeeting> meeting_of(const Setting& setting, std::size_t i, std::size_t j) {
  const contact::Tool &a = setting.scene.tools[i], &b = setting.scene.tools[j];
  const Pair pair(a, b, setting.bodies[i], setting.bodies[j],
                  {setting.solid[i] != 0, setting.solid[j] != 0}, setting.size);
  const Follower follower(pair, setting.size, setting.tolerated);
  for (const Span& span : common_spans(setting.scene, i, j)) {
    if (follower.overlapping(span.from)) {
      if (!bounded(a) || !bounded(b))
        continue;
      const geometry::Cut deepest = pair.overlap(span.from);
      return ToolMeeting{i, j, span.from, true, deepest.depth, deepest.place};
    }
    if (driven(a) || driven(b))
      continue;
    const std::array arms{pair.arm(0, span.from), pair.arm(1, span.from)};
    const RelativeWay way(setting.scene, a, b, span, arms);
    if (const auto met = follower.meeting(span, way))
      return ToolMeeting{i, j, met->first, false, 0.0, met->second.place};
  }
  return std::nullopt;
}

} // namespace

std::vector<ToolMeeting> tool_meetings(const Scene& scene) {
  std::vector<ToolMeeting> meetings;
  if (scene.tools.size() < 2)
    return meetings;
  const Box window = window_of(scene);
  Setting setting{scene, {}, {}, window.size(), tolerated_share * box_of(scene.mesh.points).size()};
  for (const contact::Tool& tool : scene.tools) {
    setting.bodies.push_back(body_of(scene, tool, window));
    const bool solid = !bounded(tool) || geometry::closed(setting.bodies.back().drawing());
    setting.solid.push_back(solid ? 1 : 0);
  }
  for (std::size_t i = 0; i < setting.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < setting.bodies.size(); ++j)
      if (const auto meeting = meeting_of(setting, i, j))
        meetings.push_back(*meeting);
  return meetings;
}

} // namespace billet::process
