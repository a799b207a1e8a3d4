#include "app/command_line.h"

#include "app/render/usage.h"
#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/text/home_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <span>

namespace billet::app {

namespace {

/// The first word of a text, which is taken from it with the blanks behind it.
std::string_view take_word(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return word;
}

/// An option as a line of the help has it: "--name VALUE   what it does", "-o, --output FILE  ...".
Option option_of_line(std::string_view line) {
  Option option{};
  option.name = take_word(line);
  if (option.name.ends_with(',')) {
    option.name.remove_suffix(1);
    option.also = take_word(line);
  }
  const auto is_value = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (!line.empty() && (is_value(line.front()) || line.front() == '['))
    option.value = take_word(line);
  option.help = line;
  return option;
}

/// Of `render`: the lines of its help that begin with an option.
std::vector<Option> render_options() {
  std::vector<Option> all;
  std::string_view rest = render::usage_text;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.starts_with("  -"))
      all.push_back(option_of_line(line.substr(2)));
  }
  return all;
}

/// Of `info`.
constexpr Option info_options[] = {
    {"--unit", "UNIT", "the unit of an STL's numbers: shown in mm"},
    {"--allow-outside", "", "the file may include files outside its folder"},
};

/// Of commands that read a case.
constexpr Option case_options[] = {
    {"--set", "KEY=VALUE", "overrides a key of the case, e.g. tool.punch.friction.m=0.2"},
    {"--allow-outside", "", "the case may name files outside its folder"},
};

/// Of `run` alone; `check` takes them, so that the same words may follow, and has no use for them.
constexpr Option run_options[] = {
    {"-o", "DIR", "results go to DIR (default: results/<case name>)", "--output"},
    {"--threads", "N", "threads for assembly and contact search (default: all)"},
    {"--quiet", "", "no progress on standard error, only warnings and errors"},
    {"--profile", "", "print where the time went"},
    {"--resume", "", "goes on from the last checkpoint in DIR"},
    {"--from", "RESULTS[@T]",
     "goes on from another run's checkpoint (of time T or before) into DIR"},
};

/// Of `identify`.
constexpr Option identify_options[] = {
    {"-o", "DIR", "identification.json goes to DIR", "--output"},
};

/// Of `report`.
constexpr Option report_options[] = {
    {"-o", "FILE.html", "the page (RESULTS/report.html)", "--output"},
    {"--follow", "", "as long as the run goes on: makes the page again, which reloads itself"},
    {"--quiet", "", "does not say which file it wrote"},
};

/// Of `watch`.
constexpr Option watch_options[] = {
    {"--once", "", "says how far the run is, and ends"},
};

/// Of `study` and `chart`.
constexpr Option study_options[] = {
    {"--set", "KEY=VALUE", "overrides a key of the file, e.g. run.engine=slurm"},
    {"-o", "DIR", "results go to DIR (default: results/<name>)", "--output"},
    {"--processes", "N", "runs at once (default: as many as the machine has cores for)"},
    {"--threads", "N", "threads of each run (default: 1)"},
    {"--again", "", "makes runs that failed again"},
    {"--quiet", "", "no progress on standard error"},
};

/// Of `verify`.
constexpr Option verify_options[] = {
    {"--list", "", "the names of the problems, what they show and their sources"},
    {"-o", "DIR", "verify.md, verify.html and the cases go to DIR", "--output"},
    {"--quiet", "", "no progress on standard error"},
};

/// Of `schema`.
constexpr Option schema_options[] = {
    {"-o", "FILE", "the schema goes to FILE (standard output)", "--output"},
};

/// Of `import`.
constexpr Option import_options[] = {
    {"-o", "DIR", "the case goes to DIR (default: the deck's name)", "--output"},
    {"--units", "UNITS", "of the deck's numbers: mm-t-s-N (default), m-kg-s-N or in-lbf-s-psi"},
    {"--allow-outside", "", "the deck may include files outside its folder"},
};

/// Of `diff`.
constexpr Option diff_options[] = {
    {"--rtol", "R", "a difference counts above R times the quantity's largest value (1e-6)"},
    {"--atol", "A", "... plus A, in the quantity's own unit (0)"},
};

int positive_number(const std::string& text, std::string_view option) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1)
    throw Error(Fault::usage, "",
                fmt::format("{} needs a whole number of at least 1, not '{}'", option, text));
  return value;
}

double tolerance(const std::string& text, std::string_view option) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0.0) ||
      !std::isfinite(value))
    throw Error(Fault::usage, "", fmt::format("{} needs a number >= 0, not '{}'", option, text));
  return value;
}

void set(Arguments& arguments, std::string_view option, const std::string& value) {
  if (option == "-o" && value.empty())
    throw Error(Fault::usage, "", "-o needs the name of a folder or a file");
  if (option == "-o")
    arguments.output = io::with_home_folder(value, option);
  else if (option == "--set")
    arguments.overrides.push_back(value);
  else if (option == "--threads")
    arguments.threads = positive_number(value, option);
  else if (option == "--processes")
    arguments.processes = positive_number(value, option);
  else if (option == "--again")
    arguments.again = true;
  else if (option == "--list")
    arguments.list = true;
  else if (option == "--follow")
    arguments.follow = true;
  else if (option == "--once")
    arguments.once = true;
  else if (option == "--resume")
    arguments.resume = true;
  else if (option == "--from")
    arguments.from = io::with_home_folder(value, option);
  else if (option == "--quiet")
    arguments.quiet = true;
  else if (option == "--profile")
    arguments.profile = true;
  else if (option == "--rtol")
    arguments.rtol = tolerance(value, option);
  else if (option == "--atol")
    arguments.atol = tolerance(value, option);
  else if (option == "--units")
    arguments.units = value;
  else if (option == "--unit")
    arguments.unit = value;
  else if (option == "--allow-outside")
    arguments.allow_outside = true;
  else
    throw Error(Fault::usage, "", fmt::format("{} is not available in this version", option));
}

/// Options that a command takes, also those of which it has no use.
std::vector<Option> taken_options(const Command& command) {
  std::vector<Option> options = options_of(command);
  if (command.name == "check")
    options.insert(options.end(), std::begin(run_options), std::end(run_options));
  return options;
}

Option find_option(const std::string& word, const Command& command) {
  std::vector<std::string> known;
  std::optional<Option> found;
  for (const Option& option : taken_options(command)) {
    if (word == option.name || word == option.also)
      found = option;
    known.emplace_back(option.name);
    if (!option.also.empty())
      known.emplace_back(option.also);
  }
  if (found)
    return *found;
  throw Error(Fault::usage, "", fmt::format("billet {}: unknown option '{}'", command.name, word),
              io::suggestion(word, known));
}

} // namespace

std::string file_name(const std::filesystem::path& file, std::string_view usual) {
  const std::string stem = file.stem().string();
  const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
  const std::string folder = whole.parent_path().filename().string();
  return stem == usual && !folder.empty() ? folder : stem;
}

const std::vector<Command>& commands() {
  static const std::vector<Command> all{
      {"run", "CASE.toml [options]", "run a case to the end and write its results", &run_case},
      {"check", "CASE.toml [options]", "read and validate a case without solving it", &check_case},
      {"info", "FILE [--unit UNIT] [--allow-outside]",
       "what an STL, mesh or result contains, and what is wrong with it", &show_info},
      {"render", "RESULTS [--field F] [--view V] [--animate] [--curve] [-o FILE]",
       "a picture or a film of a run, or its forces, without a display", &render_results},
      {"report", "RESULTS [-o FILE.html] [--follow]",
       "a page of a run for the browser: curves, tables, frames in 3D", &make_report},
      {"watch", "RESULTS [--once]",
       "how a run is going on, until it ends; the status is that of the run", &watch_results},
      {"study", "STUDY.toml [options]",
       "run a case with a matrix of settings: what they cost and how far off they are",
       &conduct_study},
      {"chart", "CHART.toml [options]", "what a test measures, for values of a law's parameters",
       &make_chart},
      {"identify", "CHART MEASUREMENTS.csv [-o DIR]",
       "a law's parameters from measured values, with their intervals", &identify_parameters, 2},
      {"verify", "[NAME ...] [options]",
       "run problems that have closed forms: every figure next to its reference", &verify_problems,
       0},
      {"diff", "A B [--rtol R] [--atol A]",
       "compare two folders of results, or two case files; status 1 if they differ",
       &show_differences, 2},
      {"import", "JOB.inp [-o DIR] [--units UNITS]", "a case from a deck of CalculiX or Abaqus",
       &import_deck},
      {"explain", "[CODE ...]", "what a code in a message means; without a code: all of them",
       &explain_code, 0},
      {"schema", "[case|study|chart] [-o FILE]",
       "the JSON Schema of case, study or chart files, for editors", &print_schema, 0},
      {"completion", "bash|zsh|fish", "a script that completes commands, options and files",
       &print_completion, 0},
      {"manual", "", "the manual page, for man -l -", &print_manual, 0},
  };
  return all;
}

std::vector<Option> options_of(const Command& command) {
  std::vector<Option> all;
  const auto add = [&](std::span<const Option> options) {
    all.insert(all.end(), options.begin(), options.end());
  };
  if (command.name == "info") {
    add(info_options);
  } else if (command.name == "render") {
    return render_options();
  } else if (command.name == "report") {
    add(report_options);
  } else if (command.name == "watch") {
    add(watch_options);
  } else if (command.name == "identify") {
    add(identify_options);
  } else if (command.name == "study" || command.name == "chart") {
    add(study_options);
  } else if (command.name == "verify") {
    add(verify_options);
  } else if (command.name == "import") {
    add(import_options);
  } else if (command.name == "explain" || command.name == "completion" ||
             command.name == "manual") {
    return all;
  } else if (command.name == "diff") {
    add(diff_options);
  } else if (command.name == "schema") {
    add(schema_options);
  } else {
    add(case_options);
    if (command.name == "run")
      add(run_options);
  }
  return all;
}

Arguments parse(const Command& command, const std::vector<std::string>& words) {
  Arguments arguments;
  if (command.name == "render") { // billet-render tells its options from its files
    arguments.rest = words;
    return arguments;
  }
  const bool takes_names = command.files == 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool is_option = word.size() > 1 && word[0] == '-';
    if (!is_option) {
      if (!takes_names && arguments.file.empty())
        arguments.file = word;
      else if (takes_names || arguments.rest.size() + 1 < command.files)
        arguments.rest.push_back(word);
      else
        throw Error(Fault::usage, "",
                    fmt::format("billet {}: {} expected, '{}' is too many", command.name,
                                command.files == 1 ? "one file is" : "two files are", word));
      continue;
    }
    const std::size_t equals = word.find('=');
    const bool joined = word.starts_with("--") && equals != std::string::npos;
    const Option option = find_option(joined ? word.substr(0, equals) : word, command);
    if (option.value.empty() && joined)
      throw Error(Fault::usage, "", fmt::format("{} takes no value", option.name),
                  fmt::format("leave out '{}'", word.substr(equals)));
    if (option.value.empty()) {
      set(arguments, option.name, "");
    } else if (joined) {
      set(arguments, option.name, word.substr(equals + 1));
    } else if (i + 1 < words.size()) {
      set(arguments, option.name, words[++i]);
    } else {
      throw Error(Fault::usage, "", fmt::format("{} needs a value", option.name));
    }
  }
  if (command.name == "run" && arguments.resume && arguments.from)
    throw Error(Fault::usage, "", "--resume and --from exclude each other",
                "--resume goes on in the folder of the results, --from in another one");
  if (arguments.file.empty() && !takes_names)
    throw Error(Fault::usage, "", fmt::format("billet {}: a file is missing", command.name),
                fmt::format("billet {} {}", command.name, command.usage));
  if (command.name == "diff" && arguments.rest.empty())
    throw Error(Fault::usage, "", "billet diff: the second of two is missing",
                fmt::format("billet {} {}", command.name, command.usage));
  return arguments;
}

const std::vector<ExitStatus>& exit_statuses() {
  static const std::vector<ExitStatus> all{
      {"0", "done"},
      {"1", "billet diff: the two differ; billet study, chart: runs are left to be made"},
      {"2", "usage"},
      {"3", "bad case file"},
      {"4", "bad geometry or mesh"},
      {"5", "not converged; results up to the last good increment are valid"},
      {"6", "input/output or disk"},
      {"7", "memory or another limit"},
      {"8", "ran to its end, but the result fails a check, named in summary.json"},
      {"70", "internal error"},
      {"129/130/143", "stopped by SIGHUP/SIGINT/SIGTERM after a clean end of the increment (a "
                      "second signal: at once)"},
  };
  return all;
}

std::string help() {
  std::string text = "billet: implicit simulation of metal forming\n\n";
  for (const Command& command : commands())
    text += fmt::format("  billet {:10s} {}\n                    {}\n", command.name, command.usage,
                        command.summary);
  text += "\n  billet COMMAND --help   the options of a command\n"
          "  billet --version        the version\n\n"
          "Exit status:\n";
  for (const ExitStatus& status : exit_statuses())
    text += fmt::format("  {:11s} {}\n", status.number, status.meaning);
  text += "A code in brackets, as [tool-misses], is explained by: billet explain tool-misses\n";
  return text;
}

std::string help(const Command& command) {
  if (command.name == "render")
    return std::string(render::usage_text);
  std::string text =
      fmt::format("billet {} {}\n\n{}\n", command.name, command.usage, command.summary);
  const auto line = [](const Option& option) {
    const std::string also =
        option.also.empty() ? "" : fmt::format(", {} {}", option.also, option.value);
    return fmt::format("  {:26s} {}\n", fmt::format("{} {}{}", option.name, option.value, also),
                       option.help);
  };
  text += '\n';
  for (const Option& option : options_of(command))
    text += line(option);
  if (command.name == "check")
    text += "  options of billet run are taken, and have no effect\n";
  return text;
}

} // namespace billet::app
