#include "app/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace billet::report {

namespace {

/// How many bytes a character of UTF-8 has that begins a text; 0: none does.
std::size_t length_of_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80                     ? 1
                             : first >= 0xC2 && first <= 0xDF ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || length > text.size())
    return 0;
  for (const char c : text.substr(1, length - 1))
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U)
      return 0;
  return length;
}

/// What is no UTF-8, as names of files may be, shown as such.
std::string readable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    result += length > 0 ? text.substr(0, length) : "\xEF\xBF\xBD"; // the sign for it
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return result;
}

} // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : readable(text))
    switch (c) {
    case '&':
      html += "&amp;";
      break;
    case '<':
      html += "&lt;";
      break;
    case '>':
      html += "&gt;";
      break;
    case '"':
      html += "&quot;";
      break;
    default:
      html += c;
    }
  return html;
}

std::string number(double value) {
  if (!std::isfinite(value))
    return "–";
  const double size = std::abs(value);
  return size >= 1e5 && size < 1e9 ? fmt::format("{:.0f}", value) : fmt::format("{:.5g}", value);
}

std::string section(std::string_view id, std::string_view title, const std::string& content) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escaped(title),
                     content);
}

std::string facts(const Facts& rows) {
  std::string html = "<table class=\"facts\">\n";
  for (const auto& [what, value] : rows)
    html += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", what, value);
  return html + "</table>\n";
}

std::string table(const std::vector<std::string>& headings,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"wide\"><table class=\"figures\">\n<thead><tr>";
  for (const std::string& heading : headings)
    html += fmt::format("<th>{}</th>", heading);
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row)
      html += fmt::format("<td>{}</td>", cell);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string list(const std::vector<std::string>& lines) {
  if (lines.empty())
    return {};
  std::string html = "<ul>\n";
  for (const std::string& line : lines)
    html += fmt::format("<li>{}</li>\n", escaped(line));
  return html + "</ul>\n";
}

std::string folded(std::string_view title, const std::string& content, bool open) {
  return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", open ? " open" : "",
                     escaped(title), content);
}

} // namespace billet::report
