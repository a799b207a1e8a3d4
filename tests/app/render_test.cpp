// Pictures and curves of results, made as a user makes them; curves where there is no display.

#include "tests/app/tables.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace billet::test::render_test {

namespace {

class Render : public testing::Test {
protected:
  void SetUp() override {
    const std::filesystem::path program(BILLET_PROGRAM);
    if (!std::filesystem::exists(program.parent_path() / "billet-render"))
      GTEST_SKIP() << "built without billet-render";
    const Outcome outcome = run_case("tiny", upsetting);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  [[nodiscard]] Outcome run_case(const std::string& name, const std::string& text) const {
    write_text(folder_.path() / (name + ".toml"), text);
    return billet({"run", name + ".toml", "--quiet", "-o", name}, folder_.path());
  }
  /// Where there is neither a display nor a program to start one.
  [[nodiscard]] Outcome without_display(std::vector<std::string> words) const {
    words.insert(words.begin(), "render");
    return billet(Start{std::move(words), folder_.path(), [] {
                          ::unsetenv("DISPLAY");
                          ::setenv("PATH", "/nowhere", 1);
                        }});
  }
  [[nodiscard]] Outcome render(std::vector<std::string> words) const {
    words.insert(words.begin(), "render");
    return billet(Start{std::move(words), folder_.path(), [] { ::unsetenv("DISPLAY"); }});
  }
  /// Width and height of a PNG; zeros: it is none.
  [[nodiscard]] std::array<int, 2> size_of(const std::string& picture) const {
    const std::string bytes = whole_file(folder_.path() / picture);
    if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG")
      return {0, 0};
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = at; i < at + 4; ++i)
        value = 256 * value + static_cast<unsigned char>(bytes[i]);
      return value;
    };
    return {number(16), number(20)};
  }

  TemporaryFolder folder_;
};

using Size = std::array<int, 2>;

TEST_F(Render, draws_force_over_stroke_without_a_display) {
  const Outcome outcome = without_display({"tiny", "--curve"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(size_of("tiny/load-stroke.png"), (Size{1200, 900}));
  const ResultTable history = read_table(folder_.path() / "tiny" / "history.csv");
  const std::vector<double> forces = history.values("punch.force_y");
  const double largest = *std::max_element(forces.begin(), forces.end());
  EXPECT_TRUE(outcome.prints(fmt::format("curve: punch, {} points, at most {:.6g} at 0.1",
                                         forces.size() + 1, 1e-3 * largest)))
      << outcome.out; // the start of the run is the first point
  EXPECT_TRUE(outcome.prints("axes: force [kN] over stroke [mm]")) << outcome.out;
}

TEST_F(Render, draws_columns_of_tables_without_a_display) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--curve", "a.png", "tiny/history.csv:time:punch.force_y:punch"},
        {"--curve", "tiny/history.csv:time:punch.force_y:punch", "-o", "a.png", "--size=400x300"},
        {"--output=a.png", "--curve", "--points", "tiny/history.csv:time:punch.force_y:punch"}}) {
    std::filesystem::remove(folder_.path() / "a.png");
    const Outcome outcome = without_display(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_GT(size_of("a.png")[0], 0);
    EXPECT_TRUE(outcome.prints("axes: punch.force_y over time")) << outcome.out;
  }
  const Outcome unknown = without_display({"--curve", "tiny/history.csv:time:punch.force"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(unknown.says("no column \"punch.force\"")) << unknown.err;
}

TEST_F(Render, draws_logarithmic_axes_of_values_above_zero) {
  write_text(folder_.path() / "errors.csv", "cost,error\n1,10\n20,1\n300,0.02\n400,0\n");
  const Outcome outcome =
      without_display({"--curve", "errors.csv:cost:error", "--log-x", "--log-y", "-o", "a.png"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("3 points, at most 10 at 1, at last 0.02 at 300")) << outcome.out;
  EXPECT_TRUE(outcome.prints("axes: error (logarithmic) over cost (logarithmic)")) << outcome.out;
  write_text(folder_.path() / "below.csv", "x,y\n1,-1\n2,0\n");
  const Outcome nothing = without_display({"--curve", "below.csv:x:y", "--log-y", "-o", "b.png"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_TRUE(nothing.says("no value is above zero")) << nothing.err;
}

TEST_F(Render, draws_forces_over_time_where_no_tool_travels) {
  const Outcome still = run_case(
      "still", edited(upsetting, {{"motion   = { velocity = [0, -1] }\n", ""}}) +
                   "\n[[support]]\nwhere = \"y = 7.5\"\nmove = { y = [[0, 0], [1, 0.5]] }\n");
  if (still.status != 0)
    GTEST_SKIP() << still.err;
  const Outcome outcome = without_display({"still", "--curve"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.prints("over time [s]")) << outcome.out;
}

TEST_F(Render, puts_pictures_into_the_results_and_names_their_colours) {
  const Outcome usual = render({"tiny"});
  EXPECT_EQ(usual.status, 0) << usual.err;
  EXPECT_TRUE(usual.prints("picture: tiny/von_mises.png")) << usual.out;
  EXPECT_TRUE(usual.prints("2 to 98 %")) << usual.out;
  EXPECT_EQ(size_of("tiny/von_mises.png"), (Size{1200, 900}));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "picture.png"));
  // Options before the results, the range as asked.
  const Outcome asked = render({"--field", "displacement:y", "--range=-0.1:0", "tiny"});
  EXPECT_EQ(asked.status, 0) << asked.err;
  EXPECT_TRUE(asked.prints("colours: displacement:y from -0.1 to 0 mm, as asked")) << asked.out;
  EXPECT_GT(size_of("tiny/displacement_y.png")[0], 0);
  const Outcome late = render({"tiny", "--time", "99"});
  EXPECT_EQ(late.status, 0) << late.err;
  EXPECT_TRUE(late.prints("time 99 s lies outside of the results")) << late.out;
}

TEST_F(Render, draws_pictures_side_by_side) {
  std::vector<std::unique_ptr<Program>> programs;
  for (const char* name : {"a.png", "b.png", "c.png"})
    programs.push_back(std::make_unique<Program>(
        Start{{"render", "tiny", "-o", name, "--size", "200x150"}, folder_.path(), [] {
                ::unsetenv("DISPLAY");
              }}));
  for (const auto& program : programs) {
    const Outcome outcome = program->end();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  for (const char* name : {"a.png", "b.png", "c.png"})
    EXPECT_EQ(size_of(name), (Size{200, 150})) << name;
}

TEST_F(Render, knows_components_by_their_names) {
  const auto colours = [&](const std::string& field) {
    const Outcome outcome = render({"tiny", "--field", field, "-o", "a.png", "--size", "200x150"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::size_t from = outcome.out.find(" from ");
    return outcome.out.substr(from, outcome.out.find('\n', from) - from);
  };
  EXPECT_EQ(colours("displacement:x"), colours("displacement:0"));
  EXPECT_EQ(colours("stress:XY"), colours("stress:3"));
}

TEST_F(Render, mistakes_end_with_status_2_and_say_what_to_do) {
  struct Mistake {
    std::vector<std::string> words;
    std::string says;
  };
  for (const auto& [words, says] : std::vector<Mistake>{
           {{}, "no results are given"},
           {{"--curve"}, "a chart needs results or a series"},
           {{"tiny", "more"}, "\"more\" is one argument too many"},
           {{"tiny", "--filed", "x"}, "the option --filed is not known (did you mean '--field'?"},
           {{"tiny", "-o", "a.jpg"}, "should have the suffix .png"},
           {{"tiny", "--curve", "tiny/history.csv:time:dt"}, "results or of series, not of both"},
           {{"tiny", "--copies", "4"}, "copies complete a sector of a part in space"},
           {{"tiny", "--frames", "0:3:1"}, "--frames and --fps are of films"},
           {{"tiny", "--output=~bob/a.png"}, "only '~/' stands for a home folder"}}) {
    const Outcome outcome = without_display(words);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_TRUE(outcome.says(says)) << outcome.err;
  }
  const Outcome component = render({"tiny", "--field", "stress:xw"});
  EXPECT_EQ(component.status, 2);
  EXPECT_TRUE(component.says("has no component \"xw\" (it has xx, yy, zz, xy, yz, xz)"))
      << component.err;
  const Outcome scene = without_display({"tiny"});
  EXPECT_EQ(scene.status, 6);
  EXPECT_TRUE(scene.says("install xvfb")) << scene.err;
}

} // namespace

} // namespace billet::test::render_test
