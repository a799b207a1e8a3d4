#include "app/render/display.h"

#include "geometry/base/error.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace billet::render {

namespace {

/// Becomes Xvfb, which writes the number of its display to standard output.
[[noreturn]] void become_server(int output) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM); // ends with us, however we end
  ::dup2(output, STDOUT_FILENO);
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0)
    ::dup2(nowhere, STDERR_FILENO);
  ::execlp("Xvfb", "Xvfb", "-displayfd", "1", "-screen", "0", "1600x1200x24", "-nolisten", "tcp",
           nullptr);
  ::_exit(1);
}

/// What a process writes until the end of a line or of itself.
std::string line_from(int input) {
  std::string line;
  char c = 0;
  for (;;) {
    const ::ssize_t n = ::read(input, &c, 1);
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0 || c == '\n')
      return line;
    line += c;
  }
}

} // namespace

Display::Display() {
  const char* const display = std::getenv("DISPLAY");
  if (display != nullptr && *display != '\0')
    return;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) == 0)
    server_ = ::fork();
  if (server_ < 0)
    throw Error(Fault::limit, "",
                std::string("no process can be started: ") + std::strerror(errno));
  if (server_ == 0)
    become_server(ends[1]);
  ::close(ends[1]);
  const std::string number = line_from(ends[0]);
  ::close(ends[0]);
  if (number.empty()) {
    ::waitpid(server_, nullptr, 0);
    throw Error(Fault::input_output, "Xvfb", "there is no display, and Xvfb does not start",
                "install xvfb, or set DISPLAY; curves need none");
  }
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

Display::~Display() {
  if (server_ > 0) {
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
  }
}

} // namespace billet::render
