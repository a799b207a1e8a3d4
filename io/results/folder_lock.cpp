#include "io/results/folder_lock.h"

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

namespace billet::io {

namespace {

/// The process that holds a lock, as the file says.
struct Holder {
  long process = 0;
  std::string machine;
  std::string boot;  ///< differs each time that the machine is started
  std::string begun; ///< of the process, in the system's own count: numbers are given again
  std::string since; ///< date and time at which it took the lock
};

std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// When a process began, in the system's own count; empty: there is none of that number.
std::string begin_of(long process) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", process));
  const std::size_t name_end = line.rfind(')'); // the name may hold anything
  if (name_end == std::string::npos)
    return {};
  std::istringstream rest(line.substr(name_end + 1));
  constexpr int field = 22; // the first after the name is number 3
  std::string word;
  for (int i = 3; i <= field; ++i)
    rest >> word;
  return word;
}

Holder this_process() {
  std::array<char, 256> machine{};
  ::gethostname(machine.data(), machine.size() - 1);
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::array<char, 64> since{};
  std::strftime(since.data(), since.size(), "%Y-%m-%d %H:%M:%S %z", &local);
  const long process = ::getpid();
  return {process, machine.data(), first_line("/proc/sys/kernel/random/boot_id"), begin_of(process),
          since.data()};
}

std::string text_of(const Holder& holder) {
  return fmt::format("process {}\nmachine {}\nboot {}\nbegun {}\nsince {}\n", holder.process,
                     holder.machine, holder.boot, holder.begun, holder.since);
}

/// What the file says; `since` stays empty if it does not say all.
Holder read_holder(const std::filesystem::path& path) {
  Holder holder;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line) && !stream.eof();) {
    const std::size_t space = std::min(line.find(' '), line.size());
    const std::string key = line.substr(0, space);
    const std::string value = line.substr(std::min(space + 1, line.size()));
    if (key == "process")
      holder.process = std::strtol(value.c_str(), nullptr, 10);
    else if (key == "machine")
      holder.machine = value;
    else if (key == "boot")
      holder.boot = value;
    else if (key == "begun")
      holder.begun = value;
    else if (key == "since")
      holder.since = value;
  }
  return holder;
}

/// The same, of a file that may be about to be written.
Holder holder_soon(const std::filesystem::path& path) {
  constexpr int most_looks = 50;
  Holder holder = read_holder(path);
  for (int look = 0; holder.since.empty() && look < most_looks; ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    holder = read_holder(path);
  }
  return holder;
}

bool may_be_running(const Holder& holder) {
  const Holder here = this_process();
  if (holder.machine != here.machine)
    return true;
  return holder.boot == here.boot && begin_of(holder.process) == holder.begun;
}

[[noreturn]] void
refuse(const std::filesystem::path& folder, const Holder& holder, const std::string& more = {}) {
  const std::string who =
      holder.since.empty()
          ? std::string("one that has just begun")
          : fmt::format("process {} on {}, since {}", holder.process, holder.machine, holder.since);
  throw Error(Fault::input_output, folder.string(), "another run writes its results here: " + who,
              "wait for its end, or choose another folder with -o" + more,
              error_code::folder_in_use);
}

} // namespace

std::optional<WritingRun> run_writing_to(const std::filesystem::path& folder) {
  const Holder holder = read_holder(folder / ".billet.lock");
  if (holder.since.empty() || !may_be_running(holder))
    return std::nullopt;
  return WritingRun{holder.process, holder.machine, holder.since};
}

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(folder), path_(folder / ".billet.lock") {
  while (!take())
    ::close(std::exchange(file_, -1));
  const std::string text = text_of(this_process());
  int reason = ::ftruncate(file_, 0) == 0 ? 0 : errno;
  if (reason == 0)
    reason = write_all(file_, text);
  if (reason != 0) {
    ::unlink(path_.c_str());
    ::close(file_);
    cannot_write(path_, reason);
  }
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str()); // before the lock ends, lest it be that of the next
  ::close(file_);
}

/// @return whether the lock is held; false: the run that held the file's lock has just removed it
bool FolderLock::take() {
  constexpr ::mode_t permissions = 0666; // less what the user masks
  constexpr int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW;
  file_ = ::open(path_.c_str(), flags | O_CREAT | O_EXCL, permissions);
  const bool is_new = file_ >= 0;
  if (!is_new && errno == EEXIST) {
    file_ = ::open(path_.c_str(), flags);
    if (file_ < 0 && errno == ENOENT)
      return false;
  }
  if (file_ < 0)
    cannot_write(path_, errno);
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    if (reason == EWOULDBLOCK || reason == EACCES) {
      ::close(file_);
      refuse(folder_, holder_soon(path_));
    }
    take_without_locks(is_new);
  }
  struct ::stat held {};
  struct ::stat there {};
  return ::fstat(file_, &held) == 0 && ::stat(path_.c_str(), &there) == 0 &&
         held.st_ino == there.st_ino && held.st_dev == there.st_dev;
}

/// Two that find the file of a run that has ended at the same instant both go on: without locks
/// nothing better is to be had.
void FolderLock::take_without_locks(bool is_new) {
  if (is_new)
    return;
  const Holder holder = holder_soon(path_);
  if (!holder.since.empty() && !may_be_running(holder))
    return;
  ::close(file_);
  refuse(folder_, holder, fmt::format("; if it has ended, remove {}", path_.string()));
}

} // namespace billet::io
