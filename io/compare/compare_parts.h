// The parts of `compare_results`; a detail of io/compare.

#pragma once

#include "geometry/base/limits.h"
#include "io/compare/difference.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace billet::io {

void compare_histories(const std::filesystem::path& first,
                       const std::filesystem::path& second,
                       Comparison& into);
void compare_summaries(const std::filesystem::path& first,
                       const std::filesystem::path& second,
                       Comparison& into);
/// The last frame of the workpiece.
void compare_frames(const std::filesystem::path& first,
                    const std::filesystem::path& second,
                    Comparison& into);

/// Two texts; none where they are the same.
[[nodiscard]] Difference
text_difference(std::string quantity, const std::string& first, const std::string& second);

/// The number as tables show it.
[[nodiscard]] std::string number_text(double value);

/// Keeps the larger of two differences at one place; not a number in both is the same.
class LargestDifference {
public:
  void look_at(double first, double second, const std::string& where) {
    if (std::isnan(first) && std::isnan(second))
      return;
    const double apart = std::isfinite(first) && std::isfinite(second)
                             ? std::abs(first - second)
                             : (first == second ? 0.0 : infinity);
    if (std::isfinite(first))
      found_.scale = std::max(found_.scale, std::abs(first));
    if (std::isfinite(second))
      found_.scale = std::max(found_.scale, std::abs(second));
    if (has_any_ && apart <= found_.absolute)
      return;
    has_any_ = true;
    found_.absolute = apart;
    found_.where = where;
    found_.first = number_text(first);
    found_.second = number_text(second);
  }

  [[nodiscard]] Difference of(std::string quantity) const {
    Difference difference = found_;
    difference.quantity = std::move(quantity);
    return difference;
  }

private:
  Difference found_;
  bool has_any_ = false;
};

} // namespace billet::io
