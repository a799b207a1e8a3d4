// study.json: everything a study found, for programs.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/convergence.h"
#include "study/trade.h"

namespace billet::study {

/// What the rows of a study make together.
struct Findings {
  std::optional<Trade> trade;
  std::vector<Convergence> convergence;
};

[[nodiscard]] Findings findings_of(const Study& study, const std::vector<OutcomeRow>& rows);

[[nodiscard]] std::string
json_text(const Study& study, const std::vector<OutcomeRow>& rows, const Findings& findings);

/// For a person: the trade and the extrapolated values, as tables in Markdown.
[[nodiscard]] std::string in_words(const Study& study, const Findings& findings);

} // namespace billet::study
