// Text within XML files.

#pragma once

#include <string>
#include <string_view>

namespace billet::io {

/// A text as the value of an attribute: &, <, > and quotes as entities.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// What such a value says.
[[nodiscard]] std::string xml_unescaped(std::string_view text);

} // namespace billet::io
