// The table of a verification, as Markdown and as a page of HTML that needs nothing else.

#pragma once

#include <span>
#include <string>

#include "study/verify/verify.h"

namespace billet::study {

/// How many figures there are, and how many are not within their tolerance; a problem without
/// figures counts as one of both.
struct VerifyCount {
  int figures = 0;
  int failed = 0;
};
[[nodiscard]] VerifyCount count(std::span<const ProblemOutcome> outcomes);

/// A list of problems with what they show and their sources, a line each.
[[nodiscard]] std::string list_text(std::span<const Problem> problems);

/// The head of the Markdown table.
[[nodiscard]] std::string markdown_head();
/// The rows of one problem.
[[nodiscard]] std::string markdown_rows(const ProblemOutcome& outcome);
/// The whole: head, rows and a sentence that sums up.
/// @param version  of the program
[[nodiscard]] std::string markdown_text(std::span<const ProblemOutcome> outcomes,
                                        const std::string& version);
/// One sentence: figures, failures, time.
[[nodiscard]] std::string in_one_sentence(std::span<const ProblemOutcome> outcomes);

/// The same as a page.
[[nodiscard]] std::string html_text(std::span<const ProblemOutcome> outcomes,
                                    const std::string& version);

} // namespace billet::study
