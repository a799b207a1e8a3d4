#include "mechanics/linear/distributed/petsc_rows.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace billet::mechanics {

namespace {

constexpr PetscErrorCode good = 0;
constexpr int message = 1;
constexpr std::size_t values_at_once = 1 << 20; ///< in a message

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// One past the last of the nodes whose values go in one message; at least one does.
template <class ValuesOf>
int end_of_message(int begin, int end, const ValuesOf& values_of, std::size_t& values) {
  values = values_of(begin);
  int node = begin + 1;
  while (node < end && values + values_of(node) <= values_at_once)
    values += values_of(node++);
  return node;
}

} // namespace

void DistributedRows::receive_parts(const DistributedPattern* pattern) {
  int n_processes = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
  part_start_.resize(idx(n_processes) + 1);
  if (rank_ == 0) {
    pattern_ = *pattern;
    dim_ = pattern->dim;
    std::copy_n(pattern->part_start, part_start_.size(), part_start_.begin());
  }
  MPI_Bcast(&dim_, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  MPI_Bcast(part_start_.data(), n_processes + 1, MPI_INT, 0, PETSC_COMM_WORLD);
}

std::vector<int> DistributedRows::receive_neighbours(const DistributedPattern* pattern) {
  std::vector<int> neighbours;
  if (rank_ != 0) {
    block_start_.resize(idx(n_nodes()) + 1);
    MPI_Recv(block_start_.data(), n_nodes() + 1, MPI_INT, 0, message, PETSC_COMM_WORLD,
             MPI_STATUS_IGNORE);
    neighbours.resize(idx(block_start_.back()));
    MPI_Recv(neighbours.data(), block_start_.back(), MPI_INT, 0, message, PETSC_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return neighbours;
  }
  std::vector<int> place(idx(pattern->n_nodes));
  for (int i = 0; i < pattern->n_nodes; ++i)
    place[idx(pattern->order[i])] = i;
  for (int process = processes() - 1; process >= 0; --process) { // its own last, to keep them
    block_start_.assign(1, 0);
    neighbours.clear();
    for (int i = part_start_[idx(process)]; i < part_start_[idx(process) + 1]; ++i) {
      const int node = pattern->order[i];
      for (int k = pattern->neighbour_start[node]; k < pattern->neighbour_start[node + 1]; ++k)
        neighbours.push_back(place[idx(pattern->neighbours[k])]);
      block_start_.push_back(static_cast<int>(neighbours.size()));
    }
    if (process == 0)
      break;
    MPI_Send(block_start_.data(), static_cast<int>(block_start_.size()), MPI_INT, process, message,
             PETSC_COMM_WORLD);
    MPI_Send(neighbours.data(), static_cast<int>(neighbours.size()), MPI_INT, process, message,
             PETSC_COMM_WORLD);
  }
  return neighbours;
}

void DistributedRows::find_positions(const std::vector<int>& neighbours) {
  position_.resize(neighbours.size());
  own_start_.assign(1, 0);
  std::vector<int> sorted;
  for (std::size_t a = 0; a < idx(n_nodes()); ++a) {
    const int begin = block_start_[a], end = block_start_[a + 1];
    sorted.resize(idx(end - begin));
    std::iota(sorted.begin(), sorted.end(), begin);
    std::sort(sorted.begin(), sorted.end(),
              [&](int i, int j) { return neighbours[idx(i)] < neighbours[idx(j)]; });
    int own = 0, others = 0;
    for (const int k : sorted) {
      const int place = neighbours[idx(k)] - first();
      position_[idx(k)] = place >= 0 && place < n_nodes() ? own++ : -1 - others++;
    }
    own_start_.push_back(own_start_.back() + own);
  }
}

PetscErrorCode DistributedRows::make_matrix(std::vector<int> neighbours, Mat* matrix) const {
  std::vector<PetscInt> row_start{0}, columns;
  columns.reserve(neighbours.size() * idx(dim_ * dim_));
  for (std::size_t a = 0; a < idx(n_nodes()); ++a) {
    const auto begin = neighbours.begin() + block_start_[a];
    const auto end = neighbours.begin() + block_start_[a + 1];
    std::sort(begin, end);
    for (int i = 0; i < dim_; ++i) {
      for (auto k = begin; k != end; ++k)
        for (int j = 0; j < dim_; ++j)
          columns.push_back(*k * dim_ + j);
      row_start.push_back(static_cast<PetscInt>(columns.size()));
    }
  }
  const PetscInt n = n_nodes() * dim_;
  PetscCall(MatCreate(PETSC_COMM_WORLD, matrix));
  PetscCall(MatSetSizes(*matrix, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*matrix, dim_));
  PetscCall(MatSetType(*matrix, MATMPIAIJ));
  PetscCall(MatMPIAIJSetPreallocationCSR(*matrix, row_start.data(), columns.data(), nullptr));
  return good;
}

PetscErrorCode DistributedRows::receive(const DistributedPattern* pattern, Mat* matrix) {
  receive_parts(pattern);
  std::vector<int> neighbours = receive_neighbours(pattern);
  find_positions(neighbours);
  return make_matrix(std::move(neighbours), matrix);
}

void DistributedRows::copy(std::size_t node, const double* values, const Values& into) const {
  const int blocks = block_start_[node + 1] - block_start_[node];
  const int own = own_start_[node + 1] - own_start_[node];
  const std::size_t size = idx(dim_) * idx(dim_);
  double* own_row = into.own + size * idx(own_start_[node]);
  double* others_row = into.others + size * idx(block_start_[node] - own_start_[node]);
  for (int i = 0; i < dim_; ++i) {
    for (int k = 0; k < blocks; ++k, values += dim_) {
      const int position = position_[idx(block_start_[node] + k)];
      double* to = position >= 0 ? own_row + dim_ * position : others_row + dim_ * (-1 - position);
      std::copy_n(values, dim_, to);
    }
    own_row += dim_ * own;
    others_row += dim_ * (blocks - own);
  }
}

/// Two messages at a time: one is written while the other is under way.
void DistributedRows::send_values(int process, const double* values) const {
  const std::size_t size = idx(dim_) * idx(dim_);
  const auto blocks_before = [&](int place) {
    return pattern_.neighbour_start + pattern_.order[place];
  };
  const auto values_of = [&](int place) {
    return size * idx(blocks_before(place)[1] - blocks_before(place)[0]);
  };
  std::array<std::vector<double>, 2> packed;
  std::array<MPI_Request, 2> sent{MPI_REQUEST_NULL, MPI_REQUEST_NULL};
  const int end = part_start_[idx(process) + 1];
  std::size_t which = 0;
  for (int begin = part_start_[idx(process)]; begin < end; which = 1 - which) {
    std::size_t n_values = 0;
    const int next = end_of_message(begin, end, values_of, n_values);
    MPI_Wait(&sent[which], MPI_STATUS_IGNORE);
    packed[which].resize(n_values);
    double* to = packed[which].data();
    for (; begin < next; ++begin)
      to = std::copy_n(values + size * idx(*blocks_before(begin)), values_of(begin), to);
    MPI_Isend(packed[which].data(), static_cast<int>(n_values), MPI_DOUBLE, process, message,
              PETSC_COMM_WORLD, &sent[which]);
  }
  MPI_Waitall(2, sent.data(), MPI_STATUSES_IGNORE);
}

void DistributedRows::receive_values(const Values& into) const {
  const std::size_t size = idx(dim_) * idx(dim_);
  const auto values_of = [&](int node) {
    return size * idx(block_start_[idx(node) + 1] - block_start_[idx(node)]);
  };
  std::vector<double> packed;
  for (int begin = 0; begin < n_nodes();) {
    std::size_t n_values = 0;
    const int next = end_of_message(begin, n_nodes(), values_of, n_values);
    packed.resize(n_values);
    MPI_Recv(packed.data(), static_cast<int>(n_values), MPI_DOUBLE, 0, message, PETSC_COMM_WORLD,
             MPI_STATUS_IGNORE);
    const double* from = packed.data();
    for (; begin < next; from += values_of(begin++))
      copy(idx(begin), from, into);
  }
}

PetscErrorCode DistributedRows::fill(Mat matrix, const double* values) const {
  Mat own = nullptr, others = nullptr;
  Values into{};
  PetscCall(MatMPIAIJGetSeqAIJ(matrix, &own, &others, nullptr));
  PetscCall(MatSeqAIJGetArrayWrite(own, &into.own));
  PetscCall(MatSeqAIJGetArrayWrite(others, &into.others));
  if (rank_ != 0) {
    receive_values(into);
  } else {
    for (int process = 1; process < processes(); ++process)
      send_values(process, values);
    const std::size_t size = idx(dim_) * idx(dim_);
    for (int place = 0; place < n_nodes(); ++place)
      copy(idx(place), values + size * idx(pattern_.neighbour_start[pattern_.order[place]]), into);
  }
  PetscCall(MatSeqAIJRestoreArrayWrite(own, &into.own));
  PetscCall(MatSeqAIJRestoreArrayWrite(others, &into.others));
  PetscCall(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY)); // tells all that the values are new
  PetscCall(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return good;
}

void DistributedRows::shares(std::vector<int>& counts, std::vector<int>& starts) const {
  for (std::size_t p = 0; p + 1 < part_start_.size(); ++p) {
    counts.push_back(dim_ * (part_start_[p + 1] - part_start_[p]));
    starts.push_back(dim_ * part_start_[p]);
  }
}

PetscErrorCode DistributedRows::scatter(const double* whole, Vec vector) const {
  std::vector<int> counts, starts;
  shares(counts, starts);
  std::vector<double> packed;
  packed.reserve(rank_ == 0 ? idx(dim_) * idx(part_start_.back()) : 0);
  if (rank_ == 0)
    for (int place = 0; place < part_start_.back(); ++place)
      for (int i = 0; i < dim_; ++i)
        packed.push_back(whole[idx(pattern_.order[place]) * idx(dim_) + idx(i)]);
  double* here = nullptr;
  PetscCall(VecGetArrayWrite(vector, &here));
  MPI_Scatterv(packed.data(), counts.data(), starts.data(), MPI_DOUBLE, here, dim_ * n_nodes(),
               MPI_DOUBLE, 0, PETSC_COMM_WORLD);
  PetscCall(VecRestoreArrayWrite(vector, &here));
  return good;
}

PetscErrorCode DistributedRows::gather(Vec vector, double* whole) const {
  std::vector<int> counts, starts;
  shares(counts, starts);
  std::vector<double> packed(rank_ == 0 ? idx(dim_) * idx(part_start_.back()) : 0);
  const double* here = nullptr;
  PetscCall(VecGetArrayRead(vector, &here));
  MPI_Gatherv(here, dim_ * n_nodes(), MPI_DOUBLE, packed.data(), counts.data(), starts.data(),
              MPI_DOUBLE, 0, PETSC_COMM_WORLD);
  PetscCall(VecRestoreArrayRead(vector, &here));
  if (rank_ == 0)
    for (int place = 0; place < part_start_.back(); ++place)
      for (std::size_t i = 0; i < idx(dim_); ++i)
        whole[idx(pattern_.order[place]) * idx(dim_) + i] = packed[idx(place) * idx(dim_) + i];
  return good;
}

} // namespace billet::mechanics
