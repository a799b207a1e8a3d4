// Writes a law with all its parameters; the mirror of read_law.h.

#pragma once

#include "io/case/setting_words.h"
#include "io/case/toml_text.h"

#include <optional>
#include <tuple>
#include <variant>

namespace billet::io {

// Texts of the members of laws, in addition to those of toml_text.h.
[[nodiscard]] std::string toml_text(const mechanics::AnyStaticLaw& law);
[[nodiscard]] inline std::string toml_text(contact::Flattening flattening) {
  return word_text(flattening, real_contacts);
}
[[nodiscard]] inline std::string
toml_text(const std::optional<contact::ShearYieldStress>& strength) {
  return toml_text(strength.value()); // where it is absent nothing is written
}

/// Writes one parameter, unless it is absent.
template <class Law, class Value>
void write_parameter(TomlTable& table, const Law& law, const Parameter<Law, Value>& parameter) {
  if (parameter.presence != Presence::absent || law.*parameter.member != Law{}.*parameter.member)
    table.add(parameter.key, toml_text(law.*parameter.member));
}

template <class Law, class Value, class Choice>
void write_parameter(TomlTable& table,
                     const Law& law,
                     const ConditionalParameter<Law, Value, Choice>& conditional) {
  if (conditional.counts(law))
    write_parameter(table, law, conditional.parameter);
}

template <class Parameter> bool is_coefficient(const Parameter& parameter) {
  if constexpr (requires { parameter.is_coefficient; })
    return parameter.is_coefficient;
  return false;
}

/// Writes the name and the parameters of a law, without its coefficient where a table stands in its
/// place.
template <class Law>
void write_law(TomlTable& table, const Law& law, bool with_coefficient = true) {
  table.add("law", toml_text(Law::name));
  const auto write = [&](const auto& parameter) {
    if (with_coefficient || !is_coefficient(parameter))
      write_parameter(table, law, parameter);
  };
  std::apply([&](const auto&... parameters) { (write(parameters), ...); }, Law::parameters);
}

/// A law of a variant as a table on one line.
template <class... Laws> std::string law_text(const std::variant<Laws...>& any) {
  TomlTable table;
  std::visit([&](const auto& law) { write_law(table, law); }, any);
  return table.on_one_line();
}

} // namespace billet::io
