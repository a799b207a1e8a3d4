#include "app/report/frame_view.h"
#include "app/report/page.h"
#include "io/results/folder_lock.h"
#include "tests/app/report/made_results.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::report::page_test {
namespace {

class Page : public testing::Test {
protected:
  Page() { test::make_results(folder_.path()); }
  void end_with(const std::string& summary) const {
    test::write_text(folder_.path() / "summary.json", summary);
  }
  [[nodiscard]] std::string page(const PageSettings& settings = {}) const {
    return page_of(read_results(folder_.path()), settings);
  }
  [[nodiscard]] static PageSettings with_view() {
    PageSettings settings;
    settings.bundle = Bundle{"/* script </script> */", "/* style */", "Licence of X"};
    return settings;
  }

  test::TemporaryFolder folder_;
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Page, ShowsWhatTheResultsHave) {
  end_with(test::made_summary);
  const std::string html = page();
  for (const char* part :
       {"Forces over strokes", "Energies", "Certificate of penetration", "Residual of each",
        "id=\"tools\"", "id=\"wear\"", "id=\"window\"", "id=\"laps\"", "id=\"remeshing\"",
        "id=\"measures\"", "id=\"effort\"", "filling [-]", "full cavity", "100 → 140", "force [kN]",
        "element quality 0.19 &lt; 0.2, say", "0.25", "811"})
    EXPECT_TRUE(holds(html, part)) << part;
  EXPECT_FALSE(holds(html, "id=\"blows\"")); // there were none
}

TEST_F(Page, SaysThatForcesInPlaneStrainArePerThickness) {
  end_with(test::made_summary);
  EXPECT_FALSE(holds(page(), "[N/mm]"));
  std::string plane = test::made_case;
  plane.replace(plane.find("axisymmetric"), 12, "plane-strain");
  test::write_text(folder_.path() / "case.resolved.toml", plane);
  const std::string html = page();
  for (const char* part : {"last force<br><small>[N/mm]", "torque<br><small>[N mm/mm]", "[kN/mm]"})
    EXPECT_TRUE(holds(html, part)) << part;
}

TEST_F(Page, TakesTextsAsTexts) {
  end_with(test::made_summary);
  const std::string html = page(with_view());
  EXPECT_TRUE(holds(html, "Rings &amp; &lt;b&gt;discs&lt;/b&gt;"));
  EXPECT_TRUE(holds(html, "dies are &lt;small&gt;"));
  EXPECT_FALSE(holds(html, "<small>\n"));
  EXPECT_FALSE(holds(html, "/* script </script>"));
}

TEST_F(Page, LoadsNothing) {
  end_with(test::made_summary);
  const std::string html = page(with_view());
  for (const char* part : {"http://", "https://", " src=", "@import", "<link"})
    EXPECT_FALSE(holds(html, part)) << part;
  EXPECT_TRUE(holds(html, "default-src 'none'"));
}

TEST_F(Page, SaysHowTheViewIsToBeHad) {
  end_with(test::made_summary);
  EXPECT_TRUE(holds(page(), "./dev build --report"));
  EXPECT_FALSE(holds(page(), "blob-0"));
  EXPECT_TRUE(holds(page(with_view()), "id=\"blob-0\""));
}

TEST_F(Page, IsRightOfARunThatWasKilled) {
  const std::string html = page(with_view());
  EXPECT_TRUE(holds(html, "<strong>killed</strong>"));
  EXPECT_TRUE(holds(html, "time 1 of 2 s (50 %)"));
  EXPECT_TRUE(holds(html, "dies are &lt;small&gt;")); // from the log
  EXPECT_TRUE(holds(html, "a [[support]]"));
  EXPECT_TRUE(holds(html, "id=\"tools\""));
}

TEST_F(Page, AsksForItselfAgainAsLongAsTheRunGoesOn) {
  const io::FolderLock lock(folder_.path());
  PageSettings settings = with_view();
  settings.reload_after = 7;
  const std::string html = page(settings);
  EXPECT_TRUE(holds(html, "<strong>running</strong>"));
  EXPECT_TRUE(holds(html, "name=\"reload-after\" content=\"7\""));
  settings.bundle.reset();
  EXPECT_TRUE(holds(page(settings), "http-equiv=\"refresh\" content=\"7\""));
}

TEST_F(Page, ShowsAFailure) {
  end_with(R"({"status": "not-converged", "exit_status": 5, "failed_checks": [],
               "failure": {"time": 1.5, "reason": "no <equilibrium>"}})");
  std::filesystem::create_directories(folder_.path() / "failure");
  test::write_text(folder_.path() / "failure" / "post_mortem.txt", "node 7 & others\n");
  const std::string html = page();
  EXPECT_TRUE(holds(html, "<strong>not-converged</strong>"));
  EXPECT_TRUE(holds(html, "Time 1.5 s could not be reached: no &lt;equilibrium&gt;"));
  EXPECT_TRUE(holds(html, "node 7 &amp; others"));
}

TEST_F(Page, LivesWithHalfTheFiles) {
  namespace fs = std::filesystem;
  test::write_text(folder_.path() / "history.csv", test::made_history + "3,1.5,0.5,3");
  test::write_text(folder_.path() / "summary.json", "{\"status\": ");
  fs::remove(folder_.path() / "frames" / "workpiece_0000.vtu");
  test::write_text(folder_.path() / "frames" / "tool-punch_0001.vtp", "<VTKFile");
  const std::string html = page(with_view());
  EXPECT_TRUE(holds(html, "time 1 of 2 s"));
  EXPECT_TRUE(holds(html, "is damaged"));
  const FrameView view = frame_view(read_results(folder_.path()), 1'000'000);
  EXPECT_EQ(view.scene["frames"].size(), 1U);
  for (const char* file : {"history.csv", "iterations.csv", "rings.pvd", "run.log"})
    fs::remove(folder_.path() / file);
  EXPECT_TRUE(holds(page(with_view()), "There are no frames to show."));
}

TEST_F(Page, DescribesTheFrames) {
  const FrameView view = frame_view(read_results(folder_.path()), 1'000'000);
  EXPECT_EQ(view.scene["frames"].size(), 2U);
  EXPECT_EQ(view.scene["meshes"].size(), 1U); // both share it
  EXPECT_EQ(view.scene["shapes"].size(), 1U); // the tool travels
  EXPECT_EQ(view.scene["fields"]["gap"]["on"], "contact");
  EXPECT_EQ(view.scene["fields"]["von_mises"]["unit"], "MPa");
  EXPECT_EQ(view.scene["fields"]["element_quality"]["on"], "elements");
  EXPECT_EQ(view.scene["axisymmetric"], true);
  ASSERT_EQ(view.scene["symmetry"].size(), 1U); // y = 1 and y = 2 are a slice's ends
  EXPECT_EQ(view.scene["symmetry"][0]["axis"], 0);
  EXPECT_EQ(view.scene["frames"][1]["tools"][0]["pose"][7], -1.0);
}

TEST_F(Page, SaysWhatItLeavesOutForItsSize) {
  const ResultsFolder results = read_results(folder_.path());
  std::size_t whole = 0;
  for (const std::string& blob : frame_view(results, 1'000'000).blobs)
    whole += blob.size();
  const FrameView less = frame_view(results, whole - 1);
  std::size_t size = 0;
  for (const std::string& blob : less.blobs)
    size += blob.size();
  EXPECT_LT(size, whole);
  EXPECT_GT(size, 0U);
  EXPECT_FALSE(less.notes.empty());
  const FrameView nothing = frame_view(results, 10);
  EXPECT_TRUE(nothing.scene.is_null());
  ASSERT_FALSE(nothing.notes.empty());
  EXPECT_TRUE(holds(nothing.notes.back(), "too large"));
}

} // namespace
} // namespace billet::report::page_test
