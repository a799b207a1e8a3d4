// Loops in pieces that several threads share.
//
// How a loop is cut depends on its length alone, and each piece is worked on by one thread: results
// are the same to the bit for any number of threads.

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace billet {

/// Calls `call(work, k)` for k = 0 ... count - 1, by as many threads as there are.
void share(std::size_t count, void (*call)(const void* work, std::size_t k), const void* work);

/// Calls `work(begin, end)` for 0 ... n in pieces of `piece`, the last one shorter.
template <class Work> void for_pieces(std::size_t n, std::size_t piece, const Work& work) {
  if (n <= piece) {
    if (n > 0)
      work(std::size_t{0}, n);
    return;
  }
  const auto one = [&](std::size_t k) { work(k * piece, std::min(n, (k + 1) * piece)); };
  share((n + piece - 1) / piece,
        [](const void* of, std::size_t k) { (*static_cast<const decltype(one)*>(of))(k); }, &one);
}

/// The sum of `part(begin, end)` over the same pieces, added up one after another.
template <class Part>
[[nodiscard]] double sum_of_pieces(std::size_t n, std::size_t piece, const Part& part) {
  if (n <= piece)
    return n > 0 ? part(std::size_t{0}, n) : 0.0;
  std::vector<double> parts((n + piece - 1) / piece);
  for_pieces(n, piece,
             [&](std::size_t begin, std::size_t end) { parts[begin / piece] = part(begin, end); });
  double sum = 0.0;
  for (const double some : parts)
    sum += some;
  return sum;
}

/// The largest `part(begin, end)` over the same pieces; 0 where none is larger.
template <class Part>
[[nodiscard]] double most_of_pieces(std::size_t n, std::size_t piece, const Part& part) {
  if (n <= piece)
    return n > 0 ? std::max(part(std::size_t{0}, n), 0.0) : 0.0;
  std::vector<double> parts((n + piece - 1) / piece);
  for_pieces(n, piece,
             [&](std::size_t begin, std::size_t end) { parts[begin / piece] = part(begin, end); });
  double most = 0.0;
  for (const double some : parts)
    most = std::max(most, some);
  return most;
}

} // namespace billet
