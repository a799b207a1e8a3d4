// billet render: starts billet-render, under Xvfb where there is no display.

#include "app/command_line.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace billet::app {

int render_results(const Arguments& arguments) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path renderer = self.parent_path() / "billet-render";
  if (!std::filesystem::exists(renderer))
    throw Error(Fault::input_output, renderer.string(), "the renderer is not there",
                "build it: ./dev build");
  std::vector<std::string> words;
  if (std::getenv("DISPLAY") == nullptr)
    words = {"xvfb-run", "-a", "-s", "-screen 0 1600x1200x24"};
  words.push_back(renderer.string());
  words.push_back(arguments.file);
  words.insert(words.end(), arguments.rest.begin(), arguments.rest.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    execvp(argv[0], argv.data());
    std::fprintf(stderr, "billet: cannot start %s: %s (install xvfb, or set DISPLAY)\n", argv[0],
                 std::strerror(errno));
    _exit(static_cast<int>(Fault::input_output));
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0)
    throw Error(Fault::input_output, "",
                std::string("cannot start the renderer: ") + std::strerror(errno));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 70;
}

} // namespace billet::app
