// Words of other programs and of textbooks, and the words of a case file that stand for them.
//
// A user who comes from another code writes "shear" for Tresca's friction, E for Young's modulus,
// C3D8 for a brick. Each of these is known here, with a remark where ours is not quite the same.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// What a foreign word is called here.
struct OurWord {
  std::string_view word;
  std::string_view remark; ///< a sentence; empty: it is the same
};

/// What another code's word stands for, of the words that are known in its place; capitals, blanks
/// and underscores make no difference.
[[nodiscard]] std::optional<OurWord> our_word(std::string_view theirs,
                                              const std::vector<std::string>& known);

} // namespace billet::io
