// What `billet explain CODE` says: one table of every code that messages carry.

#pragma once

#include <span>
#include <string_view>

namespace billet::app {

/// A kind of message.
struct Explanation {
  std::string_view code;
  std::string_view
      kind; ///< "exit status", "error", "failed check", "warning", "slip", "advice", "cause"
  std::string_view meaning; ///< what has happened, or what the number means
  std::string_view causes;  ///< as a rule; may be empty
  std::string_view remedy;  ///< may be empty
};

/// In the order in which a user meets them: exit statuses first.
[[nodiscard]] std::span<const Explanation> explanations();

} // namespace billet::app
