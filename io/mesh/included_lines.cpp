#include "io/mesh/included_lines.h"

#include "geometry/base/error.h"
#include "io/text/paths.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace billet::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_deep = 16;
constexpr std::size_t most_included = 1000; ///< times that a file is read
constexpr std::uintmax_t most_bytes = 2'000'000'000;

/// A file's name without unprintable characters, short enough for a message.
std::string shown_name(std::string_view name) {
  std::string clean(name.substr(0, 100));
  std::replace_if(
      clean.begin(), clean.end(), [](char c) { return c >= 0 && c < ' '; }, '?');
  return clean;
}

fs::path real(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : canonical;
}

} // namespace

IncludedLines::IncludedLines(const fs::path& file, IncludeBounds bounds)
    : bounds_(std::move(bounds)), folder_(file.parent_path()) {
  sources_.push_back({Scanner(file), real(file)});
}

bool IncludedLines::next() {
  while (sources_.size() > 1 && sources_.back().scanner.at_end())
    sources_.pop_back();
  Scanner& scanner = sources_.back().scanner;
  if (scanner.at_end())
    return false;
  line_ = scanner.line();
  if (scanner.line_number() == 1 && line_.starts_with(byte_order_mark))
    line_.erase(0, byte_order_mark.size());
  return true;
}

void IncludedLines::include(std::string_view name) {
  std::string portable(name);
  std::replace(portable.begin(), portable.end(), '\\', '/');
  if (portable.empty() || portable.find('\0') != std::string::npos)
    fail("the name of the file to be included is missing");
  const fs::path path = (folder_ / portable).lexically_normal();
  require_allowed(path, name);
  require_budget(path);
  sources_.push_back({Scanner(path), real(path)});
}

void IncludedLines::require_allowed(const fs::path& path, std::string_view name) const {
  const fs::path own = folder_.empty() ? fs::path(".") : folder_;
  if (!bounds_.anywhere && !is_inside(path, own) &&
      (bounds_.folder.empty() || !is_inside(path, bounds_.folder)))
    fail(fmt::format("\"{}\" is to be included, which is outside the folder of {}",
                     shown_name(name),
                     bounds_.folder.empty() ? "this file" : "this file and that of the case"),
         "move the file into the folder, or use --allow-outside");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    fail(fmt::format("\"{}\" is to be included, but there is no such file", shown_name(name)),
         fmt::format("names are relative to the folder of {}",
                     sources_.front().real.filename().string()));
  if (!fs::is_regular_file(status))
    fail(fmt::format("\"{}\" is to be included, but it is a folder or device", shown_name(name)));
  const fs::path same = real(path);
  if (std::any_of(sources_.begin(), sources_.end(),
                  [&](const Source& source) { return source.real == same; }))
    fail(fmt::format("\"{}\" includes itself, by way of others or at once", shown_name(name)));
}

void IncludedLines::require_budget(const fs::path& path) {
  if (sources_.size() > most_deep)
    fail(fmt::format("files include each other more than {} deep", most_deep));
  if (++n_included_ > most_included)
    fail(fmt::format("more than {} files are included", most_included));
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  n_bytes_ += error ? 0 : size;
  if (n_bytes_ > most_bytes)
    fail(fmt::format("the included files hold more than {:.0e} bytes together",
                     static_cast<double>(most_bytes)));
}

std::string IncludedLines::place() const {
  const Scanner& scanner = sources_.back().scanner;
  return fmt::format("{}:{}", scanner.file(), scanner.line_number());
}

std::string IncludedLines::place_in_note() const {
  return sources_.size() == 1 ? fmt::format("line {}", sources_.back().scanner.line_number())
                              : place();
}

void IncludedLines::fail(const std::string& message, const std::string& remedy) const {
  throw Error(Fault::geometry, place(), message, remedy, error_code::mesh_file);
}

} // namespace billet::io
