#include "mechanics/linear/multifrontal/extend_add.h"

#include "geometry/base/pieces.h"
#include "mechanics/linear/multifrontal/front_vector.h"

#include <algorithm>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace billet::mechanics {

namespace {

#ifndef __AVX512F__
/// How the rows of a piece lie in the parent.
enum Pattern : std::uint32_t {
  scattered,
  in_turn,
  paired, ///< two by two, those of a node
};
#endif

} // namespace

ExtendAdd::ExtendAdd(const Elimination& elimination) {
  const std::span<const Front> fronts = elimination.fronts();
  for (const Front& front : fronts) {
    pieces_start_.push_back(pieces_.size());
    in_parent_start_.push_back(in_parent_.size());
    step_.push_back(padded(idx(front.rows)));
    if (front.parent < 0)
      continue;
    const Front& parent = fronts[idx(front.parent)];
    const std::span<const Index> below = elimination.rows(parent);
    const auto columns = static_cast<std::uint32_t>(parent.columns);
    std::uint32_t next = 0;
    for (const Index row : elimination.rows(front)) {
      auto to = static_cast<std::uint32_t>(row - parent.first);
      if (to >= columns) {
        while (below[next] < row)
          ++next;
        to = columns + next;
      }
      in_parent_.push_back(to);
    }
    const auto pieces = cut(std::span(in_parent_).subspan(in_parent_start_.back()), columns);
    pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
  }
  pieces_start_.push_back(pieces_.size());
}

#ifdef __AVX512F__

/// As many of the parent's rows as a vector has numbers, from one of the child's on.
std::vector<ExtendAdd::Piece> ExtendAdd::cut(std::span<const std::uint32_t> places,
                                             std::uint32_t columns) {
  constexpr std::uint32_t width = 16;
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const std::uint32_t to = places[i];
    const bool goes_on = !pieces.empty() && to < pieces.back().to + width &&
                         (to < columns) == (pieces.back().to < columns);
    if (!goes_on)
      pieces.push_back({i, 0, to, 0});
    ++pieces.back().count;
    pieces.back().pattern |= 1U << (to - pieces.back().to);
  }
  return pieces;
}

/// Adds rows of a column, from the one given on.
void ExtendAdd::add(const Piece& piece,
                    std::uint32_t first,
                    const std::uint32_t* places,
                    const float* from,
                    float* to) {
  const std::uint32_t before = places[first] - piece.to;
  const auto rows = static_cast<__mmask16>(piece.pattern >> before << before);
  float* at = to + piece.to;
  const __m512 more = _mm512_maskz_expandloadu_ps(rows, from + first);
  _mm512_mask_storeu_ps(at, rows, _mm512_add_ps(_mm512_maskz_loadu_ps(rows, at), more));
}

#else

/// Long runs, and what lies between them.
std::vector<ExtendAdd::Piece> ExtendAdd::cut(std::span<const std::uint32_t> places,
                                             std::uint32_t columns) {
  constexpr std::uint32_t few = 16; // rows in turn that are not worth a loop of their own
  std::vector<Piece> runs;
  for (std::uint32_t i = 0; i < places.size(); ++i)
    if (i > 0 && places[i] != columns && places[i] == places[i - 1] + 1)
      ++runs.back().count;
    else
      runs.push_back({i, 1, places[i], in_turn});
  std::vector<Piece> pieces;
  for (const Piece& run : runs) {
    const bool joins = !pieces.empty() && run.count < few && pieces.back().count < few &&
                       (pieces.back().to < columns) == (run.to < columns);
    if (joins) {
      pieces.back().count += run.count;
      pieces.back().pattern = scattered;
    } else {
      pieces.push_back(run);
    }
  }
  for (Piece& piece : pieces) {
    bool by_two = piece.pattern == scattered && piece.count % 2 == 0;
    for (std::uint32_t i = piece.from; by_two && i < piece.from + piece.count; i += 2)
      by_two = places[i + 1] == places[i] + 1;
    if (by_two)
      piece.pattern = paired;
  }
  return pieces;
}

/// Adds rows of a column, from the one given on.
void ExtendAdd::add(const Piece& piece,
                    std::uint32_t first,
                    const std::uint32_t* places,
                    const float* from,
                    float* to) {
  const std::uint32_t end = piece.from + piece.count;
  if (piece.pattern == in_turn) {
    float* at = to + piece.to + (first - piece.from);
    for (std::uint32_t i = first; i < end; ++i)
      *at++ += from[i];
    return;
  }
  if (piece.pattern == paired) {
    if ((end - first) % 2 != 0) { // a node's first row is above the diagonal
      to[places[first]] += from[first];
      ++first;
    }
    for (std::uint32_t i = first; i < end; i += 2)
      add_pair(from + i, to + places[i]);
    return;
  }
  for (std::uint32_t i = first; i < end; ++i)
    to[places[i]] += from[i];
}

#endif

void ExtendAdd::add_columns(std::size_t child,
                            std::span<const Piece> columns,
                            const Piece* last,
                            const float* complement,
                            float* to,
                            std::ptrdiff_t origin,
                            std::size_t step,
                            Threads threads) const {
  const std::uint32_t* places = in_parent_.data() + in_parent_start_[child];
  const auto add_piece = [&](const Piece& piece) {
    for (std::uint32_t j = piece.from; j < piece.from + piece.count; ++j) {
      const float* from = complement + j * step_[child];
      float* column = to + (origin + static_cast<std::ptrdiff_t>(places[j] * step));
      add(piece, j, places, from, column);
      for (const Piece* below = &piece + 1; below != last; ++below)
        add(*below, below->from, places, from, column);
    }
  };
  for_pieces(columns.size(), threads == Threads::all ? 4 : columns.size(),
             [&](std::size_t begin, std::size_t end) {
               for (const Piece& piece : columns.subspan(begin, end - begin))
                 add_piece(piece);
             });
}

ExtendAdd::Split ExtendAdd::split(std::size_t child, std::size_t columns) const {
  const auto all = std::span(pieces_).subspan(pieces_start_[child],
                                              pieces_start_[child + 1] - pieces_start_[child]);
  const auto end =
      std::find_if(all.begin(), all.end(), [&](const Piece& piece) { return piece.to >= columns; });
  return {all, static_cast<std::size_t>(end - all.begin())};
}

void ExtendAdd::to_panel(std::size_t child,
                         const float* complement,
                         const Panel& parent,
                         Threads threads) const {
  const auto [all, eliminated] = split(child, parent.columns);
  add_columns(child, all.first(eliminated), all.data() + all.size(), complement, parent.values, 0,
              padded(parent.rows), threads);
}

void ExtendAdd::to_complement(std::size_t child,
                              const float* complement,
                              const Panel& parent,
                              float* to,
                              Threads threads) const {
  const auto [all, eliminated] = split(child, parent.columns);
  const std::size_t step = padded(parent.rows - parent.columns);
  const auto origin = -static_cast<std::ptrdiff_t>(parent.columns * (step + 1));
  add_columns(child, all.subspan(eliminated), all.data() + all.size(), complement, to, origin, step,
              threads);
}

} // namespace billet::mechanics
