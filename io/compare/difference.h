// How far two results, or two case files, are apart.
//
// Each quantity is compared as a whole: a column of history.csv at all common times, a figure of
// summary.json, a field of the last frame at all nodes. Its difference is the largest one there is,
// and relative to the largest value that the quantity has in either of the two, so that noise
// around zero does not count; components of a vector share that scale.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace billet::io {

/// One quantity of both.
struct Difference {
  std::string quantity; ///< "history punch.force_y"
  std::string where;    ///< of the largest difference: "t = 0.5", "node 17"; may be empty
  std::string first, second;
  double absolute = 0.0; ///< the largest difference; infinite: not comparable, such as texts
  double scale = 0.0;    ///< the largest value

  /// 0 of what is the same; infinite of what is not comparable.
  [[nodiscard]] double relative() const;
};

/// What has been compared.
struct Comparison {
  std::vector<Difference> quantities;
  std::vector<std::string> notes; ///< what could be compared in part only, and how
};

/// What is still the same: |a - b| <= absolute + relative * scale.
struct Tolerance {
  double relative = 1e-6;
  double absolute = 0.0;

  [[nodiscard]] bool admits(const Difference& difference) const;
};

/// Two folders of results.
/// @throws Error (Fault::input_output) if one of them has no results
[[nodiscard]] Comparison compare_results(const std::filesystem::path& first,
                                         const std::filesystem::path& second);

/// Two case files with all defaults filled in; lists are compared item by item, tools, stages and
/// measures by their names. The files that both name are compared byte by byte.
/// @throws Error (Fault::case_file) if one of them cannot be read, (Fault::geometry) for a file
/// that it names
[[nodiscard]] Comparison compare_cases(const std::filesystem::path& first,
                                       const std::filesystem::path& second);

} // namespace billet::io
