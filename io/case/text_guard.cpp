#include "io/case/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace billet::io {

namespace {

constexpr std::size_t longest_text = std::size_t{16} << 20U; // 16 MiB
// Case files nest 5 deep. The parser and the destructors of its trees recurse, and the two limits
// multiply (a dotted key in every bracket), so they are chosen far below the size of a stack.
constexpr int most_brackets = 32;
constexpr int most_dots = 32;

/// Walks over a TOML text, skipping strings and comments, and counts brackets and dots.
class Guard {
public:
  Guard(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void check() {
    if (text_.starts_with("\xEF\xBB\xBF")) // byte order mark
      at_ = 3;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (c == '"' || c == '\'')
        skip_string(c);
      else
        count(c);
    }
  }

private:
  void count(char c) {
    ++at_;
    if (static_cast<unsigned char>(c) >= 0x80)
      refuse("not valid TOML: a character beyond ASCII outside of quotes");
    if (c == '[' && starts_line_ && brackets_ == 0)
      check_header();
    starts_line_ = c == '\n' || (starts_line_ && (c == ' ' || c == '\t'));
    if (c == '.' && ++dots_ > most_dots)
      refuse(
          fmt::format("a key of more than {} parts: a case file has no use for that", most_dots));
    if (c == '[' || c == '{') {
      if (++brackets_ > most_brackets)
        refuse(fmt::format("brackets nested more than {} deep: a case file has no use for that",
                           most_brackets));
    } else if ((c == ']' || c == '}') && brackets_ > 0) {
      --brackets_;
    }
    if (std::string_view("[]{},=\n").find(c) != std::string_view::npos)
      dots_ = 0;
  }

  /// The library is not prepared for anything but a key in a header.
  void check_header() const {
    std::size_t at = text_.find_first_not_of(" \t", at_);
    if (at < text_.size() && text_[at] == '[')
      at = text_.find_first_not_of(" \t", at + 1);
    const char c = at < text_.size() ? text_[at] : '\n';
    const bool is_key = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                        std::string_view("_-\"'").find(c) != std::string_view::npos;
    if (!is_key)
      refuse("not valid TOML: '[' without a key after it");
  }

  void skip_string(char quote) {
    starts_line_ = false;
    const std::string triple(3, quote);
    const bool many_lines = text_.substr(at_, 3) == triple;
    at_ += many_lines ? 3 : 1;
    while (at_ < text_.size()) {
      if (quote == '"' && text_[at_] == '\\') {
        at_ += 2;
      } else if (many_lines ? text_.substr(at_, 3) == triple : text_[at_] == quote) {
        at_ += many_lines ? 3 : 1;
        // a string of many lines may end in one or two quotes of its own
        for (int extra = 0; many_lines && extra < 2 && text_.substr(at_, 1) == triple.substr(0, 1);
             ++extra)
          ++at_;
        return;
      } else if (!many_lines && text_[at_] == '\n') {
        return;
      } else {
        ++at_;
      }
    }
    at_ = text_.size();
  }

  [[noreturn]] void refuse(const std::string& what) const {
    std::size_t line = 1;
    for (const char c : text_.substr(0, at_))
      line += c == '\n' ? 1U : 0U;
    throw Error(Fault::case_file, fmt::format("{}:{}", name_, line), what, "",
                error_code::toml_syntax);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int brackets_ = 0;
  int dots_ = 0;
  bool starts_line_ = true; ///< only blanks since the start of the line
};

} // namespace

void guard_text(std::string_view text, const std::string& name) {
  if (text.size() > longest_text)
    throw Error(Fault::case_file, name,
                fmt::format("the text has {} bytes, allowed are 16 MiB", text.size()));
  Guard(text, name).check();
}

} // namespace billet::io
