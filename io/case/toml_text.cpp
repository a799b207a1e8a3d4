#include "io/case/toml_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace billet::io {

namespace {

bool is_bare(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

template <class Items> std::string listed(const Items& items) {
  std::vector<std::string> texts;
  texts.reserve(items.size());
  for (const auto& item : items)
    texts.push_back(toml_text(item));
  return toml_list(texts);
}

std::string where_text(const Everywhere& /*where*/) { return "all"; }
std::string where_text(const InSet& where) { return "set:" + where.name; }
std::string where_text(const OnPlane& where) {
  return fmt::format("{} = {}", "xyz"[where.axis], where.value);
}

} // namespace

std::string toml_text(double value) { return fmt::format("{}", value); }
std::string toml_text(int value) { return fmt::format("{}", value); }
std::string toml_text(bool value) { return value ? "true" : "false"; }

std::string toml_text(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      text += {'\\', c};
    else if (byte < 0x20 || byte == 0x7F)
      text += fmt::format("\\u{:04x}", byte);
    else
      text += c;
  }
  return text + "\"";
}

std::string toml_list(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string toml_text(const std::vector<double>& values) { return listed(values); }

std::string toml_text(const std::vector<std::string>& values) {
  return listed(std::vector<std::string_view>(values.begin(), values.end()));
}

std::string toml_text(const std::vector<std::pair<double, double>>& rows) {
  std::vector<std::string> texts;
  texts.reserve(rows.size());
  for (const auto& [first, second] : rows)
    texts.push_back(fmt::format("[{}, {}]", first, second));
  return toml_list(texts);
}

std::string toml_text(const TimeFunction& function) {
  const auto& points = function.points();
  const bool is_constant = points.size() == 1 && points.front().first == 0.0;
  return is_constant ? toml_text(points.front().second) : toml_text(points);
}

std::string toml_text(const InputFile& file) { return toml_text(std::string_view(file.given)); }

std::string toml_text(const Where& where) {
  const std::string text =
      std::visit([](const auto& kind) { return where_text(kind); }, where.kind);
  return toml_text(std::string_view(text));
}

std::string toml_text(const contact::ShearYieldStress& strength) {
  if (const double* const value = std::get_if<double>(&strength))
    return toml_text(*value);
  return std::get<contact::FollowedStress>(strength) == contact::FollowedStress::von_mises
             ? "\"von-mises\""
             : "\"shear-yield\"";
}

std::string toml_text(const Vec3& vector, int size) {
  std::vector<double> entries(vector.data(), vector.data() + size);
  return toml_text(entries);
}

std::string toml_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
  return bare ? std::string(key) : toml_text(key);
}

TomlTable& TomlTable::add(std::string_view key, const std::string& text) {
  entries_.emplace_back(toml_key(key), text);
  return *this;
}

std::string TomlTable::on_one_line() const {
  std::vector<std::string> texts;
  for (const auto& [key, value] : entries_)
    texts.push_back(fmt::format("{} = {}", key, value));
  return texts.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(texts, ", "));
}

std::string TomlTable::on_lines() const {
  std::string text;
  for (const auto& [key, value] : entries_)
    text += fmt::format("{} = {}\n", key, value);
  return text;
}

} // namespace billet::io
