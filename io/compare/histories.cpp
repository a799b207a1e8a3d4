// Two tables of a run's increments: each column as a function of time.

#include "geometry/base/error.h"
#include "io/compare/compare_parts.h"
#include "io/text/csv_table.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <map>
#include <set>

namespace billet::io {

namespace {

/// Columns that say how a run was made, not what came out.
constexpr std::array<std::string_view, 7> of_the_way{
    "increment", "dt", "iterations", "residual", "cutbacks", "remeshings", "wall_time"};

bool is_of_the_way(const std::string& column) {
  return column == "time" ||
         std::find(of_the_way.begin(), of_the_way.end(), column) != of_the_way.end();
}

/// A table with its times.
struct History {
  CsvTable table;
  std::vector<double> times;
};

History read_history(const std::filesystem::path& file) {
  History history{read_csv(file), {}};
  const auto time = history.table.find("time");
  if (!time)
    throw Error(Fault::input_output, file.string(), "has no column 'time'",
                "it was not written by this program", error_code::results_unreadable);
  history.times = history.table.numbers(*time);
  return history;
}

/// A column between its points; times increase.
double value_at(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const auto above = std::lower_bound(times.begin(), times.end(), time);
  const auto i = static_cast<std::size_t>(above - times.begin());
  if (i == times.size() || i == 0 || times[i] == time)
    return values[std::min(i, times.size() - 1)];
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

/// All times of both that lie within both.
std::vector<double> common_times(const History& first, const History& second) {
  std::vector<double> times;
  if (first.times.empty() || second.times.empty())
    return times;
  std::set_union(first.times.begin(), first.times.end(), second.times.begin(), second.times.end(),
                 std::back_inserter(times));
  const double from = std::max(first.times.front(), second.times.front());
  const double to = std::min(first.times.back(), second.times.back());
  std::erase_if(times, [&](double time) { return time < from || time > to; });
  return times;
}

/// "punch.force" of "punch.force_y": components of a vector share their scale.
std::string vector_of(const std::string& column) {
  const std::size_t end = column.size();
  const bool is_component = end > 2 && column[end - 2] == '_' &&
                            std::string_view("xyz").find(column.back()) != std::string_view::npos;
  return is_component ? column.substr(0, end - 2) : column;
}

void share_scales(std::vector<Difference>& differences) {
  std::map<std::string, double> scales;
  for (const Difference& one : differences)
    scales[vector_of(one.quantity)] = std::max(scales[vector_of(one.quantity)], one.scale);
  for (Difference& one : differences)
    one.scale = scales[vector_of(one.quantity)];
}

void note_times(const History& first,
                const History& second,
                const std::vector<double>& times,
                Comparison& into) {
  if (first.times == second.times)
    return;
  into.notes.push_back(
      fmt::format("history: {} and {} increments end at different times: both are taken as linear "
                  "in between, at {} times",
                  first.times.size(), second.times.size(), times.size()));
  const auto end = [](const History& one) { return one.times.empty() ? 0.0 : one.times.back(); };
  if (end(first) != end(second))
    into.quantities.push_back({"history: last time", "", number_text(end(first)),
                               number_text(end(second)), std::abs(end(first) - end(second)),
                               std::max(std::abs(end(first)), std::abs(end(second)))});
}

} // namespace

void compare_histories(const std::filesystem::path& first_file,
                       const std::filesystem::path& second_file,
                       Comparison& into) {
  const History first = read_history(first_file), second = read_history(second_file);
  const std::vector<double> times = common_times(first, second);
  std::set<std::string> columns;
  std::vector<std::string> in_order;
  for (const CsvTable* table : {&first.table, &second.table})
    for (const std::string& column : table->columns)
      if (!is_of_the_way(column) && columns.insert(column).second)
        in_order.push_back(column);
  std::vector<Difference> differences;
  for (const std::string& column : in_order) {
    const auto a = first.table.find(column), b = second.table.find(column);
    if (!a || !b) {
      differences.push_back(
          text_difference("history " + column, a ? "there" : "absent", b ? "there" : "absent"));
      continue;
    }
    const std::vector<double> of_first = first.table.numbers(*a),
                              of_second = second.table.numbers(*b);
    LargestDifference largest;
    for (const double time : times)
      largest.look_at(value_at(first.times, of_first, time),
                      value_at(second.times, of_second, time), fmt::format("t = {:.6g}", time));
    differences.push_back(largest.of("history " + column));
  }
  share_scales(differences);
  note_times(first, second, times, into);
  into.quantities.insert(into.quantities.end(), differences.begin(), differences.end());
}

} // namespace billet::io
