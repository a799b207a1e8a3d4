// Spelling: which known word a user may have meant.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

/// A known word that a user may have meant, and what there is to say of it.
struct Meant {
  std::string word;
  std::string remark; ///< a sentence; may be empty

  /// "did you mean 'X'?" and the remark.
  [[nodiscard]] std::string text() const;
};

/// What another code's word stands for (other_words.h), or the known word that is spelt nearly so.
[[nodiscard]] std::optional<Meant> meant(std::string_view found,
                                         const std::vector<std::string>& known);

/// "did you mean 'X'?" when a known word is meant; else `label` and the known words; "" for none.
[[nodiscard]] std::string suggestion(std::string_view found,
                                     const std::vector<std::string>& known,
                                     std::string_view label = "known are");

} // namespace billet::io
