// One slip; a detail of io/slips.

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace billet::io {

/// What is said of a slip; none: there is none.
using Slip = std::optional<std::string>;

inline void add_slip(std::vector<std::string>& slips, const Slip& slip) {
  if (slip)
    slips.push_back("warning: " + *slip);
}

} // namespace billet::io
