#include "app/render/display.h"

#include "geometry/base/error.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace billet::render {

void require_display(char** values) {
  const char* const display = std::getenv("DISPLAY");
  if (display != nullptr && *display != '\0')
    return;
  std::vector<std::string> words{"xvfb-run", "-a", "-s", "-screen 0 1600x1200x24",
                                 std::filesystem::read_symlink("/proc/self/exe").string()};
  for (char** value = values + 1; *value != nullptr; ++value)
    words.emplace_back(*value);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  throw Error(Fault::input_output, "xvfb-run",
              std::string("there is no display, and none can be started: ") + std::strerror(errno),
              "install xvfb and xauth, or set DISPLAY; curves need none");
}

} // namespace billet::render
