#include "process/remeshing/part_boundary.h"

#include "mechanics/mesh/domain_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <variant>

namespace billet::process {

namespace {

using geometry::BoundaryPlace;
using geometry::SideLoop;
using mechanics::Face;

/// Sides that a zone of contact should have at least.
constexpr double sides_of_zone = 6.0;

/// With fewer, the pressure in a zone is not found.
constexpr std::size_t least_sides_of_zone = 3;

/// Walks faces of the boundary of a scene and puts them into chains.
class Chains {
public:
  Chains(const Part& part, std::span<const double> x, std::span<const int> touching)
      : part_(part), x_(x), attachments_(part, touching),
        faces_(mechanics::boundary_faces(part.mesh)) {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      by_start_[faces_[f].nodes[0]] = f;
  }

  [[nodiscard]] PartBoundary boundary(const std::vector<char>& kept) {
    PartBoundary result;
    std::map<Attachment, std::int32_t> numbers;
    while (!by_start_.empty()) {
      SideLoop loop;
      std::vector<Index> corners;
      for (auto next = by_start_.begin(); next != by_start_.end();) {
        const Face& face = faces_[next->second];
        by_start_.erase(next);
        const Attachment attached = attachments_.of(face);
        const auto [part, is_new] =
            numbers.try_emplace(attached, static_cast<std::int32_t>(numbers.size()));
        if (is_new)
          result.attachments.push_back(attached);
        result.sides[{face.nodes[0], face.nodes[1]}] = {
            static_cast<std::int32_t>(result.loops.size()),
            static_cast<std::int32_t>(corners.size())};
        corners.push_back(face.nodes[0]);
        loop.corners.push_back(place(face.nodes[0]));
        loop.middles.push_back(middle(face));
        loop.part.push_back(part->second);
        loop.hold.push_back(static_cast<char>(held(face, attached)));
        next = by_start_.find(face.nodes[1]);
      }
      for (const Index node : corners)
        loop.keep.push_back(static_cast<char>(kept[idx(node)] != 0));
      keep_lone_corners(corners, result.attachments, loop);
      result.fixed.push_back(fixed(corners));
      result.loops.push_back(std::move(loop));
      result.corners.push_back(std::move(corners));
    }
    return result;
  }

private:
  [[nodiscard]] Vec2 place(Index node) const { return {x_[idx(2 * node)], x_[idx(2 * node + 1)]}; }

  [[nodiscard]] Vec2 middle(const Face& face) const {
    return face.nodes.size() > 2 ? place(face.nodes[2])
                                 : Vec2(0.5 * (place(face.nodes[0]) + place(face.nodes[1])));
  }

  /// Nodes of tools, supports and the axis stay on their lines.
  [[nodiscard]] bool held(const Face& face, const Attachment& attached) const {
    return attached.tool >= 0 ||
           std::any_of(attached.supports.begin(), attached.supports.end(),
                       [](char flag) { return flag != 0; }) ||
           (part_.analysis == mechanics::Analysis::axisymmetric &&
            std::all_of(face.nodes.begin(), face.nodes.end(),
                        [&](Index a) { return x_[idx(2 * a)] == 0.0; }));
  }

  [[nodiscard]] std::vector<unsigned char> fixed(const std::vector<Index>& corners) const {
    std::vector<unsigned char> result;
    for (const Index node : corners) {
      unsigned mask = 0;
      for (std::size_t s = 0; s < part_.supports.size(); ++s)
        if (attachments_.nodes().supports[s][idx(node)] != 0)
          mask |= 1U << static_cast<unsigned>(part_.supports[s].component);
      result.push_back(static_cast<unsigned char>(mask));
    }
    return result;
  }

  /// Keeps nodes that carry what neither of their two edges does.
  void keep_lone_corners(const std::vector<Index>& corners,
                         const std::vector<Attachment>& attachments,
                         SideLoop& loop) const {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Attachment& after = attachments[idx(loop.part[i])];
      const Attachment& before = attachments[idx(loop.part[(i + n - 1) % n])];
      const auto lone = [&](const std::vector<std::vector<char>>& flags, const std::vector<char>& a,
                            const std::vector<char>& b) {
        for (std::size_t s = 0; s < flags.size(); ++s)
          if (flags[s][idx(corners[i])] != 0 && a[s] == 0 && b[s] == 0)
            return true;
        return false;
      };
      if (lone(attachments_.nodes().supports, before.supports, after.supports) ||
          lone(attachments_.nodes().sets, before.sets, after.sets))
        loop.keep[i] = 1;
    }
  }

  const Part& part_;
  std::span<const double> x_;
  Attachments attachments_;
  std::vector<Face> faces_;
  std::map<Index, std::size_t> by_start_;
};

/// The corner of the old boundary in a place; -1: it lies within an edge.
Index corner_at(const PartBoundary& boundary, const BoundaryPlace& place) {
  const std::vector<Index>& corners = boundary.corners[idx(place.loop)];
  if (place.xi == 0.0)
    return corners[idx(place.side)];
  if (place.xi == 1.0)
    return corners[(idx(place.side) + 1) % corners.size()];
  return -1;
}

/// Lengths of the edges of a loop, summed up; one entry more than edges.
std::vector<double> side_ends(const SideLoop& loop) {
  std::vector<double> ends{0.0};
  const std::size_t n = loop.corners.size();
  for (std::size_t i = 0; i < n; ++i)
    ends.push_back(ends.back() + (loop.middles[i] - loop.corners[i]).norm() +
                   (loop.corners[(i + 1) % n] - loop.middles[i]).norm());
  return ends;
}

/// Way of a point of an edge that is given by the ways of its ends and its middle.
double way_within(double start, double middle, double end, double coordinate) {
  const double even = 0.5 * (start + end) - middle;
  return middle + 0.5 * (end - start) * coordinate + even * coordinate * coordinate;
}

} // namespace

ContactStops::ContactStops(const PartBoundary& boundary,
                           std::span<const Face> faces,
                           std::span<const double> coordinates)
    : stops_(boundary.loops.size()) {
  for (const SideLoop& loop : boundary.loops) {
    ends_.push_back(side_ends(loop));
    parts_.push_back(loop.part);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto found = boundary.sides.find({faces[f].nodes[0], faces[f].nodes[1]});
    if (found == boundary.sides.end())
      continue; // in a fold that was cut off
    const SideNumber at = found->second;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      stops_[idx(at.loop)].push_back({way({at.loop, at.side, 0.5 * (1.0 + coordinates[i])}),
                                      f * coordinates.size() + i,
                                      parts_[idx(at.loop)][idx(at.side)]});
  }
  for (std::vector<Stop>& stops : stops_)
    std::sort(stops.begin(), stops.end(),
              [](const Stop& a, const Stop& b) { return a.way < b.way; });
}

double ContactStops::way(const BoundaryPlace& at) const {
  const std::vector<double>& ends = ends_[idx(at.loop)];
  return ends[idx(at.side)] + at.xi * (ends[idx(at.side) + 1] - ends[idx(at.side)]);
}

double ContactStops::round(std::int32_t loop) const { return ends_[idx(loop)].back(); }

std::int32_t ContactStops::part_at(const BoundaryPlace& at) const {
  return parts_[idx(at.loop)][idx(at.side)];
}

contact::PointSource ContactStops::between(std::int32_t loop, double way, std::int32_t part) const {
  const std::vector<Stop>& stops = stops_[idx(loop)];
  if (stops.empty()) // a loop that had no contact face has none now
    return contact::PointSource::between(0, 0, 0.0);
  const double total = round(loop);
  const double at = std::fmod(way + total, total);
  const auto after = std::upper_bound(stops.begin(), stops.end(), at,
                                      [](double w, const Stop& stop) { return w < stop.way; });
  const Stop& next = after == stops.end() ? stops.front() : *after;
  const Stop& last = after == stops.begin() ? stops.back() : *std::prev(after);
  if (last.part == part && next.part != part)
    return contact::PointSource::between(last.point, last.point, 0.0);
  if (next.part == part && last.part != part)
    return contact::PointSource::between(next.point, next.point, 0.0);
  const double span = std::fmod(next.way - last.way + total, total);
  const double gone = std::fmod(at - last.way + total, total);
  return contact::PointSource::between(last.point, next.point,
                                       span > 0.0 ? std::clamp(gone / span, 0.0, 1.0) : 0.0);
}

PartBoundary part_boundary(const Part& part,
                           std::span<const double> x,
                           std::span<const int> touching,
                           std::span<const std::string> keep) {
  std::vector<char> kept(part.mesh.points.size(), 0);
  for (const std::string& name : keep)
    for (const Index node : part.mesh.node_sets.at(name))
      kept[idx(node)] = 1;
  return Chains(part, x, touching).boundary(kept);
}

namespace {

/// Cuts a fold off a loop.
void cut_off(PartBoundary& boundary, std::size_t l, const geometry::ClosedFold& fold, double rest) {
  SideLoop& loop = boundary.loops[l];
  geometry::WeldedLoop welded = geometry::without_fold(loop, fold, rest);
  std::vector<std::int32_t> now(loop.part.size(), -1); // new number of each edge
  std::vector<Index> corners;
  std::vector<unsigned char> fixed;
  for (std::size_t i = 0; i < welded.sides.size(); ++i) {
    now[idx(welded.sides[i])] = static_cast<std::int32_t>(i);
    const std::int32_t old = welded.corners[i];
    corners.push_back(old < 0 ? -1 : boundary.corners[l][idx(old)]);
    fixed.push_back(old < 0 ? 0 : boundary.fixed[l][idx(old)]);
  }
  for (auto side = boundary.sides.begin(); side != boundary.sides.end();) {
    SideNumber& number = side->second;
    if (number.loop == static_cast<std::int32_t>(l))
      number.side = now[idx(number.side)];
    side = number.side < 0 ? boundary.sides.erase(side) : std::next(side);
  }
  loop = std::move(welded.loop);
  boundary.corners[l] = std::move(corners);
  boundary.fixed[l] = std::move(fixed);
}

/// Sides that no weld may take.
std::vector<char> supported_sides(const PartBoundary& boundary, const SideLoop& loop) {
  std::vector<char> stays(loop.part.size());
  std::transform(loop.part.begin(), loop.part.end(), stays.begin(), [&](std::int32_t part) {
    const std::vector<char>& supports = boundary.attachments[idx(part)].supports;
    return static_cast<char>(
        std::any_of(supports.begin(), supports.end(), [](char flag) { return flag != 0; }));
  });
  return stays;
}

} // namespace

std::vector<geometry::ClosedFold>
weld_folds(PartBoundary& boundary, double near, double rest, double deepest) {
  std::vector<geometry::ClosedFold> folds;
  std::vector<Vec2> roots;
  for (std::size_t l = 0; l < boundary.loops.size(); ++l)
    while (auto fold = geometry::closed_fold(boundary.loops[l],
                                             supported_sides(boundary, boundary.loops[l]), near,
                                             deepest, roots)) {
      if (std::isfinite(deepest))
        roots.push_back(fold->at);
      fold->from.loop = fold->to.loop = static_cast<std::int32_t>(l);
      folds.push_back(*fold);
      cut_off(boundary, l, *fold, rest);
    }
  return folds;
}

unsigned char fixed_components(const Part& part,
                               const PartBoundary& boundary,
                               std::int32_t section,
                               const BoundaryPlace& place) {
  const std::size_t loop = idx(place.loop), side = idx(place.side);
  unsigned mask = 0;
  const Attachment& attached = boundary.attachments[idx(section)];
  for (std::size_t s = 0; s < part.supports.size(); ++s)
    if (attached.supports[s] != 0)
      mask |= 1U << static_cast<unsigned>(part.supports[s].component);
  const std::vector<unsigned char>& fixed = boundary.fixed[loop];
  if (place.xi == 0.0)
    mask |= fixed[side];
  if (place.xi == 1.0)
    mask |= fixed[(side + 1) % fixed.size()];
  return static_cast<unsigned char>(mask);
}

namespace {

/// Whether the boundary turns only a little at a corner of a loop.
bool goes_straight_on(const SideLoop& loop, std::size_t corner) {
  constexpr double straight = 0.866; // cos 30 degrees
  const std::size_t n = loop.corners.size();
  const Vec2& at = loop.corners[corner];
  const Vec2 before = (at - loop.corners[(corner + n - 1) % n]).normalized();
  const Vec2 after = (loop.corners[(corner + 1) % n] - at).normalized();
  return before.dot(after) > straight;
}

} // namespace

std::vector<ContactZone> contact_zones(const PartBoundary& boundary) {
  std::vector<ContactZone> zones;
  for (std::size_t l = 0; l < boundary.loops.size(); ++l) {
    const SideLoop& loop = boundary.loops[l];
    const std::size_t n = loop.corners.size();
    const auto tool = [&](std::size_t i) { return boundary.attachments[idx(loop.part[i])].tool; };
    // From an edge where a zone begins; on a loop that is one zone, from any.
    std::size_t first = 0;
    while (first < n && tool(first) == tool((first + n - 1) % n))
      ++first;
    for (std::size_t k = 0; k < n;) {
      const std::size_t start = (first + k) % n;
      ContactZone zone{l, start, 0, tool(start), 0.0, false, false};
      for (; k < n && tool((first + k) % n) == zone.tool; ++k, ++zone.n_sides) {
        const std::size_t i = (first + k) % n;
        zone.length += (loop.corners[(i + 1) % n] - loop.corners[i]).norm();
      }
      if (zone.tool < 0)
        continue;
      zone.ends_in_side = zone.n_sides < n && (goes_straight_on(loop, start) ||
                                               goes_straight_on(loop, (first + k) % n));
      zones.push_back(zone);
    }
  }
  for (ContactZone& zone : zones)
    zone.longest = std::none_of(zones.begin(), zones.end(), [&](const ContactZone& other) {
      return other.tool == zone.tool && other.length > zone.length;
    });
  return zones;
}

bool ContactZone::too_short() const { return ends_in_side && n_sides < least_sides_of_zone; }

std::string sides_of(const ContactZone& zone) {
  return fmt::format("{} edge{}", zone.n_sides, zone.n_sides == 1 ? "" : "s");
}

double size_in_zone(double length) { return length / sides_of_zone; }

double ZoneSizes::in(const ContactZone& zone, double length) const {
  return std::max(size_in_zone(length), zone.longest ? min_in_longest : min);
}

std::vector<geometry::SizeAt> contact_sizes(const PartBoundary& boundary, const ZoneSizes& limits) {
  std::vector<geometry::SizeAt> sizes;
  for (const ContactZone& zone : contact_zones(boundary)) {
    const SideLoop& loop = boundary.loops[zone.loop];
    const std::size_t n = loop.corners.size();
    for (std::size_t j = 0; j < zone.n_sides; ++j) {
      const std::size_t i = (zone.first + j) % n;
      for (const Vec2& x : {loop.corners[i], loop.middles[i], loop.corners[(i + 1) % n]})
        sizes.push_back({x, limits.in(zone, zone.length)});
    }
  }
  return sizes;
}

RemeshedPart remesh_part(const Part& old,
                         const PartBoundary& boundary,
                         const geometry::RemeshSizes& sizes,
                         const geometry::Snap& snap) {
  const auto measure = old.analysis == mechanics::Analysis::axisymmetric
                           ? geometry::Measure::revolved
                           : geometry::Measure::area;
  const geometry::RemeshedDomain domain =
      geometry::remesh_domain(boundary.loops, sizes, measure, snap);
  RemeshedPart part;
  part.mesh = mechanics::triangle_mesh(domain.mesh);
  part.mesh.node_sets.clear(); // the segments are ours
  part.old_measure = domain.old_measure;
  part.measure = domain.measure;

  std::map<std::pair<Index, Index>, std::size_t> side_of;
  for (std::size_t s = 0; s < domain.mesh.boundary.size(); ++s)
    side_of[{domain.mesh.boundary[s].corners[0], domain.mesh.boundary[s].corners[1]}] = s;

  NodeLists supports = support_lists(old, part.mesh.n_points());
  NodeLists sets = set_lists(old, part.mesh.n_points());
  part.loads = loads_without_faces(old);

  const auto place_after = [&](std::size_t s) -> BoundaryPlace {
    // Sides of a loop follow each other; the last one ends where the first one begins.
    const std::size_t next = s + 1;
    const std::int32_t loop = domain.corner_places[s].loop;
    if (next < domain.corner_places.size() && domain.corner_places[next].loop == loop)
      return domain.corner_places[next];
    std::size_t first = s;
    while (first > 0 && domain.corner_places[first - 1].loop == loop)
      --first;
    return domain.corner_places[first];
  };
  for (const Face& face : mechanics::boundary_faces(part.mesh)) {
    const std::size_t s = side_of.at({face.nodes[0], face.nodes[1]});
    const Attachment& attached = boundary.attachments[idx(domain.mesh.boundary[s].segment)];
    supports.add(attached.supports, face.nodes);
    sets.add(attached.sets, face.nodes);
    for (std::size_t l = 0; l < part.loads.size(); ++l)
      if (attached.loads[l] != 0)
        faces_of(part.loads[l]).push_back(face);
    if (attached.contact) {
      part.contact_faces.push_back(face);
      part.places.push_back({domain.corner_places[s], domain.middle_places[s], place_after(s)});
    }
    if (const Index corner = corner_at(boundary, domain.corner_places[s]); corner >= 0) {
      supports.add_corner(corner, face.nodes[0]);
      sets.add_corner(corner, face.nodes[0]);
    }
  }
  for (std::size_t s = 0; s < old.supports.size(); ++s)
    part.supports.push_back({supports[s], old.supports[s].component, old.supports[s].displacement,
                             old.supports[s].name});
  std::size_t s = 0;
  for (const auto& [name, nodes] : old.mesh.node_sets)
    part.mesh.node_sets[name] = sets[s++];
  return part;
}

std::vector<contact::PointSource>
point_sources(const ContactStops& stops,
              std::span<const std::array<BoundaryPlace, 3>> places,
              std::span<const double> coordinates) {
  std::vector<contact::PointSource> sources;
  for (const auto& [start, middle, end] : places) {
    const double total = stops.round(start.loop);
    const double from = stops.way(start);
    const auto beyond = [&](double way) { return way < from ? way + total : way; };
    const double half = beyond(stops.way(middle));
    const double to = stops.way(end) <= from ? stops.way(end) + total : stops.way(end);
    for (const double coordinate : coordinates)
      sources.push_back(
          stops.between(start.loop, way_within(from, half, to, coordinate), stops.part_at(middle)));
  }
  return sources;
}

} // namespace billet::process
