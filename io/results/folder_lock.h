// One run at a time writes into a folder.
//
// The lock is the system's, on a hidden file: it ends with the process that holds it, however that
// ends. A run that was killed, or a machine that went down, leaves the file without a lock, and the
// next run takes it over. The file says who holds it. Where a file system has no locks (some that
// are shared by many machines), that decides: a process that has ended, or was before this machine
// was started, counts no more; of another machine nobody can tell.
//
// Reading results needs no lock: every file in the folder is whole at any time.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace billet::io {

/// The run that writes into a folder.
struct WritingRun {
  long process = 0;
  std::string machine;
  std::string since; ///< date and time
};

/// The run that writes into a folder now, or may do so on another machine; none: it has ended, or
/// was killed. Takes no lock.
[[nodiscard]] std::optional<WritingRun> run_writing_to(const std::filesystem::path& folder);

/// Held as long as it lives; then its file goes away.
class FolderLock {
public:
  /// @throws Error  (Fault::input_output) if another run holds it, with process, machine and time
  ///                of its start; if the file cannot be written
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  [[nodiscard]] bool take();
  void take_without_locks(bool is_new);

  std::filesystem::path folder_;
  std::filesystem::path path_;
  int file_ = -1;
};

} // namespace billet::io
