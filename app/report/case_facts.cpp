#include "app/report/case_facts.h"

#include "io/case/units.h"

#include <charconv>
#include <sstream>
#include <string_view>

namespace billet::report {

namespace {

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// What stands between the first and the last quote, its escapes undone; else the text itself.
std::string unquoted(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"')
    return std::string(text);
  std::string plain;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\' && i + 2 < text.size())
      ++i;
    plain += text[i];
  }
  return plain;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end != text.data() ? std::optional(value) : std::nullopt;
}

/// "x = 0" as a plane.
std::optional<SymmetryPlane> plane_of(const std::string& where) {
  const std::size_t equals = where.find('=');
  if (equals == std::string::npos || where.empty() || where[0] < 'x' || where[0] > 'z')
    return std::nullopt;
  const std::optional<double> value =
      number_of(without_blanks(std::string_view(where).substr(equals + 1)));
  return value ? std::optional(SymmetryPlane{where[0] - 'x', *value}) : std::nullopt;
}

/// Reads line after line; a table ends where the next one begins.
class Reader {
public:
  void line(const std::string& text) {
    if (text.starts_with("[")) {
      end_table();
      table_ = text;
      return;
    }
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      return;
    const std::string_view key = without_blanks(std::string_view(text).substr(0, equals));
    take(std::string(key), std::string(without_blanks(std::string_view(text).substr(equals + 1))));
  }

  CaseFacts end() {
    end_table();
    return facts_;
  }

private:
  void take(const std::string& key, const std::string& value) {
    if (table_.empty())
      take_head(key, unquoted(value));
    else if (table_ == "[[support]]" && key == "where")
      plane_ = plane_of(unquoted(value));
    else if (table_ == "[[support]]" && key == "fix")
      fixed_ = value;
    else if (table_ == "[[tool]]" && key == "motion")
      facts_.tools_turn = facts_.tools_turn || value.find("rotation") != std::string::npos ||
                          value.find("torque") != std::string::npos;
    else if (table_ == "[[measure]]" && key == "name")
      facts_.measures.emplace_back(unquoted(value), "");
    else if (table_ == "[[measure]]" && key == "kind" && !facts_.measures.empty())
      facts_.measures.back().second = unquoted(value);
    else if ((table_ == "[time]" || table_ == "[[stage]]") && key == "end")
      facts_.end = number_of(value);
  }

  void take_head(const std::string& key, const std::string& value) {
    if (key == "title")
      facts_.title = value;
    else if (key == "units")
      for (const io::UnitSystem& system : io::unit_systems())
        facts_.units = system.name == value ? system : facts_.units;
    else if (key == "analysis")
      facts_.analysis = value == "3d"             ? io::Analysis::solid
                        : value == "axisymmetric" ? io::Analysis::axisymmetric
                                                  : io::Analysis::plane_strain;
  }

  void end_table() {
    if (plane_ && fixed_.find(static_cast<char>('x' + plane_->axis)) != std::string::npos)
      facts_.planes.push_back(*plane_);
    plane_.reset();
    fixed_.clear();
  }

  CaseFacts facts_;
  std::string table_;
  std::optional<SymmetryPlane> plane_; ///< of the support that is being read
  std::string fixed_;
};

} // namespace

CaseFacts case_facts(const std::string& resolved) {
  Reader reader;
  std::istringstream lines(resolved);
  for (std::string line; std::getline(lines, line);)
    reader.line(line);
  return reader.end();
}

} // namespace billet::report
