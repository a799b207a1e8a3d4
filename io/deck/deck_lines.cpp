#include "io/deck/deck_lines.h"

#include "geometry/base/error.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace billet::io {

namespace {

/// Fields between commas that are not in quotes; quotes are taken off.
std::vector<std::string> fields_of_line(std::string_view text) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : text) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  for (std::string& field : fields)
    field = std::string(trimmed(field));
  while (!fields.empty() && fields.back().empty())
    fields.pop_back();
  return fields;
}

/// A keyword or parameter as both programs take it: in capitals, without blanks.
std::string word_of(std::string_view text) {
  std::string word = in_capitals(text);
  std::erase_if(word, [](char c) { return is_blank(c); });
  return word;
}

} // namespace

std::string DeckKeyword::value(const char* parameter) const {
  const auto found = parameters.find(parameter);
  return found == parameters.end() ? std::string() : found->second;
}

std::string DeckKeyword::word(const char* parameter) const { return word_of(value(parameter)); }

std::string DeckKeyword::field(std::size_t line, std::size_t i) const {
  return line < data.size() && i < data[line].size() ? data[line][i] : std::string();
}

std::optional<double> DeckKeyword::number(std::size_t line, std::size_t i) const {
  const std::string text = field(line, i);
  if (text.empty())
    return std::nullopt;
  double value = 0.0;
  if (!parse_real(text, value))
    throw Error(Fault::geometry, places[line],
                fmt::format("\"{}\" is not a number", text.substr(0, 30)));
  return value;
}

std::int64_t DeckKeyword::whole(std::size_t line, std::size_t i) const {
  std::int64_t value = 0;
  if (!parse_integer(field(line, i), value))
    throw Error(Fault::geometry, places[line],
                fmt::format("\"{}\" is not a whole number", field(line, i).substr(0, 30)));
  return value;
}

bool DeckLines::next_line() {
  if (has_line_) {
    has_line_ = false;
    return true;
  }
  while (lines_.next())
    if (!lines_.line().empty() && !lines_.line().starts_with("**"))
      return true;
  return false;
}

DeckKeyword DeckLines::keyword_of_line() {
  DeckKeyword keyword;
  keyword.place = lines_.place();
  std::string text(lines_.line().substr(1));
  while (text.ends_with(',') && next_line()) {
    if (lines_.line().front() == '*') { // a comma too many
      has_line_ = true;
      break;
    }
    text += lines_.line();
  }
  for (const std::string& part : fields_of_line(text)) {
    const std::size_t equals = part.find('=');
    const std::string key = word_of(std::string_view(part).substr(0, equals));
    if (keyword.name.empty()) {
      constexpr std::size_t longest = 60; // to be shown in a message
      keyword.name = key;
      keyword.written =
          std::string(trimmed(std::string_view(part).substr(0, equals))).substr(0, longest);
    } else if (!key.empty())
      keyword.parameters[key] =
          equals == std::string::npos
              ? ""
              : std::string(trimmed(std::string_view(part).substr(equals + 1)));
  }
  return keyword;
}

std::optional<DeckKeyword> DeckLines::next() {
  if (!next_line())
    return std::nullopt;
  if (lines_.line().front() != '*')
    lines_.fail("a keyword such as *NODE is expected before the first data");
  DeckKeyword keyword = keyword_of_line();
  if (keyword.has("INPUT")) {
    lines_.include(keyword.value("INPUT"));
    if (keyword.name == "INCLUDE")
      return next();
  }
  while (next_line()) {
    if (lines_.line().front() == '*') {
      const DeckKeyword inner =
          lines_.line().size() > 8 && in_capitals(lines_.line().substr(0, 8)) == "*INCLUDE"
              ? keyword_of_line()
              : DeckKeyword{};
      if (inner.name != "INCLUDE") {
        has_line_ = true;
        break;
      }
      lines_.include(inner.value("INPUT"));
      continue;
    }
    keyword.data.push_back(fields_of_line(lines_.line()));
    keyword.places.push_back(lines_.place());
  }
  return keyword;
}

} // namespace billet::io
