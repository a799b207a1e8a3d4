#include "io/compare/difference.h"

#include "geometry/base/error.h"
#include "geometry/base/limits.h"
#include "io/compare/compare_parts.h"

#include <fmt/format.h>

#include <cmath>

namespace billet::io {

double Difference::relative() const {
  if (absolute == 0.0)
    return 0.0;
  return scale > 0.0 && std::isfinite(absolute) ? absolute / scale : infinity;
}

bool Tolerance::admits(const Difference& difference) const {
  return difference.absolute <= absolute + relative * difference.scale;
}

std::string number_text(double value) { return fmt::format("{:.7g}", value); }

Difference
text_difference(std::string quantity, const std::string& first, const std::string& second) {
  return {std::move(quantity), "", first, second, first == second ? 0.0 : infinity, 0.0};
}

Comparison compare_results(const std::filesystem::path& first,
                           const std::filesystem::path& second) {
  for (const std::filesystem::path& folder : {first, second})
    if (!std::filesystem::exists(folder / "history.csv"))
      throw Error(Fault::input_output, folder.string(),
                  "is a folder without history.csv: not the results of a run");
  Comparison comparison;
  compare_histories(first / "history.csv", second / "history.csv", comparison);
  compare_summaries(first / "summary.json", second / "summary.json", comparison);
  compare_frames(first, second, comparison);
  return comparison;
}

} // namespace billet::io
