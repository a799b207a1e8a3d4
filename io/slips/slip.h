// One slip; a detail of io/slips.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// What is said of a slip; none: there is none.
using Slip = std::optional<std::string>;

/// @param code  of `billet explain`
inline void add_slip(std::vector<std::string>& slips, std::string_view code, const Slip& slip) {
  if (slip)
    slips.push_back(std::string("warning: [").append(code).append("] ").append(*slip));
}

} // namespace billet::io
