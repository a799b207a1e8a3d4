#include "app/render/options.h"

#include "app/render/option_values.h"
#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/text/home_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

namespace billet::render {

namespace {

using Setter = std::function<void(Options&, const std::string&)>;

/// Options of a scene that take a value.
std::map<std::string, Setter> scene_setters() {
  using S = const std::string&;
  return {
      {"--arrows", [](Options& o, S text) { o.scene.arrows = field_name(text); }},
      {"--arrow-scale",
       [](Options& o, S text) { o.scene.arrow_scale = positive(text, "a scale"); }},
      {"--bands", [](Options& o, S text) { o.scene.bands = count(text, 2, 64, "colours"); }},
      {"--compare",
       [](Options& o, S text) { o.scene.compare = io::with_home_folder(text, "--compare"); }},
      {"--copies", [](Options& o, S text) { o.scene.copies = count(text, 2, 360, "copies"); }},
      {"--cut", [](Options& o, S text) { o.scene.cuts.push_back(cut(text)); }},
      {"--field", [](Options& o, S text) { o.scene.field = field_name(text); }},
      {"--flow-lines",
       [](Options& o, S text) { o.scene.flow_lines = count(text, 1, 1000, "lines"); }},
      {"--focus", [](Options& o, S text) { o.scene.view.focus = place(text); }},
      {"--fps", [](Options& o, S text) { o.film.fps = positive(text, "a rate"); }},
      {"--frames", [](Options& o, S text) { o.film.slice = slice(text); }},
      {"--on", [](Options& o, S text) { o.scene.on = place_of_field(text); }},
      {"--range", [](Options& o, S text) { o.scene.range = pair(text, ':'); }},
      {"--time", [](Options& o, S text) { o.scene.times = times(text); }},
      {"--times", [](Options& o, S text) { o.scene.times = times(text); }},
      {"--tools", [](Options& o, S text) { o.scene.tools = tool_style(text); }},
      {"--up", [](Options& o, S text) { o.scene.view.up = axis(text); }},
      {"--view", [](Options& o, S text) { take_direction(o.scene.view, text); }},
      {"--zoom", [](Options& o, S text) { o.scene.view.zoom = positive(text, "a zoom"); }},
  };
}

/// Options that take a value.
const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> table = [] {
    using S = const std::string&;
    std::map<std::string, Setter> all = scene_setters();
    all["--output"] = [](Options& o, S text) { o.output = io::with_home_folder(text, "--output"); };
    all["--points"] = [](Options& o, S text) { o.chart.series.push_back(series(text, true)); };
    all["--size"] = [](Options& o, S text) { o.size_asked = picture_size(text); };
    all["--title"] = [](Options& o, S text) { o.title = text; };
    all["--x-label"] = [](Options& o, S text) { o.chart.x_label = text; };
    all["--y-label"] = [](Options& o, S text) { o.chart.y_label = text; };
    return all;
  }();
  return table;
}

using Switch = std::function<void(Options&)>;

/// Options that stand alone.
const std::map<std::string, Switch>& switches() {
  static const std::map<std::string, Switch> table{
      {"--animate", [](Options& o) { o.film.wanted = true; }},
      {"--curve", [](Options& o) { o.chart.wanted = true; }},
      {"--help", [](Options& o) { o.help = true; }},
      {"-h", [](Options& o) { o.help = true; }},
      {"--mesh", [](Options& o) { o.scene.mesh = true; }},
      {"--no-mesh", [](Options& o) { o.scene.mesh = false; }},
      {"--mirror",
       [](Options& o) {
         o.scene.mirror = {Mirror::Planes::known, {}, {}};
       }},
      {"--no-mirror",
       [](Options& o) {
         o.scene.mirror = {Mirror::Planes::none, {}, {}};
       }},
      {"--revolve", [](Options& o) { o.scene.revolve = 270.0; }},
      {"--tight", [](Options& o) { o.chart.tight = true; }},
      {"--log-x", [](Options& o) { o.chart.logarithmic[0] = true; }},
      {"--log-y", [](Options& o) { o.chart.logarithmic[1] = true; }},
  };
  return table;
}

double angle(const std::string& text) {
  const double value = number(text);
  if (!(value >= 1.0 && value <= 360.0))
    fail_usage(fmt::format("--revolve {} should be from 1 to 360 degrees", text));
  return value;
}

/// Values of options that may do without.
const std::map<std::string, Setter>& optional_values() {
  using S = const std::string&;
  static const std::map<std::string, Setter> table{
      {"--mirror", [](Options& o, S text) { o.scene.mirror = mirror(text); }},
      {"--revolve", [](Options& o, S text) { o.scene.revolve = angle(text); }},
      {"--curve",
       [](Options& o, S text) {
         o.chart.wanted = true;
         o.chart.columns.push_back(columns(text));
       }},
  };
  return table;
}

/// Whether the word after an option that may do without a value is one.
bool is_value_of(const std::string& option, const std::string& word) {
  if (word.empty() || std::filesystem::exists(word))
    return false;
  if (option == "--mirror")
    return word.find('=') == 1 || word.find_first_not_of("xyz,") == std::string::npos;
  if (option == "--revolve")
    return word.find_first_not_of("0123456789.") == std::string::npos;
  return option == "--curve" && std::count(word.begin(), word.end(), ':') == 1;
}

[[noreturn]] void unknown_option(const std::string& name) {
  std::vector<std::string> known{"--output"};
  for (const auto& [option, setter] : setters())
    known.push_back(option);
  for (const auto& [option, setter] : switches())
    known.push_back(option);
  const std::string near = io::suggestion(name, known);
  throw Error(
      Fault::usage, "", fmt::format("the option {} is not known", name),
      near.starts_with("did you mean") ? near : "billet render --help lists what can be asked for");
}

/// Lets an option take its value; what it says against it names the option.
void take_value(const std::string& name,
                const Setter& setter,
                Options& options,
                const std::string& value) {
  try {
    setter(options, value);
  } catch (const Error& error) {
    std::vector<Complaint> complaints = error.complaints();
    for (Complaint& one : complaints)
      if (one.place.empty() && one.message.find(name) == std::string::npos)
        one.message = fmt::format("{}: {}", name, one.message);
    throw Error(error.fault(), std::move(complaints));
  }
}

/// Whether a picture's name is that of a film.
bool names_film(const std::filesystem::path& file) {
  return file.extension() == ".gif" || file.extension() == ".mp4" ||
         file.filename().string().find('%') != std::string::npos;
}

void check_chart(const Options& options) {
  const ChartOptions& chart = options.chart;
  if (options.film.wanted)
    fail_usage("--animate belongs to a scene");
  if (options.scene.flow_lines)
    fail_usage("--flow-lines belongs to a scene");
  if (options.results.empty() && chart.series.empty())
    fail_usage("a chart needs results or a series");
  if (!options.results.empty() && !chart.series.empty() && chart.columns.empty())
    fail_usage("a chart is of results or of series, not of both");
  if (options.results.empty() && !chart.columns.empty())
    fail_usage("columns of history.csv need results");
}

void check_scene(const Options& options) {
  const SceneOptions& scene = options.scene;
  if (!options.chart.series.empty())
    fail_usage("--points belongs to --curve");
  if (options.results.empty())
    fail_usage("no results are given");
  if (options.results.size() > 1)
    throw Error(Fault::usage, "",
                fmt::format("\"{}\" is one argument too many", options.results[1].string()),
                "billet render RESULTS --compare OTHER draws two next to each other");
  if (options.film.wanted && !scene.times.empty())
    fail_usage("--animate shows all frames: --time is not for films, --frames chooses");
  if (!options.film.wanted && (options.film.slice || options.film.fps))
    fail_usage("--frames and --fps are of films: --animate makes one, --time T draws one frame");
  if (scene.times.size() > 1 && scene.compare)
    fail_usage("--compare takes one --time");
  if (scene.range && !(scene.range->at(0) < scene.range->at(1)))
    fail_usage("--range LOW:HIGH needs a low value below the high one");
}

void check(const Options& options) {
  if (options.chart.wanted)
    check_chart(options);
  else
    check_scene(options);
  if (options.output && options.output->empty())
    fail_usage("--output needs the name of a file");
  const std::filesystem::path file = picture_file(options);
  if (options.film.wanted) {
    if (!names_film(file))
      fail_usage(fmt::format("the film \"{}\" should have the suffix .gif or .mp4, or be a series "
                             "such as film_%04d.png",
                             file.string()));
  } else if (file.extension() != ".png") {
    fail_usage(fmt::format("the picture \"{}\" should have the suffix .png", file.string()));
  }
}

/// Words that are neither options nor their values.
void take(Options& options, const std::vector<std::string>& words) {
  ChartOptions& chart = options.chart;
  for (const std::string& word : words) {
    const auto colons =
        std::filesystem::exists(word) ? 0 : std::count(word.begin(), word.end(), ':');
    if (chart.wanted && colons == 1)
      chart.columns.push_back(columns(word));
    else if (chart.wanted && colons > 1)
      chart.series.push_back(series(word, false));
    else if (chart.wanted && !options.output && word.ends_with(".png"))
      options.output = io::with_home_folder(word, "--curve");
    else
      options.results.push_back(io::with_home_folder(word, "RESULTS"));
  }
}

/// Text that may stand in the name of a file.
std::string as_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ':' || c == '/'; }, '_');
  return text;
}

std::string picture_name(const Options& options) {
  if (options.chart.wanted)
    return !options.chart.series.empty()    ? "curves.png"
           : !options.chart.columns.empty() ? "history.png"
                                            : "load-stroke.png";
  std::string name = as_name(options.scene.field);
  if (options.film.wanted)
    return name + ".gif";
  for (const AskedTime& time : options.scene.times)
    if (time)
      name += fmt::format("-{:.6g}", *time);
    else if (options.scene.times.size() > 1)
      name += "-last";
  return name + ".png";
}

} // namespace

std::array<int, 2> Options::size() const {
  if (size_asked)
    return *size_asked;
  return film.wanted && picture_file(*this).extension() == ".gif" ? std::array{800, 600}
                                                                  : std::array{1200, 900};
}

std::filesystem::path picture_file(const Options& options) {
  if (options.output && !std::filesystem::is_directory(*options.output))
    return *options.output;
  const std::filesystem::path given =
      options.results.empty() ? options.chart.series.front().file : options.results.front();
  const std::filesystem::path folder = options.output                         ? *options.output
                                       : std::filesystem::is_directory(given) ? given
                                                                              : given.parent_path();
  return folder / picture_name(options);
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  std::vector<std::string> words;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const std::size_t equals = argument.starts_with("--") ? argument.find('=') : std::string::npos;
    const bool joined = equals != std::string::npos;
    const std::string name = argument == "-o" ? "--output" : argument.substr(0, equals);
    if (const auto setter = setters().find(name); setter != setters().end()) {
      if (!joined && i + 1 == arguments.size())
        fail_usage(fmt::format("{} needs a value", argument));
      take_value(name, setter->second, options,
                 joined ? argument.substr(equals + 1) : arguments[++i]);
    } else if (const auto value = optional_values().find(name);
               value != optional_values().end() &&
               (joined || (i + 1 < arguments.size() && is_value_of(name, arguments[i + 1])))) {
      take_value(name, value->second, options,
                 joined ? argument.substr(equals + 1) : arguments[++i]);
      if (name == "--curve")
        options.chart.wanted = true;
    } else if (const auto change = switches().find(argument); change != switches().end()) {
      change->second(options);
    } else if (joined && switches().contains(name)) {
      fail_usage(fmt::format("{} takes no value: leave out \"{}\"", name, argument.substr(equals)));
    } else if (argument.size() > 1 && argument.starts_with('-')) {
      unknown_option(name);
    } else {
      words.push_back(argument);
    }
  }
  if (options.help)
    return options;
  take(options, words);
  if (!options.chart.wanted && options.output && names_film(*options.output))
    options.film.wanted = true;
  check(options);
  return options;
}

} // namespace billet::render
