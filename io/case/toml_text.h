// Builds the text of a resolved case file: values as TOML text, inline tables.

#pragma once

#include "io/case/case.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billet::io {

[[nodiscard]] std::string toml_text(double value); ///< shortest digits that read back the same
[[nodiscard]] std::string toml_text(int value);
[[nodiscard]] std::string toml_text(bool value);
[[nodiscard]] std::string toml_text(std::string_view value); ///< in quotes, escaped
[[nodiscard]] std::string toml_text(const std::vector<std::string>& values);
[[nodiscard]] std::string toml_text(const std::vector<double>& values);
[[nodiscard]] std::string toml_text(const std::vector<std::pair<double, double>>& rows);
[[nodiscard]] std::string toml_text(const TimeFunction& function);
[[nodiscard]] std::string toml_text(const InputFile& file);
[[nodiscard]] std::string toml_text(const Where& where);
[[nodiscard]] std::string toml_text(const contact::ShearYieldStress& strength);

/// A list of items that are TOML text already.
[[nodiscard]] std::string toml_list(const std::vector<std::string>& items);

/// A list of the first `size` entries.
[[nodiscard]] std::string toml_text(const Vec3& vector, int size);

/// A key of a table as TOML text, in quotes where needed.
[[nodiscard]] std::string toml_key(std::string_view key);

/// A table on one line, or on one line a key.
class TomlTable {
public:
  /// Adds a key and the text of its value.
  TomlTable& add(std::string_view key, const std::string& text);

  [[nodiscard]] std::string on_one_line() const;
  [[nodiscard]] std::string on_lines() const;

private:
  std::vector<std::pair<std::string, std::string>> entries_;
};

/// The parts of a case that have sources of their own; `size` is the scene's dimension.
[[nodiscard]] std::string toml_text(const Material& material);
[[nodiscard]] std::string toml_text(const Workpiece& workpiece, int size);
[[nodiscard]] std::string toml_text(const Tool& tool, int size);
[[nodiscard]] std::string toml_text(const Friction& friction, int size);
[[nodiscard]] std::string toml_text(const Place& place, int size);

} // namespace billet::io
