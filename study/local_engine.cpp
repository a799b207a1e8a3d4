#include "study/local_engine.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

namespace billet::study {

namespace {

constexpr int cannot_start = 127, by_signal = 128;

/// @return its process; -1: there is no more room for one
pid_t start(const Job& job) {
  std::vector<char*> words;
  for (const std::string& word : job.command)
    words.push_back(const_cast<char*>(word.c_str())); // NOLINT: execv takes what it does not change
  words.push_back(nullptr);
  const std::string output = job.output.string();
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child != 0)
    return child;
  // Only what is safe between fork and exec.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL); // at once: a study that goes on may begin with the same run
  if (::getppid() != parent)
    ::_exit(cannot_start);
  const int in = ::open("/dev/null", O_RDONLY);
  const int out = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (in < 0 || out < 0)
    ::_exit(cannot_start);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  ::execv(words[0], words.data());
  ::_exit(cannot_start);
}

int status_of(int waited) {
  return WIFEXITED(waited) ? WEXITSTATUS(waited) : by_signal + WTERMSIG(waited);
}

} // namespace

void run_jobs(const std::vector<Job>& jobs,
              int processes,
              const std::function<bool()>& stopped,
              const std::function<void(std::size_t job, int status)>& ended) {
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  bool told = false;
  while (next < jobs.size() || !running.empty()) {
    const bool stops = stopped();
    while (!stops && next < jobs.size() && running.size() < static_cast<std::size_t>(processes)) {
      const pid_t child = start(jobs[next]);
      if (child > 0)
        running.emplace(child, next++);
      else if (running.empty())
        ended(next++, cannot_start);
      else
        break; // one that ends makes room
    }
    if (stops) {
      next = jobs.size();
      for (const auto& [child, job] : running)
        if (!told)
          ::kill(child, SIGTERM);
      told = true;
    }
    int waited = 0;
    const pid_t child = ::waitpid(-1, &waited, WNOHANG);
    if (const auto found = running.find(child); child > 0 && found != running.end()) {
      const std::size_t job = found->second;
      running.erase(found);
      ended(job, status_of(waited));
    } else if (child == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } else if (child < 0 && errno == ECHILD && running.empty() && next >= jobs.size()) {
      return;
    }
  }
}

} // namespace billet::study
