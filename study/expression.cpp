#include "study/expression.h"

#include "geometry/base/error.h"
#include "io/case/suggestion.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

namespace billet::study {

namespace {

bool may_be_in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

/// Whether a name ends where the text goes on: `height` is not found in `heights`.
bool fits(std::string_view rest, std::string_view name) {
  return rest.starts_with(name) &&
         (rest.size() == name.size() || !may_be_in_name(rest[name.size()]));
}

[[noreturn]] void
refuse(const std::string& text, const std::string& why, const std::string& remedy = {}) {
  throw Error(Fault::case_file, "", fmt::format("expression '{}': {}", text, why), remedy);
}

/// A word of a text from a place on.
std::string_view word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && may_be_in_name(text[end]))
    ++end;
  return text.substr(at, end - at);
}

} // namespace

Expression::Expression(const std::string& text, std::span<const std::string> known) : text_(text) {
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    const char c = all[at];
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') { // a number, as 1.5e-3
      char* end = nullptr;
      std::strtod(text.c_str() + at, &end);
      const auto length =
          std::max<std::size_t>(1, static_cast<std::size_t>(end - (text.c_str() + at)));
      translated_ += all.substr(at, length);
      at += length;
      continue;
    }
    if (!may_be_in_name(c)) {
      translated_ += c;
      ++at;
      continue;
    }
    std::size_t best = known.size();
    for (std::size_t i = 0; i < known.size(); ++i)
      if (fits(all.substr(at), known[i]) &&
          (best == known.size() || known[i].size() > known[best].size()))
        best = i;
    const std::string_view word = word_at(all, at);
    if (best == known.size()) {
      const std::size_t after = all.find_first_not_of(' ', at + word.size());
      const bool is_function = after != std::string_view::npos && all[after] == '(';
      if (!is_function && word != "pi")
        refuse(text, fmt::format("there is nothing called '{}'", word),
               io::suggestion(std::string(word),
                              std::vector<std::string>(known.begin(), known.end())));
      translated_ += word == "pi" ? "_pi" : word;
      at += word.size();
      continue;
    }
    auto place = std::find(used_.begin(), used_.end(), best);
    if (place == used_.end())
      place = used_.insert(used_.end(), best);
    translated_ += fmt::format("v{}", place - used_.begin());
    at += known[best].size();
  }
  (void)(*this)(std::vector<double>(used_.size(), 1.0)); // for its syntax
}

double Expression::operator()(std::span<const double> values) const {
  try {
    mu::Parser parser;
    std::vector<double> variables(values.begin(), values.end());
    for (std::size_t i = 0; i < variables.size(); ++i)
      parser.DefineVar(fmt::format("v{}", i), &variables[i]);
    parser.SetExpr(translated_);
    return parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    refuse(
        text_, fmt::format("{}", error.GetMsg()),
        "operators are + - * / ^ and comparisons; functions abs, sqrt, exp, ln, log10, sin, cos, "
        "tan, atan, min, max");
  }
}

} // namespace billet::study
