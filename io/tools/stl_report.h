// What is reported of an STL: in the log, by `billet check` and by `billet info`.

#pragma once

#include "io/tools/stl_tool.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// One paragraph for the log: triangles, size, closed or open, volume, repairs, remarks.
[[nodiscard]] std::string report(const FacetFile& file, const StlTool& tool);

/// A row of the table of `billet info`.
struct ReportRow {
  std::string name;
  std::string value;
};

/// Everything the examination found, row by row; complaints are not among it.
[[nodiscard]] std::vector<ReportRow> table(const FacetFile& file, const StlTool& tool);

/// What a user should know though nothing is wrong, one sentence each: parts inside out or without
/// effect, overlaps, needles, coarse coordinates, doubts about the file that proved unfounded.
[[nodiscard]] std::vector<std::string> remarks(const FacetFile& file, const StlTool& tool);

/// A warning if a die is so much larger or smaller than the workpiece that its file is likely to be
/// in another unit, and which; a thousand times larger in any case.
///
/// @param die, workpiece  diagonals, same unit, > 0
/// @param unit            what the file was taken to be in, such as "mm"; empty: it says so itself
[[nodiscard]] std::optional<std::string>
size_warning(double die, double workpiece, std::string_view unit);

} // namespace billet::io
