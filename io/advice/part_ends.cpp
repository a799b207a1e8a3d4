#include "io/advice/part_ends.h"

#include "geometry/base/box.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace billet::io {

std::vector<mechanics::Index> nodes_at(const process::Part& part, int axis, End end) {
  constexpr double same_plane = 1e-6; // of the part's size, as `where` has it
  const Box box = box_of(part.mesh.points);
  const double level = end == End::low ? box.low[axis] : box.high[axis];
  std::vector<mechanics::Index> nodes;
  for (mechanics::Index n = 0; n < part.mesh.n_points(); ++n)
    if (std::abs(part.mesh.points[idx(n)][axis] - level) <= same_plane * box.size())
      nodes.push_back(n);
  return nodes;
}

const TimeFunction* hold_of(const process::Part& part, int axis, End end, int component) {
  std::map<mechanics::Index, const TimeFunction*> holds;
  for (const process::Support& support : part.supports)
    if (support.component == component)
      for (const mechanics::Index node : support.nodes)
        holds.emplace(node, &support.displacement);
  const TimeFunction* common = nullptr;
  for (const mechanics::Index node : nodes_at(part, axis, end)) {
    const auto held = holds.find(node);
    if (held == holds.end() || (common != nullptr && !is_multiple(*held->second, *common, 1.0)))
      return nullptr;
    common = held->second;
  }
  return common;
}

bool is_mirror(const process::Part& part, int axis, End end) {
  const TimeFunction* const hold = hold_of(part, axis, end, axis);
  if (hold == nullptr || !rests(*hold))
    return false;
  for (int other = 0; other < part.mesh.dimension(); ++other)
    if (other != axis && hold_of(part, axis, end, other) != nullptr)
      return false;
  return true;
}

bool rests(const TimeFunction& displacement) {
  return std::all_of(displacement.points().begin(), displacement.points().end(),
                     [](const auto& point) { return point.second == 0.0; });
}

bool is_multiple(const TimeFunction& a, const TimeFunction& b, double factor) {
  constexpr double rounding = 1e-9;
  if (rests(a) && rests(b))
    return true;
  if (a.points().size() != b.points().size())
    return false;
  double largest = 0.0;
  for (const auto& [time, value] : b.points())
    largest = std::max(largest, std::abs(factor * value));
  for (std::size_t i = 0; i < a.points().size(); ++i)
    if (a.points()[i].first != b.points()[i].first ||
        std::abs(a.points()[i].second - factor * b.points()[i].second) > rounding * largest)
      return false;
  return true;
}

} // namespace billet::io
