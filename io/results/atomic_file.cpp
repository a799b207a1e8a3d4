#include "io/results/atomic_file.h"

#include "geometry/base/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

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

/// A file name next to the final one; removed unless it was renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(const std::filesystem::path& final_path)
      : path_(final_path.parent_path() /
              fmt::format(".{}.{}.partial", final_path.filename().string(), ::getpid())) {}
  ~TemporaryFile() {
    std::error_code ignored;
    if (!renamed_)
      std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void rename(const std::filesystem::path& final_path) {
    std::error_code error;
    std::filesystem::rename(path_, final_path, error);
    if (error)
      cannot_write(final_path, error.value());
    renamed_ = true;
  }

private:
  std::filesystem::path path_;
  bool renamed_ = false;
};

} // namespace

void cannot_write(const std::filesystem::path& path, int reason) {
  throw Error(
      Fault::input_output, path.string(),
      fmt::format("cannot be written: {}", reason == 0 ? "unknown reason" : std::strerror(reason)),
      remedy_for(reason));
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  write_file(path, [text](std::ostream& stream) {
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  });
}

void write_file(const std::filesystem::path& path,
                const std::function<void(std::ostream&)>& write) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(Fault::input_output, path.string(), "is a folder or a device, not a file",
                "choose another folder with -o");
  TemporaryFile temporary(path);
  errno = 0;
  std::ofstream stream(temporary.path(), std::ios::binary | std::ios::trunc);
  if (!stream)
    cannot_write(path, errno);
  write(stream);
  if (!stream.flush())
    cannot_write(path, errno);
  stream.close();
  if (!stream)
    cannot_write(path, errno);
  temporary.rename(path);
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error && !std::filesystem::is_directory(path, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    cannot_write(path, error.value());
}

} // namespace billet::io
