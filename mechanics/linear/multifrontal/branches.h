// How the elimination tree is shared among threads.
//
// Branches of a level know nothing of each other: one thread takes each. Those of the first level
// are whole subtrees; above them each front, fewer and larger from level to level, is a branch of
// its own, and threads share the work within it as well. The cut depends on the tree alone: factors
// and solutions are the same to the bit for any number of threads. Decision:
// docs/decisions/0032-threads.md.

#pragma once

#include "mechanics/linear/elimination.h"

#include <cstddef>
#include <span>
#include <vector>

namespace billet::mechanics {

/// Fronts one after another: some whole subtrees, or one front that joins branches.
struct Branch {
  std::size_t begin; ///< front
  std::size_t end;
};

class Branches {
public:
  /// @param of_flops  share of all operations above which a subtree is cut [-]
  /// @param few       operations that are not worth a branch
  explicit Branches(const Elimination& elimination, double of_flops = 1.0 / 64, double few = 2e5);

  /// All branches, those of a level side by side.
  [[nodiscard]] std::span<const Branch> all() const { return branches_; }
  [[nodiscard]] std::size_t levels() const { return level_start_.size() - 1; }
  /// The first branch of a level. @param level  0 ... levels()
  [[nodiscard]] std::size_t begin(std::size_t level) const { return level_start_[level]; }
  /// Whether a front's complement goes to another branch.
  [[nodiscard]] bool is_handed_up(std::size_t front) const { return handed_up_[front] != 0; }

private:
  std::vector<Branch> branches_;
  std::vector<std::size_t> level_start_; ///< shape (levels + 1)
  std::vector<char> handed_up_;          ///< shape (fronts)
};

} // namespace billet::mechanics
