#include "app/render/options.h"

#include "geometry/base/error.h"
#include "io/text/home_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

namespace billet::render {

namespace {

[[noreturn]] void fail(const std::string& message) {
  throw Error(Fault::usage, "", message, "billet-render --help lists what can be asked for");
}

double number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail(fmt::format("\"{}\" is not a number", text));
  return value;
}

/// Parts of a text between separators.
std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::array<double, 2> pair(const std::string& text, char separator) {
  const std::vector<std::string> parts = split(text, separator);
  if (parts.size() != 2)
    fail(fmt::format("\"{}\" should be two numbers with '{}' between", text, separator));
  return {number(parts[0]), number(parts[1])};
}

int count(const std::string& text) {
  const double value = number(text);
  constexpr double most = 1000.0;
  if (!(value >= 1.0 && value <= most) || value != std::floor(value))
    fail(fmt::format("\"{}\" is not a number of lines from 1 to {}", text, most));
  return static_cast<int>(value);
}

std::array<int, 2> size_of(const std::string& text) {
  const std::array<double, 2> size = pair(text, 'x');
  for (const double length : size)
    if (!(length >= 16.0 && length <= 16384.0))
      fail(fmt::format("a picture of {} pixels cannot be drawn: each side has 16 to 16384", text));
  return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

Series series(const std::string& text, bool points) {
  std::vector<std::string> parts = split(text, ':');
  if (parts.size() < 3 || parts.size() > 4)
    fail(fmt::format("\"{}\" should be FILE.csv:X-COLUMN:Y-COLUMN[:LABEL]", text));
  if (parts.size() == 3)
    parts.push_back(parts[2]);
  return {parts[0], parts[1], parts[2], parts[3], points};
}

using Setter = std::function<void(Options&, const std::string&)>;

/// Options that take a value.
const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> table{
      {"--field", [](Options& options, const std::string& value) { options.field = value; }},
      {"--flow-lines",
       [](Options& options, const std::string& value) { options.flow_lines = count(value); }},
      {"--output",
       [](Options& options, const std::string& value) {
         options.output = io::with_home_folder(value, "--output");
       }},
      {"--points", [](Options& options,
                      const std::string& value) { options.series.push_back(series(value, true)); }},
      {"--range",
       [](Options& options, const std::string& value) { options.range = pair(value, ':'); }},
      {"--size", [](Options& options, const std::string& value) { options.size = size_of(value); }},
      {"--time",
       [](Options& options, const std::string& value) {
         options.time = value == "last" ? std::optional<double>() : number(value);
       }},
      {"--title", [](Options& options, const std::string& value) { options.title = value; }},
      {"--x-label", [](Options& options, const std::string& value) { options.x_label = value; }},
      {"--y-label", [](Options& options, const std::string& value) { options.y_label = value; }},
  };
  return table;
}

void check(const Options& options) {
  if (options.curves && options.flow_lines)
    fail("--flow-lines belongs to a scene");
  if (!options.curves && !options.series.empty())
    fail("--points belongs to --curve");
  if (options.results.empty() && options.series.empty())
    fail(options.curves ? "a chart needs results or a series" : "no results are given");
  if (!options.results.empty() && !options.series.empty())
    fail("a chart is of results or of series, not of both");
  if (options.output && options.output->empty())
    fail("--output needs the name of a file");
  if (const auto file = picture_file(options); file.extension() != ".png")
    fail(fmt::format("the picture \"{}\" should have the suffix .png", file.string()));
}

/// Words that are neither options nor their values.
void take(Options& options, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    const bool is_there = std::filesystem::exists(word);
    if (options.curves && !is_there && word.find(':') != std::string::npos)
      options.series.push_back(series(word, false));
    else if (options.curves && !options.output && word.ends_with(".png"))
      options.output = io::with_home_folder(word, "--curve");
    else if (options.results.empty())
      options.results = io::with_home_folder(word, "RESULTS");
    else
      fail(fmt::format("\"{}\" is one argument too many", word));
  }
}

/// Text that may stand in the name of a file.
std::string as_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ':' || c == '/'; }, '_');
  return text;
}

} // namespace

std::string usage() {
  return "billet-render RESULTS [options]      draws a frame of the results (folder, .pvd or "
         ".vtu)\n"
         "  --field NAME[:COMPONENT]           coloured by (von_mises); a component is x, y, z or "
         "xx,\n"
         "                                     yy, zz, xy, yz, xz; without: the length of a "
         "vector\n"
         "  --time T|last                      the frame nearest to this time (last)\n"
         "  --range LOW:HIGH                   of the colours (2nd to 98th percentile of the "
         "frame)\n"
         "  --flow-lines N                     instead of the mesh N + N lines that were straight\n"
         "                                     before the run (scenes of the plane)\n"
         "  --mirror, --no-mirror              both halves (in axisymmetric scenes)\n"
         "billet-render RESULTS --curve        draws the force on each tool over its stroke\n"
         "billet-render --curve SERIES...      draws columns of tables\n"
         "  SERIES                             FILE.csv:X-COLUMN:Y-COLUMN[:LABEL]; -COLUMN turns "
         "the sign\n"
         "  --points SERIES                    the same, as markers\n"
         "  --x-label TEXT, --y-label TEXT\n"
         "  --tight                            axes as long as the curves (from zero)\n"
         "all:\n"
         "  -o, --output FILE.png              (in the results, FIELD.png or load-stroke.png)\n"
         "  --size WxH                         pixels (1200x900)\n"
         "  --title TEXT\n";
}

std::filesystem::path picture_file(const Options& options) {
  if (options.output && !std::filesystem::is_directory(*options.output))
    return *options.output;
  const std::filesystem::path given =
      options.series.empty() ? options.results : options.series.front().file;
  const std::filesystem::path folder = options.output                         ? *options.output
                                       : std::filesystem::is_directory(given) ? given
                                                                              : given.parent_path();
  if (options.curves)
    return folder / (options.series.empty() ? "load-stroke.png" : "curves.png");
  const std::string time = options.time ? fmt::format("-{:.6g}", *options.time) : "";
  return folder / (as_name(options.field) + time + ".png");
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  std::vector<std::string> words;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const std::size_t equals = argument.starts_with("--") ? argument.find('=') : std::string::npos;
    const std::string name = argument == "-o" ? "--output" : argument.substr(0, equals);
    if (const auto setter = setters().find(name); setter != setters().end()) {
      if (equals == std::string::npos && i + 1 == arguments.size())
        fail(fmt::format("{} needs a value", argument));
      setter->second(options,
                     equals == std::string::npos ? arguments[++i] : argument.substr(equals + 1));
    } else if (argument == "--help" || argument == "-h") {
      options.help = true;
    } else if (argument == "--curve") {
      options.curves = true;
    } else if (argument == "--tight") {
      options.tight = true;
    } else if (argument == "--mirror" || argument == "--no-mirror") {
      options.mirror = argument == "--mirror";
    } else if (argument.size() > 1 && argument.starts_with('-')) {
      fail(fmt::format("the option {} is not known", argument));
    } else {
      words.push_back(argument);
    }
  }
  if (options.help)
    return options;
  take(options, words);
  check(options);
  return options;
}

} // namespace billet::render
