// Starts the program as a user would, and keeps what it said.

#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace billet::test {

/// What a finished program left behind.
struct Outcome {
  int status = -1; ///< exit status; 128 + number if a signal ended it
  bool crashed = false;
  std::string out; ///< standard output
  std::string err; ///< standard error

  [[nodiscard]] bool says(const std::string& text) const {
    return err.find(text) != std::string::npos;
  }
  [[nodiscard]] bool prints(const std::string& text) const {
    return out.find(text) != std::string::npos;
  }
};

inline std::string whole_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// How to start it.
struct Start {
  std::vector<std::string> words;         ///< after the name of the program
  std::filesystem::path folder = {};      ///< working folder; empty: this one
  std::function<void()> in_child = [] {}; ///< just before the program starts
  std::string program = BILLET_PROGRAM;   ///< another one than billet
};

/// The program while it runs.
class Program {
public:
  explicit Program(const Start& start) {
    std::vector<std::string> words{start.program};
    words.insert(words.end(), start.words.begin(), start.words.end());
    std::vector<char*> argv;
    for (std::string& word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);
    std::string out = (std::filesystem::path(testing::TempDir()) / "billet-out-XXXXXX").string();
    out_ = ::mkstemp(out.data());
    std::string err = (std::filesystem::path(testing::TempDir()) / "billet-err-XXXXXX").string();
    err_ = ::mkstemp(err.data());
    out_path_ = out;
    err_path_ = err;
    child_ = ::fork();
    if (child_ == 0) {
      ::dup2(out_, STDOUT_FILENO);
      ::dup2(err_, STDERR_FILENO);
      ::close(out_);
      ::close(err_);
      if (!start.folder.empty() && ::chdir(start.folder.c_str()) != 0)
        ::_exit(126);
      start.in_child();
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (!ended_) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
    ::close(out_);
    ::close(err_);
    std::filesystem::remove(out_path_);
    std::filesystem::remove(err_path_);
  }

  void signal(int number) const { ::kill(child_, number); }

  /// True as soon as `condition` holds, false if the program ends or time runs out before.
  bool wait_until(const std::function<bool()>& condition) const {
    const auto give_up = std::chrono::steady_clock::now() + longest;
    while (!condition()) {
      siginfo_t info{};
      ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT);
      if (info.si_pid != 0 || std::chrono::steady_clock::now() > give_up)
        return condition();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }

  Outcome end() {
    Outcome outcome;
    if (!wait_for_exit())
      ::kill(child_, SIGKILL); // shows as a crash below
    int status = 0;
    ::waitpid(child_, &status, 0);
    ended_ = true;
    outcome.crashed = WIFSIGNALED(status);
    outcome.status = outcome.crashed ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    outcome.out = whole_file(out_path_);
    outcome.err = whole_file(err_path_);
    return outcome;
  }

private:
  static constexpr std::chrono::seconds longest{60};

  [[nodiscard]] bool wait_for_exit() const {
    bool never = false;
    wait_until([&] { return never; });
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT);
    return info.si_pid != 0;
  }

  ::pid_t child_ = -1;
  int out_ = -1;
  int err_ = -1;
  std::filesystem::path out_path_;
  std::filesystem::path err_path_;
  bool ended_ = false;
};

/// Starts the program and waits for its end.
inline Outcome billet(std::vector<std::string> words, const std::filesystem::path& folder = {}) {
  return Program(Start{std::move(words), folder}).end();
}
inline Outcome billet(const Start& start) { return Program(start).end(); }

} // namespace billet::test
