// billet render: goes on as billet-render, the program beside this one.

#include "app/command_line.h"
#include "geometry/base/error.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace billet::app {

int render_results(const Arguments& arguments) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path renderer = self.parent_path() / "billet-render";
  if (!std::filesystem::exists(renderer))
    throw Error(Fault::input_output, renderer.string(), "the renderer is not there",
                "build it: ./dev build");
  std::vector<std::string> words{renderer.string()};
  words.insert(words.end(), arguments.rest.begin(), arguments.rest.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  std::fflush(stdout);
  ::execv(argv[0], argv.data());
  throw Error(Fault::input_output, renderer.string(),
              std::string("the renderer cannot be started: ") + std::strerror(errno));
}

} // namespace billet::app
