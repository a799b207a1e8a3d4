// The main case and small scenes far from their defaults: they must still reach their end, with
// the right force. The whole matrix is bench/extremes.

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace billet::test::extremes_test {
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

/// A disk upset by a tenth, or half a strip pushed through a turning roll; every length times
/// `unit`.
std::string small_case(const std::string& scene, double unit) {
  const bool disk = scene == "disk";
  const auto box =
      disk ? fmt::format("[[0, 0], [{0}, {0}]], cells = [4, 4]", 10 * unit)
           : fmt::format("[[{}, 0], [{}, {}]], cells = [8, 2]", -8 * unit, -2 * unit, unit);
  const auto held = disk ? std::string("where = \"x = 0\"\nfix = [\"x\"]\n")
                         : fmt::format("where = \"x = {}\"\nmove = {{ x = [[0, 0], [3, {}]] }}\n",
                                       -8 * unit, 3 * unit);
  const auto surface =
      disk ? fmt::format("plane = {{ point = [0, {}], normal = [0, -1] }}", 10 * unit)
           : fmt::format("circle = {{ centre = [0, {}], radius = {} }}", 20.9 * unit, 20 * unit);
  const auto motion =
      disk ? fmt::format("velocity = [0, {}]", -unit)
           : fmt::format("rotation = {{ point = [0, {}], speed = 0.0525 }}", 20.9 * unit);
  return fmt::format(R"(analysis = "{}"
workpiece = {{ element = "quad8", material = "steel", mesh = {{ box = {} }} }}
[material.steel]
elastic = {{ young = 200000, poisson = 0.3 }}
flow = {{ law = "linear", yield = 700, hardening = 300 }}
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
{}
[[tool]]
name = "die"
surface = {{ {} }}
motion = {{ {} }}
friction = {{ law = "coulomb", mu = 0.1 }}
[time]
end = {}
)",
                     disk ? "axisymmetric" : "plane-strain", box, held, surface, motion,
                     disk ? 1 : 3);
}

/// Normal force on the die at the end [N], of a case in mm; nothing if the run was refused. One
/// that a check refuses at its end (a soft tool sinks in) has a force all the same.
std::optional<double>
small_force(const std::string& scene, const std::vector<std::string>& settings, double unit = 1.0) {
  const TemporaryFolder folder;
  write_text(folder.path() / "case.toml", small_case(scene, unit));
  const std::string results = (folder.path() / "results").string();
  std::vector<std::string> words{
      "run", (folder.path() / "case.toml").string(), "--quiet", "--threads", "1", "-o", results};
  for (const std::string& setting : settings) {
    words.emplace_back("--set");
    words.push_back(setting);
  }
  const Outcome outcome = test::billet(Start{.words = words});
  EXPECT_FALSE(outcome.crashed) << outcome.err;
  constexpr int failed_check = 8;
  if (outcome.status != 0 && outcome.status != failed_check) {
    EXPECT_TRUE(outcome.status >= 2 && outcome.status <= 7) << outcome.status << outcome.err;
    return std::nullopt;
  }
  const auto summary = nlohmann::json::parse(whole_file(folder.path() / "results/summary.json"));
  const double force = summary["tools"]["die"]["force"][1];
  EXPECT_TRUE(std::isfinite(force));
  return force / (scene == "disk" ? unit * unit : unit);
}

struct Agreement {
  std::vector<std::string> settings;
  double within; ///< of the force at the defaults [-]
};

TEST(Extremes, a_small_disk_keeps_its_force) {
  const std::string friction = "tool.die.friction.mu=";
  for (const char* mu : {"0", "0.1", "0.5", "1", "10"}) {
    const std::optional<double> usual = small_force("disk", {friction + mu});
    ASSERT_TRUE(usual) << mu;
    const std::vector<Agreement> others{
        {{"contact.penalty=1"}, 0.02}, // 1/(1 + penalty) of an elastic layer, less where it yields
        {{"contact.penalty=1e4"}, 0.01},
        {{"contact.penalty=1e6"}, 0.01},
        {{"material.steel.elastic.poisson=0"}, 0.01},
        {{"material.steel.elastic.poisson=0.4999"}, 0.01},
        {{"time.increments.first=1", "time.increments.max=1"}, 0.01},
    };
    for (Agreement other : others) {
      other.settings.push_back(friction + mu);
      const std::optional<double> force = small_force("disk", other.settings);
      ASSERT_TRUE(force) << other.settings[0] << ", mu " << mu;
      EXPECT_NEAR(*force, *usual, other.within * *usual) << other.settings[0] << ", mu " << mu;
    }
  }
}

TEST(Extremes, a_soft_tool_presses_less) {
  const std::optional<double> hard = small_force("disk", {});
  const std::optional<double> soft = small_force("disk", {"contact.penalty=0.01"});
  ASSERT_TRUE(hard && soft);
  EXPECT_LT(*soft, *hard);
  EXPECT_GT(*soft, 0.5 * *hard);
}

TEST(Extremes, no_number_in_the_program_has_a_unit) {
  for (const char* scene : {"disk", "strip"}) {
    const std::optional<double> usual = small_force(scene, {});
    ASSERT_TRUE(usual) << scene;
    // Lengths times a power of two change no rounding: not one bit of a force may differ.
    EXPECT_EQ(small_force(scene, {}, 0x1p20), usual) << scene;
    EXPECT_EQ(small_force(scene, {}, 0x1p-20), usual) << scene;
    // Other factors do, and where increments are as long as their iterations allow one may take an
    // iteration more: these have their length.
    constexpr double rounding = 1e-6;
    const std::vector<std::string> steady{"time.increments.first=0.03", "time.increments.max=0.03"};
    const double reference = small_force(scene, steady).value_or(0.0);
    EXPECT_GT(reference, 0.0);
    EXPECT_NEAR(small_force(scene, steady, 1e6).value_or(0.0), reference, rounding * reference)
        << scene;
  }
}

TEST(Extremes, a_strip_through_a_roll_ends_by_name) {
  for (const char* mu : {"0", "1", "10"})
    for (const char* penalty : {"1", "1e4", "1e6"}) {
      const auto force = small_force("strip", {std::string("tool.die.friction.mu=") + mu,
                                               std::string("contact.penalty=") + penalty});
      EXPECT_GT(force.value_or(1.0), 0.0) << mu << " " << penalty;
    }
}

TEST(Extremes, a_slender_strip_bends_and_no_more) {
  // Clamped, 400 times as long as thick; the nose slides over sides that hardly press on it.
  constexpr double length = 380, thickness = 1, deflection = 36, young = 200e3, poisson = 0.3;
  const TemporaryFolder folder;
  write_text(folder.path() / "case.toml", R"(analysis = "plane-strain"
workpiece = { element = "quad8", material = "steel", mesh = { box = [[0, 0], [400, 1]], cells = [200, 2] } }
[material.steel]
elastic = { young = 200e3, poisson = 0.3 }
flow = { law = "linear", yield = 300, hardening = 1000 }
[[support]]
where = "x = 0"
fix = ["x", "y"]
[[tool]]
name = "nose"
surface = { circle = { centre = [380, 6], radius = 5 } }
motion = { velocity = [0, -60] }
friction = { law = "coulomb", mu = 0.2 }
[time]
end = 0.6
)");
  const Outcome outcome = billet({"run", "case.toml", "--quiet", "-o", "out"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(whole_file(folder.path() / "out/summary.json"));
  const auto& energy = summary["energy"];
  const double stiffness = 3 * young / (1 - poisson * poisson) * std::pow(thickness, 3) / 12 /
                           std::pow(length, 3); // Bernoulli
  const double work = 0.5 * stiffness * deflection * deflection;
  fmt::print("[extremes] slender strip: work {:.4f} N mm, of a beam {:.4f}, plastic {:.4f}\n",
             energy["external_work"].get<double>(), work, energy["plastic_work"].get<double>());
  EXPECT_NEAR(energy["external_work"].get<double>(), work, 0.01 * work);
  EXPECT_EQ(energy["plastic_work"].get<double>(), 0.0);
  EXPECT_LE(energy["relative_error"].get<double>(), 5e-3);
}

} // namespace
} // namespace billet::test::extremes_test
