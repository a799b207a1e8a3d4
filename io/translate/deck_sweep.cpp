#include "io/translate/deck_sweep.h"

#include "geometry/base/angle.h"
#include "geometry/base/limits.h"
#include "io/translate/deck_profile.h"
#include "io/translate/tool_facets.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace billet::io {

namespace {

/// A line or an arc with its begin.
struct Stretch {
  Vec3 from, to;
  double radius; ///< 0: a line
  Vec3 centre;
  double angle; ///< of an arc, positive: turning left, less than half a turn [rad]

  [[nodiscard]] bool is_line() const { return radius == 0.0; }
  [[nodiscard]] double length() const {
    return is_line() ? (to - from).norm() : std::abs(angle * radius);
  }
  /// Where it goes at a point of it.
  [[nodiscard]] Vec3 direction(const Vec3& at) const {
    const Vec3 d = is_line() ? Vec3(to - from)
                             : Vec3(std::copysign(1.0, angle) * Vec3::UnitZ().cross(at - centre));
    return d.normalized();
  }
  [[nodiscard]] Vec3 point(double share) const {
    if (is_line())
      return from + share * (to - from);
    const Vec3 a = from - centre;
    return centre + Eigen::AngleAxisd(share * angle, Vec3::UnitZ()) * a;
  }
};

std::vector<Stretch> stretches_of(const DeckProfile& profile) {
  std::vector<Stretch> stretches;
  Vec3 last = profile.start;
  for (const ProfileStep& piece : profile.pieces) {
    Stretch one{last, piece.to, piece.radius, piece.centre, 0.0};
    if (!one.is_line()) {
      const Vec3 a = last - piece.centre, b = piece.to - piece.centre;
      one.angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    if (one.length() > 0.0)
      stretches.push_back(one);
    last = piece.to;
  }
  return stretches;
}

/// Whether the arcs make a circle.
bool is_circle(const std::vector<Stretch>& stretches) {
  constexpr double same = 1e-6; // of the radius, of a turn: the rounding of a deck
  const Stretch& first = stretches.front();
  double angle = 0.0;
  for (const Stretch& one : stretches) {
    if (one.is_line() || std::abs(one.radius - first.radius) > same * std::abs(first.radius) ||
        (one.centre - first.centre).norm() > same * std::abs(first.radius))
      return false;
    angle += std::abs(one.angle);
  }
  return std::abs(angle - 2.0 * std::numbers::pi) < 2.0 * std::numbers::pi * same;
}

/// How arcs are divided.
struct Division {
  double step = 0.0;          ///< largest angle of a facet [rad]
  double feature_angle = 0.0; ///< [degrees]; 0: facets stay flat
};

/// The smallest angle of a corner of the profile. What a deck rounds off where an arc meets its
/// tangent is none. [rad]
double least_corner(const std::vector<Stretch>& stretches) {
  constexpr double straight = 1e-6, tangent = 0.5 * degree;
  double least = infinity;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch &one = stretches[i], &next = stretches[(i + 1) % stretches.size()];
    if (i + 1 == stretches.size() && (one.to - next.from).norm() > 1e-9 * one.length())
      continue; // an open end
    const double turn = angle_between(one.direction(one.to), next.direction(next.from));
    if (turn > (one.is_line() && next.is_line() ? straight : tangent))
      least = std::min(least, turn);
  }
  return least;
}

/// Facets of an arc next to a line are a tenth as wide as the line: then it is a plane that the arc
/// adjoins, and stays one when facets are curved (G.16).
std::size_t n_facets(const std::vector<Stretch>& stretches,
                     std::size_t i,
                     const Division& division,
                     double depth) {
  constexpr double narrower = 10.0, rounding = 1e-9;
  const Stretch& arc = stretches[i];
  if (arc.is_line())
    return 1;
  double n = std::abs(arc.angle) / division.step - rounding;
  if (division.feature_angle > 0.0)
    for (const std::size_t next : {i + stretches.size() - 1, i + 1})
      if (const Stretch& line = stretches[next % stretches.size()]; line.is_line())
        n = std::max(n, narrower * arc.length() / std::min(line.length(), depth));
  return static_cast<std::size_t>(std::max(1.0, std::ceil(n)));
}

/// The facets of arcs turn by less than half of what is taken as a corner.
Division division_of(const std::vector<Stretch>& stretches, double depth) {
  constexpr double coarse = 2.0 * degree, fine = 0.5 * degree, least = 0.1 * degree;
  constexpr std::size_t most = 500; // facets of an arc
  const double step = std::min(coarse, 0.25 * least_corner(stretches));
  const Division division{step, 2.0 * step / degree}, flat{fine, 0.0};
  if (step < least)
    return flat;
  for (std::size_t i = 0; i < stretches.size(); ++i)
    if (n_facets(stretches, i, division, depth) > most)
      return flat; // next to a line that is very short
  return division;
}

/// How far an arc is off its facets.
double chord_error(const Stretch& arc, std::size_t n) {
  return std::abs(arc.radius) * (1.0 - std::cos(0.5 * arc.angle / static_cast<double>(n)));
}

/// The frame in which a profile is given.
struct SweepFrame {
  Vec3 origin, x, y, z;

  [[nodiscard]] Vec3 place(const Vec3& p) const { return origin + p.x() * x + p.y() * y; }
};

SweepFrame frame_of(const DeckSurface& given) {
  SweepFrame frame;
  frame.origin = frame_point(given, 0, Vec3::Zero());
  frame.x = (frame_point(given, 1, frame.origin + Vec3::UnitX()) - frame.origin).normalized();
  frame.z = -(frame_point(given, 2, frame.origin - Vec3::UnitZ()) - frame.origin).normalized();
  frame.y = frame.z.cross(frame.x);
  return frame;
}

/// Free on the left of the line.
std::string plane_text(const Stretch& line, const SweepFrame& frame) {
  const Vec3 along = line.to - line.from;
  const Vec3 normal = -along.y() * frame.x + along.x() * frame.y;
  return fmt::format("{{ plane = {{ point = {}, normal = {} }} }}",
                     vector_text(frame.place(line.from), true),
                     vector_text(normal.normalized(), true));
}

/// Free on the left: of an arc that turns left inside.
std::string cylinder_text(const Stretch& arc, const SweepFrame& frame) {
  return fmt::format("{{ cylinder = {{ point = {}, axis = {}, radius = {:.10g}, inside = {} }} }}",
                     vector_text(frame.place(arc.centre), true), vector_text(frame.z, true),
                     std::abs(arc.radius), arc.radius > 0.0);
}

/// From the begin of the sweep to its end, along z from the origin.
struct Reach {
  double low = 0.0, high = 0.0;

  [[nodiscard]] double depth() const { return high - low; }
};

Reach reach_over(const DeckSurroundings& around, const SweepFrame& frame) {
  Reach reach;
  for (const Vec3& p : around.points) {
    reach.low = std::min(reach.low, (p - frame.origin).dot(frame.z));
    reach.high = std::max(reach.high, (p - frame.origin).dot(frame.z));
  }
  const double margin = std::max(reach.high - reach.low, 1e-12);
  return {reach.low - margin, reach.high + margin};
}

/// What became of the arcs, for the log.
std::string arcs_remark(const Division& division, double error, const std::string& unit) {
  const double step = division.step / degree;
  if (division.feature_angle == 0.0)
    return fmt::format("its arcs are drawn as planes of {:.2g} degrees, {:.2g} {} off at most: "
                       "it has blunt edges or short lines, which stay exact",
                       step, error, unit);
  const double curved = error * division.step * division.step / 16.0; // (G.23)
  return fmt::format("its arcs are drawn as facets of {:.2g} degrees and less and curved (smooth = "
                     "true): about {:.1g} {} off, by the facets {:.2g}; lines are exact",
                     step, curved, unit, error);
}

/// What a profile becomes between the ends of the sweep.
struct SweptFacets {
  std::vector<Facet> facets;
  double error = 0.0; ///< of the arcs; 0: there are none
};

/// The normals of the facets, (to - from) x (b - a), point to the free side.
SweptFacets swept_facets(const std::vector<Stretch>& stretches,
                         const Division& division,
                         const SweepFrame& frame,
                         const Reach& reach) {
  const Vec3 from = reach.low * frame.z, to = reach.high * frame.z;
  SweptFacets swept;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& one = stretches[i];
    const std::size_t n = n_facets(stretches, i, division, reach.depth());
    const auto at = [&](std::size_t k) -> Vec3 {
      return frame.place(k == n ? one.to
                                : one.point(static_cast<double>(k) / static_cast<double>(n)));
    };
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 a = at(k), b = at(k + 1);
      swept.facets.push_back({a + from, b + to, b + from});
      swept.facets.push_back({a + from, a + to, b + to});
    }
    if (!one.is_line())
      swept.error = std::max(swept.error, chord_error(one, n));
  }
  return swept;
}

} // namespace

DeckToolSurface
swept_surface(const DeckSurface& given, const std::string& name, const DeckSurroundings& around) {
  DeckToolSurface surface;
  const SweepFrame frame = frame_of(given);
  const std::vector<Stretch> stretches = stretches_of(profile_of(given, surface.remarks));
  if (stretches.empty()) {
    surface.remarks.push_back("its profile has no length");
    return surface;
  }
  if (stretches.size() == 1 && stretches.front().is_line()) {
    surface.text = plane_text(stretches.front(), frame);
    return surface;
  }
  if (is_circle(stretches)) {
    surface.text = cylinder_text(stretches.front(), frame);
    return surface;
  }
  const Reach reach = reach_over(around, frame);
  const Division division = division_of(stretches, reach.depth());
  const SweptFacets swept = swept_facets(stretches, division, frame, reach);
  const std::string file = name + ".stl";
  surface.files.push_back({file, stl_text(name, swept.facets)});
  surface.text = stl_surface(file, around.unit, swept.error > 0.0 ? division.feature_angle : 0.0);
  if (swept.error > 0.0)
    surface.remarks.push_back(arcs_remark(division, swept.error, around.unit));
  return surface;
}

} // namespace billet::io
