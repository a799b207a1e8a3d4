// Pieces of HTML.

#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billet::report {

/// Text as HTML.
[[nodiscard]] std::string escaped(std::string_view text);

/// A number as a table shows it: five digits; a dash for what is not a number.
[[nodiscard]] std::string number(double value);

/// <h2> and what follows, with an anchor.
[[nodiscard]] std::string
section(std::string_view id, std::string_view title, const std::string& content);

/// Two columns, what and how much; both are HTML.
using Facts = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] std::string facts(const Facts& rows);

/// A table; the cells are HTML, the first column is left-aligned.
[[nodiscard]] std::string table(const std::vector<std::string>& headings,
                                const std::vector<std::vector<std::string>>& rows);

/// Texts as a list; empty: nothing.
[[nodiscard]] std::string list(const std::vector<std::string>& lines);

/// What folds open.
[[nodiscard]] std::string folded(std::string_view title, const std::string& content, bool open);

} // namespace billet::report
