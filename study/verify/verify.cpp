#include "study/verify/verify.h"

#include "geometry/base/error.h"
#include "io/case/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>

namespace billet::study {

bool ProblemOutcome::passed() const {
  return failure.empty() && !figures.empty() &&
         std::all_of(figures.begin(), figures.end(), within_tolerance);
}

std::vector<const Problem*> chosen_problems(std::span<const Problem> known,
                                            std::span<const std::string> names) {
  std::vector<const Problem*> chosen;
  if (names.empty())
    for (const Problem& problem : known)
      chosen.push_back(&problem);
  for (const std::string& name : names) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const Problem& problem) { return problem.name == name; });
    if (found == known.end()) {
      std::vector<std::string> all;
      for (const Problem& problem : known)
        all.emplace_back(problem.name);
      const std::string near = io::suggestion(name, all);
      throw Error(Fault::usage, "", fmt::format("no problem is called '{}'", name),
                  near.starts_with("did you mean") ? near : "billet verify --list names them");
    }
    chosen.push_back(&*found);
  }
  return chosen;
}

std::vector<ProblemOutcome> verify(std::span<const Problem* const> problems,
                                   const CaseBench& bench,
                                   const VerifySettings& settings) {
  std::vector<ProblemOutcome> outcomes;
  for (const Problem* problem : problems) {
    if (settings.stopped && settings.stopped())
      break;
    const auto start = std::chrono::steady_clock::now();
    ProblemOutcome outcome{problem, {}, {}};
    try {
      outcome.figures = problem->figures(bench);
      if (outcome.figures.empty())
        outcome.failure = "no figure was found";
    } catch (const std::exception& error) { // of whatever kind: the next problem may be well
      outcome.failure = error.what();
    }
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (settings.tried)
      settings.tried(outcome);
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

} // namespace billet::study
