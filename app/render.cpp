// billet render: continues as billet-render, the program in the same folder as this one.

#include "app/render.h"

#include "app/command_line.h"
#include "app/processor.h"
#include "geometry/base/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "study/local_engine.h"
#include "study/runs.h"

namespace billet::app {

namespace {

std::filesystem::path renderer() { return own_file().parent_path() / "billet-render"; }

} // namespace

std::filesystem::path own_file() {
  return started_program(std::filesystem::read_symlink("/proc/self/exe"));
}

void draw_curves(const std::vector<std::string>& arguments,
                 const std::function<void(const std::string&)>& say) {
  if (!std::filesystem::exists(renderer())) {
    say("no picture is drawn: billet-render is not there");
    return;
  }
  std::vector<std::string> command{renderer().string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  int status = 0;
  study::run_jobs(
      {{command, "/dev/null"}}, 1, [] { return false; },
      [&](std::size_t /*job*/, int ended) { status = ended; });
  if (status == 0)
    return;
  std::string line;
  for (const std::string& word : command)
    line.append(" ").append(study::quoted(word));
  say(fmt::format("a picture could not be drawn (status {}); this tells why:{}", status, line));
}

int render_results(const Arguments& arguments) {
  const std::filesystem::path program = renderer();
  if (!std::filesystem::exists(program))
    throw Error(Fault::input_output, program.string(), "the renderer is not there",
                "build it: ./dev build");
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.rest.begin(), arguments.rest.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  std::fflush(stdout);
  ::execv(argv[0], argv.data());
  throw Error(Fault::input_output, program.string(),
              std::string("the renderer cannot be started: ") + std::strerror(errno));
}

} // namespace billet::app
