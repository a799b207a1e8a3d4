// billet-render: pictures of results and curves. Scenes need a display, and start one of Xvfb's
// where there is none; curves need none.

#include "app/render/chart.h"
#include "app/render/film.h"
#include "app/render/options.h"
#include "app/render/scene.h"
#include "app/render/usage.h"
#include "geometry/base/error.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

int main(int count, char** values) {
  try {
    const auto options =
        billet::render::parse(std::vector<std::string>(values + 1, values + count));
    if (options.help) {
      std::fputs(billet::render::usage_text.data(), stdout);
      return 0;
    }
    const std::filesystem::path picture = billet::render::picture_file(options);
    std::string shown;
    if (options.chart.wanted) {
      shown = billet::render::draw_chart(options, picture);
    } else {
      shown = options.film.wanted ? billet::render::draw_film(options, picture)
                                  : billet::render::draw_scene(options, picture);
    }
    std::printf("%s: %s\n%s\n", options.film.wanted ? "film" : "picture", picture.c_str(),
                shown.c_str());
    return 0;
  } catch (const billet::Error& error) {
    std::fprintf(stderr, "billet-render: %s\n", error.what());
    return static_cast<int>(error.fault());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "billet-render: %s [file]\n", error.what());
    return static_cast<int>(billet::Fault::input_output);
  }
}
