// Spelling: which known word a user may have meant.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

/// "did you mean 'X'?" when a known word is near; else `label` and the known words; "" for none.
[[nodiscard]] std::string suggestion(std::string_view found,
                                     const std::vector<std::string>& known,
                                     std::string_view label = "known are");

} // namespace billet::io
