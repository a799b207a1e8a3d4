#include "io/case/quoted.h"

#include <cstddef>

namespace billet::io {

std::string unquoted(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"')
    return std::string(text);
  std::string plain;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != '\\' || i + 2 >= text.size()) {
      plain += text[i];
    } else if (constexpr std::size_t digits = 4;
               text[i + 1] == 'u' && i + 2 + digits < text.size()) {
      // Our own case files have it for what cannot be printed only.
      plain += ' ';
      i += 1 + digits;
    } else {
      ++i;
      plain += std::string_view("nrtbf").find(text[i]) == std::string_view::npos ? text[i] : ' ';
    }
  }
  return plain;
}

} // namespace billet::io
