// Rate, temperature and the library of materials through the program: what is checked, told and
// written.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <cmath>

namespace billet::test::rate_laws_test {

namespace {

const std::string swift = "flow    = { law = \"swift\", K = 740, eps0 = 0.01, n = 0.2 }\n";
const std::string elastic = "elastic = { young = \"210 GPa\", poisson = 0.3 }\n";

/// The tiny upsetting, of copper from the library at a speed of metres per second.
const std::string copper = edited(upsetting,
                                  {{"title ", "temperature = 20\ntitle "},
                                   {elastic, "library = \"ofhc-copper\"\n"},
                                   {swift, "heating = 0.9\n"},
                                   {"[0, -1] }\nfriction", "[0, -1000] }\nfriction"},
                                   {"end = 0.1", "end = 1e-3"},
                                   {"first = 0.02, max = 0.02", "max = 1e-4"}});

class RateLaws : public testing::Test {
protected:
  Outcome run(std::vector<std::string> words, const std::string& text) const {
    write_text(folder_.path() / "case.toml", text);
    return billet(words, folder_.path());
  }
  /// Whether any frame of the workpiece has a field.
  [[nodiscard]] bool has_field(const std::string& name) const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "out" / "frames"))
      if (entry.path().extension() == ".vtu" &&
          whole_file(entry.path()).find("Name=\"" + name + "\"") != std::string::npos)
        return true;
    return false;
  }

  TemporaryFolder folder_;
};

TEST_F(RateLaws, check_prints_the_constants_of_the_library_and_what_is_active) {
  const Outcome outcome = run({"check", "case.toml"}, copper);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* text :
       {"law = \"johnson-cook\", A = 90, B = 292, n = 0.31, C = 0.025", "Johnson and Cook",
        "rate-dependent, adiabatic heating from 20 degC", "T_melt = 1082.85"})
    EXPECT_TRUE(outcome.prints(text)) << text << "\n" << outcome.out;
}

TEST_F(RateLaws, a_heated_run_writes_its_temperature_and_all_constants) {
  const Outcome outcome = run({"run", "case.toml", "--quiet", "-o", "out"}, copper);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has_field("temperature"));
  const std::string resolved = whole_file(folder_.path() / "out" / "case.resolved.toml");
  EXPECT_NE(resolved.find("A = 90, B = 292"), std::string::npos) << resolved;
  const Outcome again = run({"check", "case.toml"}, resolved);
  EXPECT_EQ(again.status, 0) << again.err;
}

TEST_F(RateLaws, an_isothermal_run_has_no_temperature) {
  const Outcome outcome =
      run({"run", "case.toml", "--quiet", "-o", "out"}, edited(copper, {{"heating = 0.9\n", ""}}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(has_field("temperature"));
  EXPECT_TRUE(has_field("plastic_strain"));
}

TEST_F(RateLaws, a_faster_press_needs_more_work) {
  const auto work = [&](const std::string& text) {
    const Outcome outcome = run({"run", "case.toml", "--quiet", "-o", "out"}, text);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_table(folder_.path() / "out" / "history.csv").values("plastic_work").back();
  };
  const std::string fast = edited(copper, {{"heating = 0.9\n", ""}});
  const std::string slow =
      edited(fast, {{"-1000", "-1"}, {"end = 1e-3", "end = 1.0"}, {"max = 1e-4", "max = 0.1"}});
  // ln(1000) times C = 0.025, from a rate of about 0.14 to one of 140 /s; slow counts as 1 /s.
  EXPECT_NEAR(work(fast) / work(slow), 1.0 + 0.025 * std::log(140.0), 0.02);
}

TEST_F(RateLaws, a_molten_workpiece_is_told) {
  const Outcome outcome =
      run({"check", "case.toml"}, edited(copper, {{"temperature = 20", "temperature = 1200"}}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("the metal is molten")) << outcome.out;
}

} // namespace

} // namespace billet::test::rate_laws_test
