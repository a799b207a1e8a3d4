// Texts in quotes, as our own case files have them.

#pragma once

#include <string>
#include <string_view>

namespace billet::io {

/// What stands between the first and the last quote, its escapes undone, with blanks for what
/// cannot be printed; else the text itself.
[[nodiscard]] std::string unquoted(std::string_view text);

} // namespace billet::io
