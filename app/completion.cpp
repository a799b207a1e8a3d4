// billet completion: what a shell offers after the tabulator, from the tables of the help.

#include "app/command_line.h"
#include "geometry/base/error.h"
#include "io/case/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace billet::app {

namespace {

enum class Offer { nothing, words, folders, files, toml_files };

/// What may stand where a command takes a file or a name.
Offer operand_of(const Command& command) {
  if (!words_of(command).empty())
    return Offer::words;
  if (command.usage.starts_with("RESULTS"))
    return Offer::folders;
  return command.usage.find(".toml") < command.usage.find(' ') ? Offer::toml_files : Offer::files;
}

Offer value_of(const Option& option) {
  if (option.value == "DIR" || option.value.starts_with("RESULTS"))
    return Offer::folders;
  return option.value.starts_with("FILE") ? Offer::files : Offer::nothing;
}

std::string joined(const std::vector<std::string>& words, std::string_view separator = " ") {
  return fmt::format("{}", fmt::join(words, separator));
}

/// Text within '...' of a shell.
std::string shell_text(std::string_view text) {
  std::string result = "'";
  for (const char c : text)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::vector<std::string> names_of_commands() {
  std::vector<std::string> names;
  for (const Command& command : commands())
    names.emplace_back(command.name);
  return names;
}

/// An option in all its ways to be written.
std::vector<std::string> spellings(const Option& option) {
  std::vector<std::string> all{std::string(option.name)};
  if (!option.also.empty())
    all.emplace_back(option.also);
  return all;
}

// --- bash -------------------------------------------------------------------------------------

constexpr std::string_view bash_head =
    R"(# bash completion of billet, written by: billet completion bash
_billet_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$2"); }
_billet_files() { # PATTERN WORD: folders, and the files that fit
  local IFS=$'\n' name
  COMPREPLY=()
  for name in $(compgen -f -- "$2"); do
    # shellcheck disable=SC2053
    [[ ! -d ${name/#\~\//$HOME/} && $name != $1 ]] || COMPREPLY+=("$name")
  done
  compopt -o filenames 2>/dev/null
}
_billet_folders() { mapfile -t COMPREPLY < <(compgen -d -- "$1"); compopt -o filenames 2>/dev/null; }
_billet() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options
  COMPREPLY=()
)";

std::string bash_offer(Offer offer, const std::vector<std::string>& words = {}) {
  switch (offer) {
  case Offer::words:
    return fmt::format("_billet_words \"{}\" \"$word\"", joined(words));
  case Offer::folders:
    return "_billet_folders \"$word\"";
  case Offer::files:
    return "_billet_files '*' \"$word\"";
  case Offer::toml_files:
    return "_billet_files '*.toml' \"$word\"";
  case Offer::nothing:
    break;
  }
  return ":";
}

std::string bash_command(const Command& command) {
  std::vector<std::string> all;
  std::string values;
  for (const Option& option : options_of(command)) {
    for (const std::string& spelling : spellings(option))
      all.push_back(spelling);
    if (!option.value.empty())
      values += fmt::format("        {}) {}; return ;;\n", joined(spellings(option), "|"),
                            bash_offer(value_of(option)));
  }
  all.emplace_back("--help");
  std::string text = fmt::format("    {})\n", command.name);
  if (!values.empty())
    text += "      case $before in\n" + values + "      esac\n";
  return text + fmt::format("      options='{}'\n"
                            "      [[ $word == -* ]] || {{ {}; return; }} ;;\n",
                            joined(all), bash_offer(operand_of(command), words_of(command)));
}

std::string bash_script() {
  std::string text(bash_head);
  text += fmt::format("  if ((COMP_CWORD == 1)); then\n"
                      "    _billet_words '{} help --help --version' \"$word\"\n"
                      "    return\n  fi\n  case ${{COMP_WORDS[1]}} in\n",
                      joined(names_of_commands()));
  for (const Command& command : commands())
    text += bash_command(command);
  return text + "    *) return ;;\n  esac\n  _billet_words \"$options\" \"$word\"\n}\n"
                "complete -F _billet billet\n";
}

// --- zsh --------------------------------------------------------------------------------------

/// Text within the [...] of _arguments.
std::string zsh_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\')
      result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_offer(Offer offer, const std::vector<std::string>& words = {}) {
  switch (offer) {
  case Offer::words:
    return "(" + joined(words) + ")";
  case Offer::folders:
    return "_files -/";
  case Offer::files:
    return "_files";
  case Offer::toml_files:
    return "_files -g \"*.toml\"";
  case Offer::nothing:
    break;
  }
  return "";
}

std::string zsh_option(const Option& option) {
  const std::string value = option.value.empty() ? ""
                                                 : fmt::format(":{}:{}", zsh_text(option.value),
                                                               zsh_offer(value_of(option)));
  const std::string repeats = option.name == "--set" ? "*" : "";
  std::string text;
  for (const std::string& spelling : spellings(option))
    text += " " +
            shell_text(fmt::format("{}{}[{}]{}", repeats, spelling, zsh_text(option.help), value));
  return text;
}

std::string zsh_script() {
  std::string text = "#compdef billet\n# zsh completion of billet, written by: billet completion "
                     "zsh\n_billet() {\n  local state line\n  local -a commands=(\n";
  for (const Command& command : commands())
    text += fmt::format("    {}\n",
                        shell_text(fmt::format("{}:{}", command.name, zsh_text(command.summary))));
  text += "  )\n  _arguments -C '--help[the commands]' '--version[the version]' "
          "'1:command:->command' '*::argument:->argument'\n  case $state in\n"
          "    command) _describe command commands ;;\n    argument)\n      case $words[1] in\n";
  for (const Command& command : commands()) {
    text += fmt::format("        {}) _arguments '--help[the options]'", command.name);
    for (const Option& option : options_of(command))
      text += zsh_option(option);
    text += " " +
            shell_text(fmt::format("*:{}:{}",
                                   zsh_text(command.usage.substr(0, command.usage.find(' '))),
                                   zsh_offer(operand_of(command), words_of(command)))) +
            " ;;\n";
  }
  return text + "      esac ;;\n  esac\n}\n"
                "if [[ $funcstack[1] == _billet ]]; then _billet \"$@\"; else compdef _billet "
                "billet; fi\n";
}

// --- fish -------------------------------------------------------------------------------------

std::string fish_offer(Offer offer, const std::vector<std::string>& words = {}) {
  switch (offer) {
  case Offer::words:
    return " -f -a " + shell_text(joined(words));
  case Offer::folders:
    return " -f -a '(__fish_complete_directories)'";
  case Offer::files:
    return " -F";
  case Offer::toml_files:
    return " -f -a '(__fish_complete_suffix .toml)'";
  case Offer::nothing:
    break;
  }
  return " -f";
}

std::string fish_option(const Command& command, const Option& option) {
  std::string text =
      fmt::format("complete -c billet -n '__fish_seen_subcommand_from {}'", command.name);
  for (const std::string& spelling : spellings(option))
    text += spelling.starts_with("--") ? " -l " + spelling.substr(2) : " -s " + spelling.substr(1);
  if (!option.value.empty())
    text += " -r" + fish_offer(value_of(option));
  return text + " -d " + shell_text(option.help) + "\n";
}

std::string fish_script() {
  std::string text = "# fish completion of billet, written by: billet completion fish\n"
                     "complete -c billet -f\n"
                     "complete -c billet -n __fish_use_subcommand -l help -d 'the commands'\n"
                     "complete -c billet -n __fish_use_subcommand -l version -d 'the version'\n";
  for (const Command& command : commands()) {
    text += fmt::format("complete -c billet -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        shell_text(command.summary));
    text += fmt::format("complete -c billet -n '__fish_seen_subcommand_from {}'{}\n", command.name,
                        fish_offer(operand_of(command), words_of(command)));
    for (const Option& option : options_of(command))
      text += fish_option(command, option);
  }
  return text;
}

struct Shell {
  std::string_view name;
  std::string (*script)();
};

constexpr std::array shells{Shell{"bash", &bash_script}, Shell{"zsh", &zsh_script},
                            Shell{"fish", &fish_script}};

} // namespace

std::vector<std::string> names_of_shells() {
  std::vector<std::string> names;
  for (const Shell& shell : shells)
    names.emplace_back(shell.name);
  return names;
}

int print_completion(const Arguments& arguments) {
  if (arguments.rest.size() != 1)
    throw Error(Fault::usage, "", "billet completion: the name of one shell is expected",
                fmt::format("known are {}", joined(names_of_shells(), ", ")));
  const auto* const shell = std::find_if(shells.begin(), shells.end(), [&](const Shell& one) {
    return one.name == arguments.rest.front();
  });
  if (shell == shells.end())
    throw Error(Fault::usage, "",
                fmt::format("billet completion: unknown shell '{}'", arguments.rest.front()),
                io::suggestion(arguments.rest.front(), names_of_shells()));
  fmt::print("{}", shell->script());
  return 0;
}

} // namespace billet::app
