// billet explain: what a code in a message means, and what may help.

#include "app/command_line.h"
#include "app/explanations.h"
#include "geometry/base/error.h"
#include "io/case/suggestion.h"

#include <fmt/format.h>

#include <algorithm>

namespace billet::app {

namespace {

void print_whole(const Explanation& one) {
  fmt::print("{} ({})\n\n{}\n", one.code, one.kind, one.meaning);
  if (!one.causes.empty())
    fmt::print("\nUsual cause: {}\n", one.causes);
  if (!one.remedy.empty())
    fmt::print("\nWhat may help: {}\n", one.remedy);
}

void print_list() {
  std::string_view kind;
  for (const Explanation& one : explanations()) {
    if (one.kind != kind)
      fmt::print("{}{}:\n", kind.empty() ? "" : "\n", one.kind);
    kind = one.kind;
    fmt::print("  {:22s} {}\n", one.code, one.meaning);
  }
}

/// As a user may have copied it from a message: "[tool-misses]", "exit status 5", "5".
std::string code_in(std::string text) {
  std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == '\''; });
  std::replace(text.begin(), text.end(), ' ', '-');
  if (text.starts_with("exit-status-"))
    text.erase(0, std::string_view("exit-status-").size());
  const bool is_number = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (text == "129" || text == "138" || text == "143")
    text = "130";
  return is_number ? "exit-" + text : text;
}

} // namespace

std::vector<std::string> names_of_codes() {
  std::vector<std::string> names;
  for (const Explanation& one : explanations())
    names.emplace_back(one.code);
  return names;
}

int explain_code(const Arguments& arguments) {
  if (arguments.rest.empty()) {
    print_list();
    return 0;
  }
  bool is_first = true;
  for (const std::string& word : arguments.rest) {
    const std::string code = code_in(word);
    const auto found = std::find_if(explanations().begin(), explanations().end(),
                                    [&](const Explanation& one) { return one.code == code; });
    if (found == explanations().end())
      throw Error(Fault::usage, "", fmt::format("there is no code '{}'", word),
                  io::suggestion(code, names_of_codes(), "billet explain lists all:"));
    if (!is_first)
      fmt::print("\n");
    print_whole(*found);
    is_first = false;
  }
  return 0;
}

} // namespace billet::app
