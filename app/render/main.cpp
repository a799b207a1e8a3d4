// billet-render: pictures of results and curves. Scenes need a display, and start one of Xvfb's
// where there is none; curves need none.

#include "app/render/chart.h"
#include "app/render/display.h"
#include "app/render/options.h"
#include "app/render/scene.h"
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
      std::fputs(billet::render::usage().c_str(), stdout);
      return 0;
    }
    const std::filesystem::path picture = billet::render::picture_file(options);
    std::string shown;
    if (options.curves) {
      shown = billet::render::draw_chart(options, picture);
    } else {
      const billet::render::Display display;
      shown = billet::render::draw_scene(options, picture);
    }
    std::printf("picture: %s\n%s\n", picture.c_str(), shown.c_str());
    return 0;
  } catch (const billet::Error& error) {
    std::fprintf(stderr, "billet-render: %s\n", error.what());
    return static_cast<int>(error.fault());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "billet-render: %s\n", error.what());
    return static_cast<int>(billet::Fault::input_output);
  }
}
