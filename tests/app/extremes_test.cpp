// The main case far from its defaults: it must still reach its end, with the right force.

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace billet::test {
namespace {

constexpr const char* billet_case = BILLET_SOURCE_DIR "/cases/billet-lippmann/case.toml";

/// Axial force on the die at the end of the billet case with an override [N].
double end_force(const std::string& setting) {
  const TemporaryFolder results;
  const Outcome outcome =
      test::billet(Start{.words = {"run", billet_case, "--quiet", "--set", setting, "-o",
                                   results.path().string(), "--set", "workpiece.element=quad4"}});
  EXPECT_EQ(outcome.status, 0) << setting << ": " << outcome.err;
  const auto summary = nlohmann::json::parse(whole_file(results.path() / "summary.json"));
  const double force = summary["tools"]["die"]["force"][1];
  fmt::print("[extremes] {}: {:.1f} kN at 60 %, reference 855 +- 30 kN\n", setting, force / 1e3);
  EXPECT_LE(summary["energy"]["relative_error"].get<double>(), 5e-3) << setting;
  return force;
}

TEST(Extremes, penalty_may_vary_by_six_decades) {
  // One mesh scatters by +- 3 % once its side has folded over (VALIDATION FRM-06); between
  // penalties that much is left too, far less than any error a wrong penalty law would make.
  const double reference = end_force("contact.penalty=100");
  constexpr double scatter = 0.04;
  for (const char* setting : {"contact.penalty=1", "contact.penalty=1e4", "contact.penalty=1e6"})
    EXPECT_NEAR(end_force(setting), reference, scatter * reference) << setting;
}

TEST(Extremes, increments_may_be_long) {
  const double reference = end_force("time.increments.max=0.18");
  constexpr double scatter = 0.04;
  EXPECT_NEAR(end_force("time.increments.max=1.0"), reference, scatter * reference);
}

TEST(Extremes, near_incompressibility_changes_little) {
  const double reference = end_force("material.steel.elastic.poisson=0.3");
  constexpr double scatter = 0.04;
  EXPECT_NEAR(end_force("material.steel.elastic.poisson=0.4999"), reference, scatter * reference);
}

} // namespace
} // namespace billet::test
