// Runs problems, and keeps what each of them gave.

#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "study/verify/problem.h"

namespace billet::study {

/// A problem that has been tried.
struct ProblemOutcome {
  const Problem* problem;
  std::vector<Figure> figures;
  std::string failure;  ///< why it gave no figures; empty: it did
  double seconds = 0.0; ///< that it took

  /// Whether it gave figures and all are within their tolerances.
  [[nodiscard]] bool passed() const;
};

/// The problems of some names, in the order of the names; all without any.
/// @throws Error (Fault::usage) for a name that is not known, with one that may be meant
[[nodiscard]] std::vector<const Problem*> chosen_problems(std::span<const Problem> known,
                                                          std::span<const std::string> names);

/// How problems are tried.
struct VerifySettings {
  std::function<bool()> stopped;                    ///< once true no more problems are begun
  std::function<void(const ProblemOutcome&)> tried; ///< called after each
};

/// Tries problems one after the other. What cannot be run is an outcome; the others go on.
[[nodiscard]] std::vector<ProblemOutcome> verify(std::span<const Problem* const> problems,
                                                 const CaseBench& bench,
                                                 const VerifySettings& settings);

} // namespace billet::study
