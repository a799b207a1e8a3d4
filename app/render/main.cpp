// billet-render: pictures of results and curves. Needs a display (`billet render` starts one).

#include "app/render/chart.h"
#include "app/render/options.h"
#include "app/render/scene.h"
#include "geometry/base/error.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace {

/// VTK ends the program without a word where there is no display.
void require_display() {
  const char* display = std::getenv("DISPLAY");
  if (display == nullptr || *display == '\0')
    throw billet::Error(billet::Fault::usage, "DISPLAY", "there is no display to draw on",
                        "use `billet render`, or start it as `xvfb-run -a billet-render ...`");
}

} // namespace

int main(int count, char** values) {
  try {
    const auto options =
        billet::render::parse(std::vector<std::string>(values + 1, values + count));
    if (options.help) {
      std::fputs(billet::render::usage().c_str(), stdout);
      return 0;
    }
    require_display();
    options.curves ? billet::render::draw_chart(options) : billet::render::draw_scene(options);
    std::printf("picture: %s\n", options.output.c_str());
    return 0;
  } catch (const billet::Error& error) {
    std::fprintf(stderr, "billet-render: %s\n", error.what());
    return static_cast<int>(error.fault());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "billet-render: %s\n", error.what());
    return static_cast<int>(billet::Fault::input_output);
  }
}
