#include "io/results/csv_writer.h"

#include "geometry/base/error.h"
#include "io/results/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

namespace billet::io {

namespace {

[[noreturn]] void refuse_table(const std::filesystem::path& path,
                               const std::string& message,
                               const std::string& remedy = {}) {
  throw Error(Fault::input_output, path.string(), message, remedy, error_code::not_written);
}

int open_table(const std::filesystem::path& path, int mode) {
  constexpr int permissions = 0644;
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | mode, permissions);
  if (file < 0)
    cannot_write(path, errno);
  return file;
}

/// Appends a whole row; of a row that does not fit nothing stays.
void append(int file, const std::filesystem::path& path, std::string_view row) {
  const ::off_t before = ::lseek(file, 0, SEEK_END);
  const int reason = write_all(file, row);
  if (reason == 0)
    return;
  // If this fails too there is nothing left to do: the error below is reported anyway.
  [[maybe_unused]] const int result = before >= 0 ? ::ftruncate(file, before) : 0;
  cannot_write(path, reason);
}

/// A text as a cell of the table: quoted if it has a comma, a quote or a line end.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string header(const std::vector<std::string>& columns) {
  std::vector<std::string> cells(columns.size());
  std::transform(columns.begin(), columns.end(), cells.begin(), cell);
  return fmt::format("{}\n", fmt::join(cells, ","));
}

} // namespace

CsvWriter::CsvWriter(std::filesystem::path path, std::size_t columns, int file)
    : path_(std::move(path)), columns_(columns), file_(file) {}

CsvWriter::CsvWriter(std::filesystem::path path, const std::vector<std::string>& columns)
    : CsvWriter(std::move(path), columns.size(), -1) {
  file_ = open_table(path_, O_TRUNC);
  append(file_, path_, header(columns));
}

CsvWriter CsvWriter::resume(std::filesystem::path path,
                            const std::vector<std::string>& columns,
                            std::size_t rows) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  const std::string content(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad())
    refuse_table(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (!content.starts_with(header(columns)))
    refuse_table(path, "the table has other columns than this run",
                 "resume with the case file the run was begun with");
  std::size_t end = header(columns).size();
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t line_end = content.find('\n', end);
    if (line_end == std::string::npos)
      refuse_table(
          path, fmt::format("the table has {} rows; the checkpoint needs {}", row, rows),
          "--from an earlier checkpoint goes on, if there is one; else start the run anew");
    end = line_end + 1;
  }
  stream.close();
  if (end < content.size())
    write_file(path, std::string_view(content).substr(0, end));
  const int file = open_table(path, 0);
  return {std::move(path), columns.size(), file};
}

CsvWriter::CsvWriter(CsvWriter&& other) noexcept
    : path_(std::move(other.path_)), columns_(other.columns_),
      file_(std::exchange(other.file_, -1)) {}

CsvWriter& CsvWriter::operator=(CsvWriter&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(columns_, other.columns_);
  std::swap(file_, other.file_);
  return *this;
}

CsvWriter::~CsvWriter() {
  if (file_ >= 0)
    ::close(file_);
}

void CsvWriter::row(std::span<const double> values) {
  assert(values.size() == columns_ && file_ >= 0);
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{:.17g}", text.empty() ? "" : ",", value);
  append(file_, path_, text + "\n");
}

} // namespace billet::io
