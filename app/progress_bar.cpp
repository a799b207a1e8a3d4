#include "app/progress_bar.h"

#include "io/text/readable.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace billet::app {

namespace {

std::string bar(double share) {
  constexpr int width = 20;
  const int full = static_cast<int>(share * width);
  return fmt::format("[{:<{}}]", std::string(static_cast<std::size_t>(full), '='), width);
}

std::string measured(double value, const std::string& unit) {
  const io::Readable readable = io::readable(value, unit);
  return fmt::format("{:.4g} {}", value * readable.factor, readable.unit);
}

/// "  punch 1.58 mm 152 kN"
std::string load_of_a_tool(const process::Run& run, double time, const io::UnitSystem& units) {
  const std::span<const contact::Tool> tools = run.tools();
  if (tools.empty() || run.contact() == nullptr)
    return "";
  const auto stroke = [&](std::size_t t) {
    return tools[t].motion.translation(time, run.driven(t)).norm();
  };
  std::size_t shown = 0;
  while (shown < tools.size() && stroke(shown) == 0.0)
    ++shown;
  const bool travels = shown < tools.size();
  shown = travels ? shown : 0;
  const std::string way = travels ? fmt::format(" {}", measured(stroke(shown), units.length)) : "";
  return fmt::format("  {}{} {}", tools[shown].name, way,
                     measured(run.contact()->loads()[shown].force.norm(), units.force));
}

} // namespace

std::string progress_bar(const process::Run& run,
                         const process::IncrementReport& report,
                         const io::UnitSystem& units,
                         int columns) {
  const double share = std::clamp(report.time / run.scene.stages.back().end, 0.0, 1.0);
  std::string line = fmt::format("{} {:3.0f} %  increment {}{}", bar(share), 100.0 * share,
                                 report.increment, load_of_a_tool(run, report.time, units));
  if (share > 0.0 && share < 1.0)
    line += fmt::format("  {} left", duration(report.wall_time * (1.0 - share) / share));
  return line.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
}

std::string duration(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  if (seconds < minute)
    return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < hour)
    return fmt::format("{:.0f} min", std::ceil(seconds / minute));
  const double minutes = std::ceil(seconds / minute);
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(minutes / minute),
                     std::fmod(minutes, minute));
}

int terminal_columns(int stream) {
  constexpr int usual = 80;
  winsize size{};
  const bool told = ::ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return told ? size.ws_col : usual;
}

} // namespace billet::app
