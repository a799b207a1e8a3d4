// What pictures and films show, by their pixels.

#include "tests/app/pixels.h"
#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

namespace billet::test::render_pictures_test {

namespace {

/// Shares of a picture: all but the scale of colours, the title and the caption.
constexpr std::array scene{0.0, 0.12, 0.69, 0.86};

/// Runs are made once for all tests of the program.
class RenderPictures : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_text(folder_->path() / "tiny.toml", upsetting);
    write_text(folder_->path() / "solid.toml",
               edited(upsetting, {{"\"axisymmetric\"", "\"3d\""},
                                  {"\"quad8\"", "\"hex8\""},
                                  {"{ box = [[0, 0], [5, 7.5]], cells = [2, 3] }",
                                   "{ box = [[0, 0, 0], [5, 7.5, 5]], cells = [3, 3, 3] }"},
                                  {"point = [0, 7.5], normal = [0, -1]",
                                   "point = [0, 7.5, 0], normal = [0, -1, 0]"},
                                  {"velocity = [0, -1]", "velocity = [0, -1, 0]"}}) +
                   "\n[[support]]\nwhere = \"z = 0\"\nfix   = [\"z\"]\n");
    for (const char* name : {"tiny", "solid"}) {
      const Outcome run =
          billet({"run", std::string(name) + ".toml", "--quiet", "-o", name}, folder_->path());
      ASSERT_EQ(run.status, 0) << run.err;
    }
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  void SetUp() override {
    const std::filesystem::path program(BILLET_PROGRAM);
    if (!std::filesystem::exists(program.parent_path() / "billet-render"))
      GTEST_SKIP() << "built without billet-render";
  }
  [[nodiscard]] static Outcome render(std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    return billet(Start{std::move(words), folder_->path(), [] { ::unsetenv("DISPLAY"); }});
  }
  /// Draws a small picture.
  [[nodiscard]] static Pixels drawn(std::vector<std::string> words) {
    words.insert(words.end(), {"-o", "a.png", "--size", "240x180"});
    const Outcome outcome = render(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Pixels(folder_->path() / "a.png");
  }
  [[nodiscard]] static std::string complaint(const std::vector<std::string>& words) {
    const Outcome outcome = render(words);
    EXPECT_NE(outcome.status, 0) << outcome.out;
    return outcome.err;
  }

  static TemporaryFolder* folder_;
};
TemporaryFolder* RenderPictures::folder_ = nullptr;

/// Where the part is: the columns or rows of its colours.
std::array<int, 4> box_of(const Pixels& picture) {
  std::array<int, 4> box{picture.width(), picture.height(), 0, 0};
  for (int y = picture.height() / 8; y < picture.height() * 7 / 8; ++y)
    for (int x = 0; x < picture.width() * 69 / 100; ++x)
      if (is_coloured(picture.at(x, y)))
        box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
  return box;
}

TEST_F(RenderPictures, crops_nothing) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"tiny"},
        {"solid", "--view", "iso"},
        {"solid", "--view", "-130,-20", "--mirror"},
        {"tiny", "--revolve", "200"},
        {"tiny", "--title",
         "A title that is a great deal longer than the picture is wide, so long "
         "that no letter can be read any more when all of it is in it"},
        {"tiny", "--times", "0,last", "--field", "displacement"}}) {
    const Pixels picture = drawn(words);
    EXPECT_TRUE(picture.has_white_rim()) << words.back();
    EXPECT_GT(picture.count(scene, is_coloured), 800) << words.back();
  }
}

TEST_F(RenderPictures, glass_leaves_the_colours_of_the_part) {
  const std::vector<std::string> words{"solid", "--field", "strain", "--view",
                                       "40,60", "--up",    "y",      "--no-mesh"};
  const auto with_tools = [&](const char* style) {
    std::vector<std::string> all = words;
    // In the same place: the part alone is larger in its picture.
    all.insert(all.end(), {"--tools", style, "--focus", "2.5,3.7,2.5", "--zoom", "1"});
    return all;
  };
  const Pixels glass = drawn(with_tools("glass")), solid = drawn(with_tools("solid"));
  const Pixels outline = drawn(with_tools("outline"));
  int same = 0, coloured = 0;
  for (int y = 22; y < 155; ++y)
    for (int x = 0; x < 165; ++x)
      if (is_coloured(outline.at(x, y))) {
        ++coloured;
        constexpr int levels = 3;
        bool is_same = true;
        for (std::size_t c = 0; c < 3; ++c)
          is_same = is_same && std::abs(outline.at(x, y)[c] - glass.at(x, y)[c]) <= levels;
        same += is_same ? 1 : 0;
      }
  EXPECT_GT(coloured, 1000);
  EXPECT_GT(same, 0.985 * coloured) << "but for pixels that the rim of the part shares";
  // The glass itself is seen, and a solid tool hides the part.
  const auto is_glass = [](const Pixel& p) { return !is_coloured(p) && p[0] > 150 && p[0] < 245; };
  EXPECT_GT(glass.count(scene, is_glass), outline.count(scene, is_glass) + 500);
  EXPECT_LT(solid.count(scene, is_coloured), coloured);
}

TEST_F(RenderPictures, a_cut_shows_what_is_inside) {
  // Displacement along y goes from 0 at the foot to -0.1 at the punch: from above only the top of
  // the range is seen, in a cut across y the value there.
  const std::vector<std::string> view{"solid",  "--field", "displacement:y", "--range", "-0.1:0",
                                      "--view", "y",       "--no-mesh",      "--tools", "none"};
  const Pixels whole = drawn(view);
  std::vector<std::string> words = view;
  words.insert(words.end(), {"--cut", "y=3.7"});
  const Pixels half = drawn(words);
  const auto middle = [](const Pixels& p) { return p.at(83, 90); };
  const Pixel top = middle(whole), inside = middle(half);
  EXPECT_LT(top[1], 60) << "dark: the lowest value";
  EXPECT_GT(inside[1], 120) << "green: half of it";
  // The cap closes the part: as large as the face.
  EXPECT_NEAR(half.count(scene, is_coloured), whole.count(scene, is_coloured),
              0.05 * whole.count(scene, is_coloured));
  // Two planes take a quarter only.
  const std::vector<std::string> sides{"solid", "--no-mesh", "--tools", "none",    "--view",
                                       "z",     "--up",      "y",       "--field", "strain"};
  std::vector<std::string> one = sides, two = sides;
  one.insert(one.end(), {"--cut", "x>2.5", "--focus", "2.5,3.7,2.5"});
  two.insert(two.end(), {"--cut", "x>2.5,y>3.7", "--focus", "2.5,3.7,2.5"});
  const int n_one = drawn(one).count(scene, is_coloured);
  const int n_two = drawn(two).count(scene, is_coloured);
  EXPECT_GT(n_two, 1.3 * n_one);
  EXPECT_NE(complaint({"solid", "--cut", "x=30"}).find("it reaches from x=0 to 5."),
            std::string::npos);
}

TEST_F(RenderPictures, bands_have_as_many_colours_as_asked_for) {
  constexpr int n_bands = 6;
  const Pixels picture = drawn({"tiny", "--field", "displacement:y", "--bands", "6", "--no-mesh",
                                "--tools", "none", "--range", "-0.1:0"});
  std::set<Pixel> colours;
  for (const auto& [colour, count] : picture.colours(scene))
    if (is_coloured(colour) && count > 400) // fewer are on rims, which mix two
      colours.insert(colour);
  EXPECT_EQ(colours.size(), std::size_t{n_bands});
}

TEST_F(RenderPictures, images_are_as_what_they_are_images_of) {
  // An axisymmetric scene shows both halves.
  const Pixels halves = drawn({"tiny", "--field", "displacement", "--no-mesh", "--tools", "none"});
  const std::array<int, 4> box = box_of(halves);
  int off = 0, all = 0;
  for (int y = box[1]; y <= box[3]; ++y)
    for (int x = box[0]; x <= box[2]; ++x) {
      const Pixel a = halves.at(x, y), b = halves.at(box[0] + box[2] - x, y);
      ++all;
      off += std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) > 40 ? 1 : 0;
    }
  EXPECT_LT(off, all / 50);
  const std::array<int, 4> one =
      box_of(drawn({"tiny", "--no-mirror", "--tools", "none", "--no-mesh"}));
  const double shape = static_cast<double>(box[2] - box[0]) / (box[3] - box[1]);
  EXPECT_NEAR(static_cast<double>(one[2] - one[0]) / (one[3] - one[1]), 0.5 * shape, 0.05);
  // The frames know the planes of symmetry: an eighth becomes a whole.
  const std::vector<std::string> sides{"solid", "--view", "z", "--up", "y", "--tools", "none"};
  std::vector<std::string> whole = sides;
  whole.push_back("--mirror=x");
  const std::array<int, 4> half = box_of(drawn(sides)), both = box_of(drawn(whole));
  EXPECT_NEAR(static_cast<double>(both[2] - both[0]) / (both[3] - both[1]),
              2.0 * (half[2] - half[0]) / (half[3] - half[1]), 0.1);
  EXPECT_NE(complaint({"solid", "--mirror", "x=2.5"}).find("lies on both sides of x=2.5"),
            std::string::npos);
}

TEST_F(RenderPictures, frames_name_planes_of_symmetry_and_units) {
  const std::string frame = whole_file(folder_->path() / "solid/frames/workpiece_0000.vtu");
  EXPECT_NE(frame.find("symmetry: x = 0, y = 0, z = 0"), std::string::npos);
  EXPECT_NE(frame.find("name=\"UNITS_LABEL\""), std::string::npos);
}

TEST_F(RenderPictures, fields_of_contact_are_drawn_on_faces_and_tools) {
  const Pixels gap = drawn({"tiny", "--field", "gap"}); // the contact faces alone have it
  EXPECT_GT(gap.count(scene, is_coloured), 20);
  const Pixels pressure = drawn({"solid", "--on", "tools", "--field", "pressure", "--view", "-y"});
  EXPECT_GT(pressure.count(scene, is_coloured), 500);
  const std::string unknown = complaint({"tiny", "--field", "von_misse"});
  EXPECT_NE(unknown.find("did you mean 'von_mises'?"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("they have displacement, "), std::string::npos) << unknown;
  EXPECT_NE(complaint({"tiny", "--on", "tool"}).find("did you mean 'tools'?"), std::string::npos);
}

TEST_F(RenderPictures, arrows_are_red_and_point_as_the_vectors_do) {
  const auto is_red = [](const Pixel& p) { return p[0] > 150 && p[1] < 80 && p[2] < 100; };
  const Pixels picture = drawn({"tiny", "--field", "none", "--arrows", "velocity", "--no-mesh"});
  EXPECT_GT(picture.count(scene, is_red), 50);
  EXPECT_TRUE(picture.has_white_rim());
  EXPECT_NE(complaint({"tiny", "--arrows", "von_mises"}).find("is not a vector"),
            std::string::npos);
}

TEST_F(RenderPictures, a_series_has_a_picture_of_each_frame_at_one_scale) {
  const Outcome film =
      render({"tiny", "-o", "film_%03d.png", "--size", "160x120", "--field", "displacement:y",
              "--frames", "0:4:2", "--tools", "none", "--no-mesh"});
  EXPECT_EQ(film.status, 0) << film.err;
  EXPECT_TRUE(film.prints("frames: 3, film_000.png to film_002.png")) << film.out;
  const Pixels first(folder_->path() / "film_000.png"), last(folder_->path() / "film_002.png");
  const std::array<int, 4> a = box_of(first), b = box_of(last);
  EXPECT_EQ(a[1], b[1]) << "the foot stays where it is";
  EXPECT_LE(b[3], a[3]);
  EXPECT_NE(complaint({"tiny", "-o", "film_%s.png"}).find("film_%04d.png"), std::string::npos);
  EXPECT_NE(
      complaint({"tiny", "-o", "film_%03d.png", "--frames", "90:"}).find("there is no frame 90"),
      std::string::npos);
}

TEST_F(RenderPictures, films_need_ffmpeg_and_say_so) {
  const Outcome without = billet(Start{{"render", "tiny", "-o", "a.gif"}, folder_->path(), [] {
                                         ::setenv("DISPLAY", ":99", 1);
                                         ::setenv("PATH", "/nowhere", 1);
                                       }});
  EXPECT_EQ(without.status, 6);
  EXPECT_TRUE(without.says("apt-get install ffmpeg")) << without.err;
  EXPECT_FALSE(std::filesystem::exists(folder_->path() / "a.gif"));
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* name : {"a.gif", "a.mp4"}) {
    const Outcome film =
        render({"tiny", "-o", name, "--size", "161x121", "--frames", "0:2", "--fps", "5"});
    EXPECT_EQ(film.status, 0) << film.err;
    EXPECT_GT(std::filesystem::file_size(folder_->path() / name), 1000U);
  }
  EXPECT_TRUE(whole_file(folder_->path() / "a.gif").starts_with("GIF89a"));
  EXPECT_EQ(whole_file(folder_->path() / "a.mp4").substr(4, 4), "ftyp");
}

TEST_F(RenderPictures, results_stand_next_to_each_other) {
  const Pixels pair = drawn({"tiny", "--compare", "solid", "--view", "z", "--up", "y"});
  constexpr std::array left{0.0, 0.12, 0.34, 0.86}, right{0.35, 0.12, 0.69, 0.86};
  EXPECT_GT(pair.count(left, is_coloured), 200);
  EXPECT_GT(pair.count(right, is_coloured), 200);
}

TEST_F(RenderPictures, charts_have_columns_of_several_results) {
  const Outcome chart = render({"tiny", "solid", "--curve", "time:-punch.force_y", "-o", "c.png"});
  EXPECT_EQ(chart.status, 0) << chart.err;
  EXPECT_TRUE(chart.prints("curve: tiny: -punch.force_y")) << chart.out;
  EXPECT_TRUE(chart.prints("curve: solid: -punch.force_y")) << chart.out;
  EXPECT_TRUE(chart.prints("axes: -punch.force_y [N] over time [s]")) << chart.out;
  const Outcome two = render({"tiny", "--curve=time:plastic_work,friction_work"});
  EXPECT_TRUE(two.prints("picture: tiny/history.png")) << two.out << two.err;
  EXPECT_TRUE(two.prints("axes: [N mm] over time [s]")) << two.out;
  const Outcome strokes = render({"tiny", "solid", "--curve", "-o", "c.png"});
  EXPECT_TRUE(strokes.prints("curve: solid: punch")) << strokes.out << strokes.err;
  const std::string unknown = complaint({"tiny", "--curve", "time:plastic_wrok"});
  EXPECT_NE(unknown.find("did you mean 'plastic_work'?"), std::string::npos) << unknown;
}

TEST_F(RenderPictures, mistakes_in_views_and_planes_say_what_is_right) {
  struct Mistake {
    std::vector<std::string> words;
    std::string says;
  };
  for (const auto& [words, says] :
       std::vector<Mistake>{{{"solid", "--view", "top"}, "is not a view"},
                            {{"solid", "--view", "0,120"}, "should be from -90 to 90"},
                            {{"tiny", "--view", "x"}, "a scene of the plane is seen from z only"},
                            {{"solid", "--cut", "3.5"}, "is not a plane: x=3.5"},
                            {{"solid", "--revolve"}, "the scene is not axisymmetric"},
                            {{"tiny", "--mirror", "z"}, "no plane of symmetry across z"},
                            {{"tiny", "--tools", "glas"}, "did you mean 'glass'?"},
                            {{"tiny", "--bands", "1"}, "is not a number of colours from 2 to 64"},
                            {{"tiny", "--time", "abc"}, "--time: \"abc\" is not a number"},
                            {{"tiny", "solid"}, "--compare OTHER draws two next to each other"},
                            {{"tiny", "--compare", "nothing"}, "there are no such results"},
                            {{"tiny", "--range", "1:0"}, "a low value below the high one"},
                            {{"tiny", "--animate", "-o", "a.png"}, ".gif or .mp4"}})
    EXPECT_NE(complaint(words).find(says), std::string::npos) << complaint(words);
}

} // namespace

} // namespace billet::test::render_pictures_test
