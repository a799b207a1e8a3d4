// billet diff: two results, or two case files, side by side.

#include "app/command_line.h"
#include "geometry/base/error.h"
#include "io/compare/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace billet::app {

namespace {

namespace fs = std::filesystem;

constexpr int differs = 1;
constexpr std::size_t most_rows = 40;

io::Comparison comparison_of(const fs::path& first, const fs::path& second) {
  for (const fs::path& path : {first, second})
    if (!fs::exists(path))
      throw Error(Fault::usage, path.string(), "no such file or folder", "", error_code::file);
  if (fs::is_directory(first) != fs::is_directory(second))
    throw Error(Fault::usage, "",
                fmt::format("one of '{}' and '{}' is a folder, the other is not", first.string(),
                            second.string()),
                "give two folders of results, or two case files");
  return fs::is_directory(first) ? io::compare_results(first, second)
                                 : io::compare_cases(first, second);
}

std::string cut(const std::string& text) {
  constexpr std::size_t longest = 24;
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

void print_table(const std::vector<io::Difference>& differences) {
  std::size_t width = 8;
  for (const io::Difference& one : differences)
    width = std::max(width, one.quantity.size());
  fmt::print("{:{}s}  {:>14s}  {:>14s}  {:>10s}  {:>10s}  {}\n", "quantity", width, "first",
             "second", "difference", "relative", "where");
  for (std::size_t i = 0; i < std::min(differences.size(), most_rows); ++i) {
    const io::Difference& one = differences[i];
    const bool has_size = std::isfinite(one.absolute);
    fmt::print("{:{}s}  {:>14s}  {:>14s}  {:>10s}  {:>10s}  {}\n", one.quantity, width,
               cut(one.first), cut(one.second), has_size ? fmt::format("{:.3g}", one.absolute) : "",
               has_size ? fmt::format("{:.3g}", one.relative()) : "", one.where);
  }
  if (differences.size() > most_rows)
    fmt::print("and {} more\n", differences.size() - most_rows);
}

} // namespace

int show_differences(const Arguments& arguments) {
  io::Comparison comparison;
  try {
    comparison = comparison_of(arguments.file, arguments.rest.front());
  } catch (const Error& error) { // trouble has one status, as that of diff
    throw Error(Fault::usage, error.complaints());
  }
  const io::Tolerance tolerance{arguments.rtol.value_or(io::Tolerance{}.relative),
                                arguments.atol.value_or(0.0)};
  std::vector<io::Difference> beyond;
  for (const io::Difference& one : comparison.quantities)
    if (!tolerance.admits(one))
      beyond.push_back(one);
  std::stable_sort(beyond.begin(), beyond.end(),
                   [](const auto& a, const auto& b) { return a.relative() > b.relative(); });
  for (const std::string& note : comparison.notes)
    fmt::print("note: {}\n", note);
  if (!beyond.empty())
    print_table(beyond);
  double largest = 0.0;
  for (const io::Difference& one : comparison.quantities)
    if (tolerance.admits(one))
      largest = std::max(largest, one.relative());
  fmt::print("{} of {} quantities differ by more than {:g} of their largest value{}; the others by "
             "{:.2g} at most\n",
             beyond.size(), comparison.quantities.size(), tolerance.relative,
             tolerance.absolute > 0.0 ? fmt::format(" and {:g}", tolerance.absolute) : "", largest);
  return beyond.empty() ? 0 : differs;
}

} // namespace billet::app
