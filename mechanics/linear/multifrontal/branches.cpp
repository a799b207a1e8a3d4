#include "mechanics/linear/multifrontal/branches.h"

#include <algorithm>

namespace billet::mechanics {

namespace {

double cube(double x) { return x * x * x; }

/// Operations, about: of each front and all below it.
std::vector<double> subtree_flops(std::span<const Front> fronts) {
  std::vector<double> flops(fronts.size(), 0.0);
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const Front& front = fronts[f];
    flops[f] += (cube(front.rows + front.columns) - cube(front.rows)) / 3.0;
    if (front.parent >= 0)
      flops[idx(front.parent)] += flops[f];
  }
  return flops;
}

/// Subtrees that are not cut, several small ones together.
///
/// @param flops  of the subtree of each front
/// @param most   operations of a branch
std::vector<Branch>
gathered_subtrees(std::span<const Front> fronts, std::span<const double> flops, double most) {
  std::vector<Branch> branches;
  double gathered = 0.0;
  std::size_t begin = 0;
  std::size_t subtree = 0; // where the one at hand begins
  const auto close = [&](std::size_t end) {
    if (end > begin)
      branches.push_back({begin, end});
    gathered = 0.0;
    begin = end;
  };
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const Index parent = fronts[f].parent;
    if (flops[f] > most) {
      close(f);
      begin = subtree = f + 1;
    } else if (parent < 0 || flops[idx(parent)] > most) {
      if (gathered + flops[f] > most)
        close(subtree);
      gathered += flops[f];
      subtree = f + 1;
    }
  }
  close(fronts.size());
  return branches;
}

} // namespace

Branches::Branches(const Elimination& elimination, double of_flops, double few) {
  const std::span<const Front> fronts = elimination.fronts();
  const std::vector<double> flops = subtree_flops(fronts);
  double all = 0.0;
  for (std::size_t f = 0; f < fronts.size(); ++f)
    if (fronts[f].parent < 0)
      all += flops[f];
  constexpr double least = 8.0; // branches that are worth a level above them
  const double most = all > least * few ? std::max(of_flops * all, few) : all;
  branches_ = gathered_subtrees(fronts, flops, most);
  std::vector<std::size_t> level(fronts.size(), 0); // of the fronts above
  std::size_t highest = 0;
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const Index parent = fronts[f].parent;
    const bool above = flops[f] > most;
    if (above)
      level[f] = std::max(level[f], std::size_t{1});
    highest = std::max(highest, level[f]);
    const bool to_above = parent >= 0 && flops[idx(parent)] > most;
    handed_up_.push_back(to_above ? 1 : 0);
    if (above && to_above)
      level[idx(parent)] = std::max(level[idx(parent)], level[f] + 1);
  }
  level_start_ = {0, branches_.size()};
  for (std::size_t l = 1; l <= highest; ++l) {
    for (std::size_t f = 0; f < fronts.size(); ++f)
      if (level[f] == l)
        branches_.push_back({f, f + 1});
    level_start_.push_back(branches_.size());
  }
}

} // namespace billet::mechanics
