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
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte > 127 || c == '_' || c == '.';
}

/// Whether a name ends where the text goes on: `height` is not found in `heights`.
bool fits(std::string_view rest, std::string_view name) {
  return rest.starts_with(name) &&
         (rest.size() == name.size() || !may_be_in_name(rest[name.size()]));
}

/// Whether something is assigned, which muParser would do.
bool assigns(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=')
      continue;
    const bool second = i > 0 && std::string_view("=<>!").find(text[i - 1]) < std::string::npos;
    const bool first = i + 1 < text.size() && text[i + 1] == '=';
    if (!second && !first)
      return true;
  }
  return false;
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

bool begins_number(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; }

/// How long the number is that begins at a place: at least 1.
std::size_t length_of_number(const std::string& text, std::size_t at) {
  char* end = nullptr;
  std::strtod(text.c_str() + at, &end);
  return std::max<std::size_t>(1, static_cast<std::size_t>(end - (text.c_str() + at)));
}

/// What may be names in a text: words that are no functions, with blanks between them.
std::vector<std::string> possible_names(const std::string& text) {
  const std::string_view all = text;
  std::vector<std::string> names;
  for (std::size_t at = 0; at < all.size();) {
    if (begins_number(all[at])) {
      at += length_of_number(text, at);
      continue;
    }
    const std::size_t begin = at;
    std::size_t end = at;
    while (at < all.size() && may_be_in_name(all[at])) {
      const std::size_t word = at + word_at(all, at).size();
      at = std::min(all.find_first_not_of(' ', word), all.size());
      if (at < all.size() && all[at] == '(')
        break;
      end = word;
    }
    if (end > begin)
      names.emplace_back(all.substr(begin, end - begin));
    at = std::max(at, begin + 1);
  }
  return names;
}

} // namespace

Expression::Expression(const std::string& text, std::span<const std::string> known) : text_(text) {
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    const char c = all[at];
    if (begins_number(c)) { // as 1.5e-3
      const std::size_t length = length_of_number(text, at);
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
  if (assigns(translated_))
    refuse(text, "a single '=' assigns, which has no meaning here", "'==' compares");
  (void)(*this)(std::vector<double>(used_.size(), 1.0)); // for its syntax
}

namespace {

/// Without the code: that of the key follows.
std::string without_code(const Error& error) {
  Complaint complaint = error.complaints().front();
  complaint.code = {};
  return complaint.text();
}

} // namespace

std::string Expression::mistake_in(const std::string& text) {
  try {
    (void)Expression(text, possible_names(text));
    return {};
  } catch (const Error& error) {
    return without_code(error);
  }
}

std::string Expression::mistake_in(const std::string& text, std::span<const std::string> columns) {
  std::vector<std::string> names(columns.begin(), columns.end());
  for (std::string& name : possible_names(text))
    if (name.starts_with("summary."))
      names.push_back(std::move(name));
  try {
    (void)Expression(text, names);
    return {};
  } catch (const Error& error) {
    return without_code(error);
  }
}

double Expression::operator()(std::span<const double> values) const {
  try {
    mu::Parser parser;
    std::vector<double> variables(values.begin(), values.end());
    for (std::size_t i = 0; i < variables.size(); ++i)
      parser.DefineVar(fmt::format("v{}", i), &variables[i]);
    parser.SetExpr(translated_);
    int n_values = 0;
    const double* const results = parser.Eval(n_values);
    if (n_values != 1)
      refuse(text_, fmt::format("it has {} values with commas between them", n_values),
             "decimals take a point");
    return results[0];
  } catch (const mu::Parser::exception_type& error) {
    refuse(
        text_, fmt::format("{}", error.GetMsg()),
        "operators are + - * / ^ and comparisons; functions abs, sqrt, exp, ln, log10, sin, cos, "
        "tan, atan, min, max");
  }
}

} // namespace billet::study
