// billet verify: runs problems that have closed forms, and prints every figure next to its
// reference.

#include "study/verify/verify.h"

#include "app/command_line.h"
#include "app/stop_signals.h"
#include "app/threads.h"
#include "geometry/base/error.h"
#include "io/results/atomic_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "study/verify/report.h"

namespace billet::app {

namespace {

/// A folder that is gone when the program is.
class PassingFolder {
public:
  /// @throws Error (Fault::input_output)
  PassingFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "billet-verify-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw Error(Fault::input_output, name, "a folder cannot be made",
                  "name one with -o, or set TMPDIR");
    path_ = name;
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  ~PassingFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// Tries the problems; prints the rows of each as soon as it has ended.
std::vector<study::ProblemOutcome> tried(std::span<const study::Problem* const> problems,
                                         const std::filesystem::path& folder,
                                         bool quiet) {
  const study::CaseBench bench(folder);
  std::size_t n = 0;
  const auto told = [&](const study::ProblemOutcome& outcome) {
    fmt::print("{}", study::markdown_rows(outcome));
    std::fflush(stdout);
    if (!quiet)
      fmt::print(stderr, "{}/{} {}: {}, {:.1f} s\n", ++n, problems.size(), outcome.problem->name,
                 outcome.passed() ? "ok" : "FAILED", outcome.seconds);
  };
  fmt::print("{}", study::markdown_head());
  return study::verify(problems, bench, {[] { return stop_signal() != 0; }, told});
}

} // namespace

int verify_problems(const Arguments& arguments) {
  if (arguments.list) {
    fmt::print("{}", study::list_text(study::all_problems()));
    return 0;
  }
  const std::vector<const study::Problem*> problems =
      study::chosen_problems(study::all_problems(), arguments.rest);
  limit_threads(1); // the same bits on every machine
  notice_stop_signals();
  std::vector<study::ProblemOutcome> outcomes;
  if (arguments.output) {
    outcomes = tried(problems, *arguments.output / "cases", arguments.quiet);
    io::write_file(*arguments.output / "verify.md", study::markdown_text(outcomes, BILLET_VERSION));
    io::write_file(*arguments.output / "verify.html", study::html_text(outcomes, BILLET_VERSION));
  } else {
    const PassingFolder folder;
    outcomes = tried(problems, folder.path(), arguments.quiet);
  }
  fmt::print("\n{}\n", study::in_one_sentence(outcomes));
  if (stop_signal() != 0)
    return 128 + stop_signal();
  return study::count(outcomes).failed == 0 ? 0 : static_cast<int>(Fault::failed_check);
}

} // namespace billet::app
