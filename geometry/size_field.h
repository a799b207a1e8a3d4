// Lengths of sides over a domain, from samples. Internal to geometry/.
//
// The largest field that is nowhere larger than its samples and changes by no more than a given
// amount per distance. Theory: docs/theory/geometry.md (G.42).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace billet::geometry {

struct SizeSample {
  Vec2 at;     ///< [mm]
  double size; ///< asked for there [mm]
};

class SizeField {
public:
  /// @param max     largest size [mm]
  /// @param growth  most change of size per distance [-]
  SizeField(std::vector<SizeSample> samples, double max, double growth);

  /// min(max, min over samples of size + growth |x - at|); O(log n). (G.42)
  [[nodiscard]] double operator()(const Vec2& x) const;

private:
  /// Samples begin..end, in two halves where there are more than a few.
  struct Node {
    Vec2 low, high;
    double least;
    std::uint32_t begin, end;
    std::uint32_t right; ///< second half; the first one is the next node; 0: not divided
  };
  void divide(std::uint32_t begin, std::uint32_t end);

  std::vector<SizeSample> samples_;
  std::vector<Node> nodes_;
  double max_, growth_;
};

} // namespace billet::geometry
