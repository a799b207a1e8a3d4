#include "study/verify/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace billet::study {

namespace {

/// The cells of a row, in the order of the table.
using Cells = std::array<std::string, 8>;

constexpr std::array<std::string_view, 8> headings{"problem",   "figure",    "value",  "reference",
                                                   "deviation", "tolerance", "result", "source"};

std::string with_unit(double number, const std::string& unit) {
  const std::string text = fmt::format("{:.7g}", number);
  return unit == "-" ? text : text + " " + unit;
}

/// A difference of figures, or what is allowed of one: of shares it is in points.
std::string difference_with_unit(double number, const std::string& unit) {
  return unit == "%"   ? fmt::format("{:.3g} points", number)
         : unit == "-" ? fmt::format("{:.3g}", number)
                       : fmt::format("{:.3g} {}", number, unit);
}

std::string share(double number) {
  const double percent = 100.0 * number;
  return percent == 0.0 || std::abs(percent) >= 1e-3 ? fmt::format("{:.3g} %", percent)
                                                     : fmt::format("{:.1e}", number);
}

std::string deviation_text(const Figure& figure) {
  const double off = deviation(figure);
  return figure.criterion == Criterion::absolute ? difference_with_unit(off, figure.unit)
                                                 : share(off);
}

std::string tolerance_text(const Figure& figure) {
  switch (figure.criterion) {
  case Criterion::relative:
    return "±" + share(figure.tolerance);
  case Criterion::absolute:
    return figure.tolerance == 0.0 ? "none"
                                   : "±" + difference_with_unit(figure.tolerance, figure.unit);
  case Criterion::at_most:
    return "at most +" + share(figure.tolerance);
  case Criterion::at_least:
    return "at least -" + share(figure.tolerance);
  }
  return "";
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<Cells> rows_of(const ProblemOutcome& outcome) {
  const std::string name(outcome.problem->name), source(outcome.problem->source);
  if (!outcome.failure.empty())
    return {
        {name, "cannot be run: " + one_line(outcome.failure), "", "", "", "", "FAILED", source}};
  std::vector<Cells> rows;
  for (const Figure& figure : outcome.figures)
    rows.push_back({name, figure.name, with_unit(figure.value, figure.unit),
                    with_unit(figure.reference, figure.unit), deviation_text(figure),
                    tolerance_text(figure), within_tolerance(figure) ? "ok" : "FAILED",
                    figure.source.empty() ? source : figure.source});
  return rows;
}

std::string markdown_cell(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '|' ? std::string("\\|") : std::string(1, c);
  return safe;
}

std::string html_cell(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '<'   ? std::string("&lt;")
            : c == '>' ? std::string("&gt;")
            : c == '&' ? std::string("&amp;")
                       : std::string(1, c);
  return safe;
}

constexpr std::string_view page_style = R"(
body { font-family: sans-serif; margin: 2em auto; max-width: 90em; color: #222; }
table { border-collapse: collapse; font-size: 0.9em; }
th, td { text-align: left; padding: 0.25em 0.7em; border-bottom: 1px solid #ddd; }
td.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
tr.failed { background: #fdd; }
tr.failed td.result { font-weight: bold; }
)";

} // namespace

VerifyCount count(std::span<const ProblemOutcome> outcomes) {
  VerifyCount sum;
  for (const ProblemOutcome& outcome : outcomes)
    for (const Cells& row : rows_of(outcome)) {
      ++sum.figures;
      sum.failed += row[6] == "ok" ? 0 : 1;
    }
  return sum;
}

std::string list_text(std::span<const Problem> problems) {
  std::string text;
  for (const Problem& problem : problems)
    text += fmt::format("{:24s} {} ({})\n", problem.name, problem.shows, problem.source);
  return text;
}

std::string markdown_head() {
  std::string text = "|", rule = "|";
  for (const std::string_view heading : headings) {
    text += fmt::format(" {} |", heading);
    rule += " --- |";
  }
  return text + "\n" + rule + "\n";
}

std::string markdown_rows(const ProblemOutcome& outcome) {
  std::string text;
  for (const Cells& row : rows_of(outcome)) {
    text += "|";
    for (const std::string& cell : row)
      text += fmt::format(" {} |", markdown_cell(cell));
    text += "\n";
  }
  return text;
}

std::string in_one_sentence(std::span<const ProblemOutcome> outcomes) {
  const VerifyCount sum = count(outcomes);
  double seconds = 0.0;
  for (const ProblemOutcome& outcome : outcomes)
    seconds += outcome.seconds;
  const std::string verdict = sum.failed == 0 ? "all are within their tolerances"
                                              : fmt::format("{} of them FAILED", sum.failed);
  return fmt::format("{} figures of {} problems, {}; {:.0f} s.", sum.figures, outcomes.size(),
                     verdict, seconds);
}

std::string markdown_text(std::span<const ProblemOutcome> outcomes, const std::string& version) {
  std::string text =
      fmt::format("# Verification of billet {}\n\n{}\n\n", version, in_one_sentence(outcomes)) +
      markdown_head();
  for (const ProblemOutcome& outcome : outcomes)
    text += markdown_rows(outcome);
  return text;
}

std::string html_text(std::span<const ProblemOutcome> outcomes, const std::string& version) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Verification "
      "of billet {0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>Verification of billet "
      "{0}</h1>\n<p>{2}</p>\n<table>\n<tr>",
      html_cell(version), page_style, html_cell(in_one_sentence(outcomes)));
  for (const std::string_view heading : headings)
    text += fmt::format("<th>{}</th>", heading);
  text += "</tr>\n";
  for (const ProblemOutcome& outcome : outcomes)
    for (const Cells& row : rows_of(outcome)) {
      text += row[6] == "ok" ? "<tr>" : "<tr class=\"failed\">";
      for (std::size_t i = 0; i < row.size(); ++i) {
        const std::string_view kind = i >= 2 && i <= 5 ? " class=\"number\""
                                      : i == 6         ? " class=\"result\""
                                                       : "";
        text += fmt::format("<td{}>{}</td>", kind, html_cell(row[i]));
      }
      text += "</tr>\n";
    }
  return text + "</table>\n</body>\n</html>\n";
}

} // namespace billet::study
