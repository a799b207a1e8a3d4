// As if the disk were full: no file of this process may grow beyond a size.

#pragma once

#include <sys/resource.h>

#include <csignal>

namespace billet::test {

class FullDisk {
public:
  explicit FullDisk(::rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const ::rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

private:
  ::rlimit before_{};
  void (*handler_)(int) = nullptr;
};

} // namespace billet::test
