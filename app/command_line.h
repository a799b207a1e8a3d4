// The command line: which command, with which options.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::app {

/// What the user typed after the command.
struct Arguments {
  std::string file; ///< case, mesh, STL or results; render, verify: empty
  std::optional<std::filesystem::path> output; ///< -o
  std::vector<std::string> overrides;          ///< --set key=value
  std::optional<int> threads;                  ///< --threads
  bool resume = false;                         ///< --resume
  std::optional<std::string> from;             ///< --from, RESULTS or RESULTS@TIME
  bool quiet = false;                          ///< --quiet
  bool profile = false;                        ///< --profile
  bool allow_outside = false;                  ///< --allow-outside
  std::optional<std::string> unit;             ///< --unit, of an STL
  std::optional<int> processes;                ///< --processes
  bool again = false;                          ///< --again
  bool list = false;                           ///< --list
  bool follow = false;                         ///< --follow
  bool once = false;                           ///< --once
  std::optional<double> rtol, atol;            ///< --rtol, --atol
  std::optional<std::string> units;            ///< --units, of a deck
  /// Files after the first; of render all words, of verify names of problems.
  std::vector<std::string> rest;
};

/// The folder's name for a file that has its usual name (case.toml, say), the file's own otherwise.
[[nodiscard]] std::string file_name(const std::filesystem::path& file, std::string_view usual);

/// An option of a command.
struct Option {
  std::string_view name;
  std::string_view value; ///< what it takes; empty: nothing
  std::string_view help;
  std::string_view also = {}; ///< another way to write it
};

/// A command of the program.
struct Command {
  std::string_view name;
  std::string_view usage;   ///< after "billet NAME"
  std::string_view summary; ///< one line for the help
  int (*run)(const Arguments&);
  std::size_t files = 1; ///< that it takes; 0: names instead, any number
};

int run_case(const Arguments& arguments);
int check_case(const Arguments& arguments);
int show_info(const Arguments& arguments);
int render_results(const Arguments& arguments);
int make_report(const Arguments& arguments);
int watch_results(const Arguments& arguments);
int conduct_study(const Arguments& arguments);
int make_chart(const Arguments& arguments);
int identify_parameters(const Arguments& arguments);
int verify_problems(const Arguments& arguments);
int print_schema(const Arguments& arguments);
int show_differences(const Arguments& arguments);
int explain_code(const Arguments& arguments);
int print_completion(const Arguments& arguments);
int print_manual(const Arguments& arguments);
int import_deck(const Arguments& arguments);

/// Every command that works in this version.
[[nodiscard]] const std::vector<Command>& commands();

/// An exit status and its meaning.
struct ExitStatus {
  std::string_view number;
  std::string_view meaning;
};
[[nodiscard]] const std::vector<ExitStatus>& exit_statuses();

/// Words that may stand after a command that takes names; empty: it takes files.
[[nodiscard]] std::vector<std::string> words_of(const Command& command);
[[nodiscard]] std::vector<std::string> names_of_shells();
[[nodiscard]] std::vector<std::string> names_of_codes();
[[nodiscard]] std::vector<std::string> names_of_schemas();

/// The options that a command's help lists.
[[nodiscard]] std::vector<Option> options_of(const Command& command);

/// Parses the words after the command.
/// @throws Error (Fault::usage)
[[nodiscard]] Arguments parse(const Command& command, const std::vector<std::string>& words);

/// The text of `billet --help`.
[[nodiscard]] std::string help();
/// The text of `billet COMMAND --help`.
[[nodiscard]] std::string help(const Command& command);

} // namespace billet::app
