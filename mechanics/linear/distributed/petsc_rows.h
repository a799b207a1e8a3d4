// Rows of a distributed matrix: which this process owns, and how they and vectors come here.
//
// Process 0 has the whole matrix and whole vectors, in the numbers of the program. Nodes have
// places in an order in which each process owns a piece; a place's unknowns are those of the
// distributed matrix. Every public function is called by all processes together, with arrays of the
// program on process 0 and null elsewhere.

#pragma once

#include "mechanics/linear/distributed/component.h"

#include <petscmat.h>

#include <cstddef>
#include <vector>

namespace billet::mechanics {

class DistributedRows {
public:
  /// Makes a matrix of zeros over the rows that come here.
  PetscErrorCode receive(const DistributedPattern* pattern, Mat* matrix);
  PetscErrorCode fill(Mat matrix, const double* values) const;
  PetscErrorCode scatter(const double* whole, Vec vector) const;
  PetscErrorCode gather(Vec vector, double* whole) const;

private:
  /// Where the values of a matrix lie in PETSc: columns of this process and those of others.
  struct Values {
    double* own;
    double* others;
  };
  void receive_parts(const DistributedPattern* pattern);
  /// @return neighbours of the nodes here, by their places
  [[nodiscard]] std::vector<int> receive_neighbours(const DistributedPattern* pattern);
  void find_positions(const std::vector<int>& neighbours);
  PetscErrorCode make_matrix(std::vector<int> neighbours, Mat* matrix) const;
  void send_values(int process, const double* values) const;
  void receive_values(const Values& into) const;
  /// Copies the values of all rows of a node that is owned here, its number among those.
  void copy(std::size_t node, const double* values, const Values& into) const;
  [[nodiscard]] int processes() const { return static_cast<int>(part_start_.size()) - 1; }
  [[nodiscard]] int first() const { return part_start_[static_cast<std::size_t>(rank_)]; }
  [[nodiscard]] int n_nodes() const {
    return part_start_[static_cast<std::size_t>(rank_) + 1] - first();
  }
  /// How many numbers of a whole vector each process has, and from where on.
  void shares(std::vector<int>& counts, std::vector<int>& starts) const;

  int rank_ = 0;
  int dim_ = 0;
  std::vector<int> part_start_;
  DistributedPattern pattern_{}; ///< process 0 only
  std::vector<int> block_start_; ///< of the nodes here, shape (n_nodes + 1)
  std::vector<int> own_start_;   ///< of their blocks in this process' columns, shape (n_nodes + 1)
  /// Of each block: its position in the row among those in this process' columns, or -1 - its
  /// position among the others.
  std::vector<int> position_;
};

} // namespace billet::mechanics
