#include "app/watch_text.h"

#include "io/text/readable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace billet::app {

namespace {

using report::column;
using report::ResultsFolder;
using report::RunState;

double last_of(const ResultsFolder& results, std::string_view name) {
  const std::vector<double> values = column(results.history, name);
  return values.empty() ? 0.0 : values.back();
}

std::string readable_number(double value, const std::string& unit) {
  const io::Readable readable = io::readable(value, unit);
  return fmt::format("{:.4g} {}", value * readable.factor, readable.unit);
}

/// Magnitudes of the vectors in three columns.
std::vector<double> magnitudes(const ResultsFolder& results, const std::string& stem) {
  const std::vector<double> x = column(results.history, stem + "_x"),
                            y = column(results.history, stem + "_y"),
                            z = column(results.history, stem + "_z");
  std::vector<double> lengths;
  for (std::size_t i = 0; i < std::min({x.size(), y.size(), z.size()}); ++i)
    lengths.push_back(Vec3(x[i], y[i], z[i]).norm());
  return lengths;
}

double share_of(const ResultsFolder& results) {
  const std::optional<double> end = results.facts.end;
  return end && *end > 0.0 ? std::clamp(last_of(results, "time") / *end, 0.0, 1.0) : 0.0;
}

std::string progress_line(const ResultsFolder& results) {
  const double share = share_of(results);
  constexpr int width = 24;
  std::string line = fmt::format("[{:<{}}] {:3.0f} %  time {:.5g}",
                                 std::string(static_cast<std::size_t>(share * width), '='), width,
                                 100.0 * share, last_of(results, "time"));
  if (const std::optional<double> end = results.facts.end)
    line += fmt::format(" of {:.5g}", *end);
  line += fmt::format(" {}  {} {}", results.units().time,
                      results.state == RunState::running ? "running for" : "ran for",
                      duration(last_of(results, "wall_time")));
  if (const std::optional<double> left = time_left(results))
    line += fmt::format("  {} left", duration(*left));
  return line + "\n";
}

std::string increment_lines(const ResultsFolder& results) {
  const io::UnitSystem& units = results.units();
  std::string text =
      fmt::format("increment {:.0f}  dt {:.3g} {}  iterations {:.0f}  residual {:.1e}",
                  last_of(results, "increment"), last_of(results, "dt"), units.time,
                  last_of(results, "iterations"), last_of(results, "residual"));
  if (const double cuts = last_of(results, "cutbacks"); cuts > 0.0)
    text += fmt::format("  after {:.0f} cut-back(s)", cuts);
  text += fmt::format("\npenetration {:.3g} {}  plastic strain {:.3g}  element quality {:.2f}",
                      last_of(results, "max_penetration"), units.length,
                      last_of(results, "max_plastic_strain"), last_of(results, "min_quality"));
  if (const double meshes = last_of(results, "remeshings"); meshes > 0.0)
    text += fmt::format("  new meshes {:.0f}", meshes);
  return text + "\n";
}

std::string tool_lines(const ResultsFolder& results, int columns) {
  const io::UnitSystem& units = results.units();
  const std::vector<std::string> tools = results.tools();
  std::size_t name_width = 0;
  for (const std::string& tool : tools)
    name_width = std::max(name_width, tool.size());
  constexpr int figures = 42, least = 8, most = 60;
  const auto width = static_cast<std::size_t>(
      std::clamp(columns - figures - static_cast<int>(name_width), least, most));
  std::string text;
  for (const std::string& tool : tools) {
    const std::vector<double> forces = magnitudes(results, tool + ".force");
    const std::vector<double> ways = magnitudes(results, tool + ".displacement");
    if (forces.empty())
      continue;
    text += fmt::format("{:<{}}  {}  {}", tool, name_width, text_curve(forces, width),
                        results.of_whole(readable_number(forces.back(), units.force)));
    if (!ways.empty() && ways.back() > 0.0)
      text += fmt::format("  stroke {}", readable_number(ways.back(), units.length));
    text += "\n";
  }
  return text;
}

std::string warning_lines(const ResultsFolder& results) {
  constexpr std::size_t most = 4;
  const std::vector<std::string> warnings = results.said("warning: ");
  std::string text;
  if (warnings.size() > most)
    text += fmt::format("{} warnings, the last of them:\n", warnings.size());
  for (std::size_t i = warnings.size() - std::min(most, warnings.size()); i < warnings.size(); ++i)
    text += "warning: " + warnings[i] + "\n";
  for (const std::string& check : results.said("failed check "))
    text += "failed check " + check + "\n";
  if (results.summary.contains("failure"))
    text += fmt::format("failure: {}\n", results.summary["failure"].value("reason", ""));
  return text;
}

std::string status_line(const ResultsFolder& results) {
  std::string line = results.title + ": " + results.status();
  if (results.state == RunState::running)
    line += fmt::format(" (process {} on {})", results.writer->process, results.writer->machine);
  else if (results.state == RunState::killed)
    line += " before its end";
  else if (const std::string by = results.summary.value("ended_by", ""); results.exit_status() == 0)
    line += ", " + by;
  return line + "\n";
}

/// A terminal's line must not wrap: what is written over is counted in lines. The blocks of curves
/// are three bytes of one column.
std::string cut(const std::string& text, int columns) {
  const auto is_first_byte = [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
  };
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    if (std::count_if(line.begin(), line.end(), is_first_byte) >= columns) {
      std::size_t at = 0;
      for (int column = 0; at < line.size(); ++at)
        if (is_first_byte(line[at]) && ++column == columns - 1)
          break;
      line = line.substr(0, at) + "…";
    }
    result += line;
    if (end < text.size())
      result += '\n';
    begin = end + 1;
  }
  return result;
}

} // namespace

std::string text_curve(std::span<const double> values, std::size_t width) {
  static constexpr std::array<const char*, 9> blocks{" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value))
      largest = std::max(largest, std::abs(value));
  std::string curve;
  for (std::size_t i = 0; i < width && !values.empty(); ++i) {
    const double value =
        std::abs(values[std::min((i + 1) * values.size() / width, values.size() - 1)]);
    const double share = largest > 0.0 && std::isfinite(value) ? value / largest : 0.0;
    curve += blocks.at(static_cast<std::size_t>(std::lround(8.0 * share)));
  }
  return curve;
}

std::optional<double> time_left(const ResultsFolder& results) {
  const std::vector<double> times = column(results.history, "time");
  const std::vector<double> walls = column(results.history, "wall_time");
  const std::optional<double> end = results.facts.end;
  if (!end || times.size() < 2 || walls.size() != times.size() ||
      results.state != RunState::running)
    return std::nullopt;
  const std::size_t middle = times.size() / 2;
  const double pace = (times.back() - times[middle]) / (walls.back() - walls[middle]);
  if (!(pace > 0.0) || !std::isfinite(pace))
    return std::nullopt;
  return std::max(*end - times.back(), 0.0) / pace;
}

std::string watch_text(const ResultsFolder& results, int columns) {
  std::string text = status_line(results);
  if (results.history.rows.empty())
    text += "no increment has been solved so far\n";
  else
    text += progress_line(results) + increment_lines(results) + tool_lines(results, columns);
  return cut(text + warning_lines(results), columns);
}

std::string watch_line(const ResultsFolder& results) {
  if (results.history.rows.empty())
    return results.title + ": no increment has been solved so far";
  std::string line = fmt::format(
      "{:3.0f} %  time {:.5g} {}  increment {:.0f}  iterations {:.0f}  residual {:.1e}",
      100.0 * share_of(results), last_of(results, "time"), results.units().time,
      last_of(results, "increment"), last_of(results, "iterations"), last_of(results, "residual"));
  for (const std::string& tool : results.tools())
    if (const std::vector<double> forces = magnitudes(results, tool + ".force"); !forces.empty())
      line += fmt::format("  {} {}", tool,
                          results.of_whole(readable_number(forces.back(), results.units().force)));
  if (const std::optional<double> left = time_left(results))
    line += fmt::format("  {} left", duration(*left));
  return line;
}

} // namespace billet::app
