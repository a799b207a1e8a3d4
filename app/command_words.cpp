// Words that may follow a command: names of problems, of shells, codes.

#include "app/command_line.h"

#include "study/verify/problem.h"

namespace billet::app {

std::vector<std::string> words_of(const Command& command) {
  if (command.name == "completion")
    return names_of_shells();
  if (command.name == "explain")
    return names_of_codes();
  if (command.name == "schema")
    return names_of_schemas();
  std::vector<std::string> words;
  if (command.name == "verify")
    for (const study::Problem& problem : study::all_problems())
      words.emplace_back(problem.name);
  return words;
}

} // namespace billet::app
