#include "geometry/collision/passage.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace billet::geometry {

namespace {

constexpr double coarse = 1.0 / 8.0; // step near a surface, share of the way
constexpr double fine = 1e-4;        // and where sides seem to have changed
constexpr double other_side = -0.5;  // normals more than 120 degrees apart are those of two sides

struct Sample {
  double s;       // share of the way
  Vec3 position;  // tool frame
  Vec3 normal;    // tool frame
  Vec3 direction; // the same in space
  double gap;     // +inf: nothing near, or behind the rim of an open surface
};

class Walk {
public:
  Walk(const RigidSurface& surface, const Encounter& encounter, double length, double slack)
      : surface_(surface), encounter_(encounter), length_(length), slack_(slack) {}

  [[nodiscard]] std::optional<Vec3> operator()() {
    Sample entry = at(0.0);
    if (!(std::abs(entry.gap) <= length_) || (entry.gap < 0.0 && length_ <= slack_))
      return std::nullopt;
    bool entered = entry.gap < 0.0; // `entry` is the last place outside, or the start
    for (Sample now = entry; now.s < 1.0;) {
      const Sample next = at(std::min(1.0, now.s + step(now, coarse)));
      entered = entered || next.gap < 0.0;
      if (turned(entry, next) && deeper(entry, next) && (entered || cuts(now, next)))
        return encounter_.motion.pose_at(shift(next.s), angle(next.s)).to_space(next.position);
      if (next.gap >= 0.0) {
        entry = next;
        entered = false;
      }
      now = next;
    }
    return std::nullopt;
  }

private:
  [[nodiscard]] Vec3 shift(double s) const {
    return encounter_.tool_old.shift + s * (encounter_.tool_new.shift - encounter_.tool_old.shift);
  }
  [[nodiscard]] double angle(double s) const {
    return encounter_.tool_old.angle + s * (encounter_.tool_new.angle - encounter_.tool_old.angle);
  }

  [[nodiscard]] Sample at(double s) {
    const Pose pose = encounter_.motion.pose_at(shift(s), angle(s));
    const Vec3 x = encounter_.point_old + s * (encounter_.point_new - encounter_.point_old);
    const Vec3 position = pose.to_tool(x);
    Projection p;
    p.patch = patch_;
    // Whoever starts within one length of the surface ends within two.
    surface_.project({&position, 1}, 2.0 * length_, {&p, 1});
    patch_ = p.patch;
    return {s, position, p.normal, pose.rotation * p.normal, p.gap};
  }

  /// Clear parts are left in one step: the gap cannot close sooner. (G.15)
  [[nodiscard]] double step(const Sample& now, double shortest) const {
    return std::isfinite(now.gap) ? std::max(now.gap / length_, shortest) : shortest;
  }

  /// A side is another one both for the tool and in space: the point neither rides on a turning
  /// tool nor sees a round one spin.
  [[nodiscard]] static bool turned(const Sample& entry, const Sample& now) {
    return std::isfinite(entry.gap) && std::isfinite(now.gap) &&
           entry.normal.dot(now.normal) < other_side &&
           entry.direction.dot(now.direction) < other_side;
  }

  [[nodiscard]] bool deeper(const Sample& entry, const Sample& now) const {
    return entry.gap >= 0.0 || (entry.position - now.position).dot(entry.normal) > slack_;
  }

  /// Whether the way between two points outside leads through the tool and not round an edge.
  [[nodiscard]] bool cuts(const Sample& from, const Sample& to) {
    for (Sample now = from; now.s < to.s;) {
      const Sample next = at(std::min(to.s, now.s + step(now, fine * (to.s - from.s))));
      const double apart = (next.position - now.position).norm();
      if (next.gap < 0.0 || (turned(now, next) && now.gap + next.gap < apart))
        return true;
      now = next;
    }
    return false;
  }

  const RigidSurface& surface_;
  const Encounter& encounter_;
  double length_;
  double slack_;
  std::int32_t patch_ = -1;
};

} // namespace

double way(const Encounter& encounter) {
  const Motion& motion = encounter.motion;
  const Vec3 moved = encounter.point_new - encounter.point_old -
                     (encounter.tool_new.shift - encounter.tool_old.shift);
  const Vec3 turned = (encounter.tool_new.angle - encounter.tool_old.angle) * motion.axis();
  const auto speed = [&](const Vec3& x, const Whereabouts& tool) {
    return (moved - turned.cross(x - motion.axis_point() - motion.offset - tool.shift)).norm();
  };
  // The arm changes linearly on the way, and so does the velocity: it is largest at an end.
  return std::max(speed(encounter.point_old, encounter.tool_old),
                  speed(encounter.point_new, encounter.tool_new));
}

std::optional<Vec3> passage(const RigidSurface& surface, const Encounter& encounter, double slack) {
  const double length = way(encounter);
  if (!(length > 0.0))
    return std::nullopt;
  return Walk(surface, encounter, length, slack)();
}

} // namespace billet::geometry
