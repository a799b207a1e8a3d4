#include "mechanics/linear/multifrontal/front_assembly.h"

#include <algorithm>
#include <optional>

namespace billet::mechanics {

namespace {

/// Entries of the triangle that couple two nodes, found by their first.
class BlockAt {
public:
  /// @param column  of the node's first unknown
  /// @param first   the entry that couples it with the other's first
  BlockAt(const OrderedTriangle& triangle, std::size_t dim, std::size_t column, std::size_t first)
      : triangle_(&triangle), dim_(dim), column_(column), down_(first - start(column)) {}

  /// Calls `visit` with every entry on and below the diagonal, its column and row within the block.
  template <class Visit> void for_each(Visit visit) const {
    const bool on_diagonal = down_ == 0;
    for (std::size_t j = 0; j < dim_; ++j)
      for (std::size_t i = on_diagonal ? j : 0; i < dim_; ++i)
        visit(start(column_ + j) + down_ + i - j, j, i); // a column has one row less than the last
  }

  /// Entries between rows of the matrix, where the block lies in them as in the triangle.
  ///
  /// @param across  whether the matrix' rows are the triangle's
  [[nodiscard]] std::optional<std::uint32_t> width(bool across) const {
    if (column_ + dim_ >= triangle_->start.size())
      return {};
    const std::size_t first = start(column_) + down_;
    if (first + dim_ > start(column_ + 1))
      return {};
    const Index row = triangle_->rows[first], entry = triangle_->entries[first];
    const std::size_t second = start(column_ + 1) + down_; // column 1, row 1
    if (second >= start(column_ + 2))
      return {};
    const Index width = triangle_->entries[second] - entry - 1;
    bool is_block = width > 0;
    for_each([&](std::size_t k, std::size_t j, std::size_t i) {
      const std::size_t at = across ? i * idx(width) + j : j * idx(width) + i;
      is_block = is_block && k < start(column_ + j + 1) &&
                 triangle_->rows[k] == row + static_cast<Index>(i) &&
                 triangle_->entries[k] == entry + static_cast<Index>(at);
    });
    return is_block ? std::optional(static_cast<std::uint32_t>(width)) : std::nullopt;
  }

private:
  [[nodiscard]] std::size_t start(std::size_t column) const {
    return idx(triangle_->start[column]);
  }

  const OrderedTriangle* triangle_;
  std::size_t dim_;
  std::size_t column_;
  std::size_t down_; ///< the column
};

} // namespace

FrontAssembly::FrontAssembly(const Elimination& elimination) : dim_(idx(elimination.dim())) {
  const OrderedTriangle& triangle = elimination.triangle();
  std::vector<std::size_t> local(elimination.order().size());
  std::vector<char> taken(triangle.rows.size(), 0);
  for (const Front& front : elimination.fronts()) {
    start_.push_back({along_.size(), across_.size(), singles_.size()});
    const std::span<const Index> rows = elimination.rows(front);
    for (std::size_t i = 0; i < rows.size(); ++i)
      local[idx(rows[i])] = idx(front.columns) + i;
    const std::size_t first = idx(front.first), end = first + idx(front.columns);
    const std::size_t step = padded(idx(front.columns + front.rows));
    for (std::size_t j = first; j < end; ++j)
      local[j] = j - first;
    for (std::size_t j = first; j < end; ++j)
      for (std::size_t k = idx(triangle.start[j]); k < idx(triangle.start[j + 1]); ++k) {
        if (taken[k] != 0)
          continue;
        const auto entry = static_cast<std::uint32_t>(triangle.entries[k]);
        const auto place =
            static_cast<std::uint32_t>((j - first) * step + local[idx(triangle.rows[k])]);
        const BlockAt block(triangle, dim_, j, k);
        const bool inside = j + dim_ <= end;
        const auto along = inside ? block.width(false) : std::nullopt;
        const auto across = inside && !along ? block.width(true) : std::nullopt;
        if (!along && !across) {
          singles_.push_back({entry, place});
          continue;
        }
        (along ? along_ : across_).push_back({entry, along ? *along : *across, place});
        block.for_each([&](std::size_t at, std::size_t, std::size_t) { taken[at] = 1; });
      }
  }
  start_.push_back({along_.size(), across_.size(), singles_.size()});
}

template <std::size_t dim>
void FrontAssembly::copy_blocks(std::size_t f,
                                const SparseMatrix& matrix,
                                double scale,
                                const Panel& panel) const {
  const std::size_t step = padded(panel.rows);
  // Of a block on the diagonal what is above it is copied, too: nobody looks there.
  const auto copy = [&](const Block& block, std::size_t next_column, std::size_t next_row) {
    const double* from = matrix.values.data() + block.entry;
    float* to = panel.values + block.place;
    for (std::size_t j = 0; j < dim; ++j)
      for (std::size_t i = 0; i < dim; ++i)
        to[j * step + i] = static_cast<float>(scale * from[j * next_column + i * next_row]);
  };
  for (std::size_t k = start_[f].along; k < start_[f + 1].along; ++k)
    copy(along_[k], along_[k].width, 1);
  for (std::size_t k = start_[f].across; k < start_[f + 1].across; ++k)
    copy(across_[k], 1, across_[k].width);
}

void FrontAssembly::assemble(std::size_t f,
                             const SparseMatrix& matrix,
                             double scale,
                             const Panel& panel) const {
  std::fill_n(panel.values, padded(panel.rows) * panel.columns, 0.0F);
  if (dim_ == 2)
    copy_blocks<2>(f, matrix, scale, panel);
  else
    copy_blocks<3>(f, matrix, scale, panel);
  for (std::size_t k = start_[f].singles; k < start_[f + 1].singles; ++k)
    panel.values[singles_[k].place] = static_cast<float>(scale * matrix.values[singles_[k].entry]);
}

} // namespace billet::mechanics
