#include "app/report/case_facts.h"

#include "io/case/quoted.h"
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

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end != text.data() ? std::optional(value) : std::nullopt;
}

/// Reads line after line; a table ends where the next one begins.
class Reader {
public:
  void line(const std::string& text) {
    if (text.starts_with("[")) {
      table_ = text;
      return;
    }
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      return;
    const std::string_view key = without_blanks(std::string_view(text).substr(0, equals));
    take(std::string(key), std::string(without_blanks(std::string_view(text).substr(equals + 1))));
  }

  CaseFacts end() { return facts_; }

private:
  void take(const std::string& key, const std::string& value) {
    if (table_.empty())
      take_head(key, io::unquoted(value));
    else if (table_ == "[[tool]]" && key == "motion")
      facts_.tools_turn = facts_.tools_turn || value.find("rotation") != std::string::npos ||
                          value.find("torque") != std::string::npos;
    else if (table_ == "[[measure]]" && key == "name")
      facts_.measures.emplace_back(io::unquoted(value), "");
    else if (table_ == "[[measure]]" && key == "kind" && !facts_.measures.empty())
      facts_.measures.back().second = io::unquoted(value);
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

  CaseFacts facts_;
  std::string table_;
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
