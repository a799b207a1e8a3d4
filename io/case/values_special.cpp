// Values of the case file that are more than numbers: files, selectors, shear strengths.

#include "io/case/values.h"
#include "io/text/paths.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <system_error>

namespace billet::io {

namespace {

namespace fs = std::filesystem;

/// A plane "x = 7.5"; none when the text has not that form or the value is bad (complained).
std::optional<OnPlane> as_plane(const At& at, std::string_view text) {
  constexpr std::string_view names = "xyz";
  const std::size_t axis = names.find(text.front());
  const std::string_view rest = trimmed(text.substr(1));
  if (axis == std::string_view::npos || !rest.starts_with('='))
    return std::nullopt;
  if (axis == 2 && at.context.in_plane()) {
    at.complain_found("a plane of x or y (the scene is in the plane)");
    return std::nullopt;
  }
  // The value is read as any other, so that it may have a unit.
  std::string_view value_text = trimmed(rest.substr(1));
  Node value{at.node.place, std::string(value_text)};
  if (value_text.starts_with('+'))
    value_text.remove_prefix(1);
  double number = 0.0;
  const char* const last = value_text.data() + value_text.size();
  if (std::from_chars(value_text.data(), last, number).ptr == last && !value_text.empty())
    value.value = number;
  const std::optional<double> position =
      as_number({value, at.path, at.context}, {quantity::length, any_value});
  return position ? std::optional(OnPlane{static_cast<int>(axis), *position}) : std::nullopt;
}

} // namespace

std::optional<InputFile> as_input_file(const At& at) {
  if (at.expect(TextShape{"a file, relative to the folder of the case", {}}))
    return InputFile{};
  const std::optional<std::string> given = as_text(at);
  if (!given)
    return std::nullopt;
  if (given->empty() || given->find('\0') != std::string::npos) {
    at.complain_found("the name of a file");
    return std::nullopt;
  }
  const fs::path path = at.context.directory / fs::path(*given);
  if (!at.context.allow_outside && !is_inside(path, at.context.directory)) {
    at.refuse(fmt::format("found {}, which is outside the folder of the case", shown(at.node)),
              "move the file into the folder, or run with --allow-outside");
    return std::nullopt;
  }
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_regular_file(status))
    return InputFile{*given, path};
  at.complain(fs::exists(status)
                  ? fmt::format("found {}, which is not a file", shown(at.node))
                  : fmt::format("found {}, but there is no such file", shown(at.node)),
              fs::exists(status) ? "" : "paths are relative to the folder of the case");
  return std::nullopt;
}

std::optional<LengthUnit> as_length_unit(const At& at) {
  if (at.expect(TextShape{"a unit of length such as mm, m or in", {}}))
    return LengthUnit{};
  const std::optional<std::string> text = as_text(at);
  const Outcome<double> factor = length_factor(text.value_or(""), at.context.units);
  if (text && factor)
    return LengthUnit{*text, *factor};
  if (text)
    at.complain_found("a unit of length such as \"mm\", \"m\" or \"in\"");
  return std::nullopt;
}

std::optional<Where> as_where(const At& at) {
  if (at.expect(TextShape{"x = VALUE, y = VALUE, z = VALUE, set:NAME or all",
                          R"(^\s*(all|set:.+|[xyz]\s*=.+)\s*$)"}))
    return Where{};
  const auto* const text = at.node.as<std::string>();
  const std::string_view word = text != nullptr ? trimmed(*text) : std::string_view{};
  constexpr std::string_view set = "set:";
  const auto here = [&](auto kind) { return Where{std::move(kind), at.place(), at.path}; };
  if (word == "all")
    return here(Everywhere{});
  if (word.starts_with(set) && word.size() > set.size())
    return here(InSet{std::string(word.substr(set.size()))});
  if (!word.empty() && std::string_view("xyz").find(word.front()) != std::string_view::npos &&
      trimmed(word.substr(1)).starts_with('=')) {
    const std::optional<OnPlane> plane = as_plane(at, word);
    return plane ? std::optional<Where>(here(*plane)) : std::nullopt;
  }
  at.complain_found("\"x = VALUE\", \"y = VALUE\", \"set:NAME\" or \"all\"");
  return std::nullopt;
}

std::optional<contact::ShearYieldStress> as_shear_strength(const At& at, const Number& kind) {
  if (at.expect(NumberShape{kind.measured, kind.bounds}, WordShape{{"shear-yield", "von-mises"}}))
    return contact::FollowedStress::yield;
  const auto* const text = at.node.as<std::string>();
  if (text != nullptr && *text == "shear-yield")
    return contact::FollowedStress::yield;
  if (text != nullptr && *text == "von-mises")
    return contact::FollowedStress::von_mises;
  if (text != nullptr && text->find_first_of("0123456789") == std::string::npos) {
    at.complain_found("a stress such as \"10 MPa\", \"shear-yield\" or \"von-mises\"");
    return std::nullopt;
  }
  const std::optional<double> value = as_number(at, kind);
  return value ? std::optional<contact::ShearYieldStress>(*value) : std::nullopt;
}

} // namespace billet::io
