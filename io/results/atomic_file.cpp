#include "io/results/atomic_file.h"

#include "geometry/base/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace billet::io {

namespace {

std::string remedy_for(int reason) {
  switch (reason) {
  case ENOSPC:
  case EDQUOT:
  case EFBIG:
    return "free some space and run again, or choose another folder with -o";
  case EACCES:
  case EPERM:
  case EROFS:
    return "choose a folder you may write to with -o";
  default:
    return "choose another folder with -o";
  }
}

/// Of a folder without a name of its own, this one.
std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// A file with a name next to the final one; removed unless it was renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(const std::filesystem::path& final_path)
      : final_(final_path),
        path_(final_path.parent_path() /
              fmt::format(".{}.{}.partial", final_path.filename().string(), ::getpid())) {
    constexpr ::mode_t permissions = 0666; // less what the user masks
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, permissions);
    if (file_ < 0)
      cannot_write(final_, errno);
  }
  ~TemporaryFile() {
    if (file_ >= 0)
      ::close(file_);
    if (!renamed_)
      ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view text) {
    if (const int reason = write_all(file_, text); reason != 0)
      cannot_write(final_, reason);
  }
  void synchronize() { check(::fsync(file_)); }
  /// Some file systems tell only here that a disk is full.
  void close() { check(::close(std::exchange(file_, -1))); }
  void rename() {
    check(::rename(path_.c_str(), final_.c_str()));
    renamed_ = true;
  }

private:
  void check(int result) const {
    if (result != 0)
      cannot_write(final_, errno);
  }

  std::filesystem::path final_;
  std::filesystem::path path_;
  int file_ = -1;
  bool renamed_ = false;
};

} // namespace

void cannot_write(const std::filesystem::path& path, int reason) {
  if (reason == ENOMEM)
    throw std::bad_alloc();
  throw Error(
      Fault::input_output, path.string(),
      fmt::format("cannot be written: {}", reason == 0 ? "unknown reason" : std::strerror(reason)),
      remedy_for(reason), error_code::not_written);
}

int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ::ssize_t n = ::write(file, text.data(), text.size());
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return n < 0 ? errno : ENOSPC;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

void write_file(const std::filesystem::path& path, std::string_view text, Durable durable) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(Fault::input_output, path.string(), "is a folder or a device, not a file",
                "choose another folder with -o");
  TemporaryFile temporary(path);
  temporary.write(text);
  if (durable == Durable::yes)
    temporary.synchronize();
  temporary.close();
  temporary.rename();
  if (durable == Durable::yes)
    synchronize(folder_of(path));
}

void make_folder(const std::filesystem::path& path, Durable durable) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> with_new_names;
  for (fs::path made = path; durable == Durable::yes && !fs::exists(made, error);
       made = with_new_names.back())
    with_new_names.push_back(folder_of(made));
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    cannot_write(path, error.value());
  for (const fs::path& folder : with_new_names)
    synchronize(folder);
}

void synchronize(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0 && (errno == ENOENT || errno == EACCES))
    return; // gone by now; or to be written but not read, and left to the system
  if (file < 0)
    cannot_write(path, errno);
  const int reason = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (reason != 0 && reason != EINVAL && reason != ENOTSUP)
    cannot_write(path, reason);
}

} // namespace billet::io
