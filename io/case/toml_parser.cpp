// Text to our own tree, by the TOML library.

#include "io/case/document.h"
#include "io/text/toml_library.h"

#include <fmt/format.h>

#include <utility>

namespace billet::io {

namespace {

TextPlace place_of(const toml::source_region& source, const TextPlace& given) {
  if (given.override != 0)
    return given;
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column), 0};
}

Node converted_node(const toml::node& node, const TextPlace& given);

Table converted_table(const toml::table& table, const TextPlace& given) {
  Table result;
  for (const auto& [key, node] : table)
    result.entries.push_back(
        {std::string(key.str()), place_of(key.source(), given), converted_node(node, given)});
  return result;
}

List converted_list(const toml::array& array, const TextPlace& given) {
  List result;
  for (const toml::node& node : array)
    result.push_back(converted_node(node, given));
  return result;
}

Node converted_node(const toml::node& node, const TextPlace& given) {
  Node result{place_of(node.source(), given), Date{}};
  if (const toml::table* const table = node.as_table())
    result.value = converted_table(*table, given);
  else if (const toml::array* const array = node.as_array())
    result.value = converted_list(*array, given);
  else if (const auto* const text = node.as_string())
    result.value = text->get();
  else if (const auto* const integer = node.as_integer())
    result.value = integer->get();
  else if (const auto* const real = node.as_floating_point())
    result.value = real->get();
  else if (const auto* const boolean = node.as_boolean())
    result.value = boolean->get();
  return result;
}

} // namespace

Node parse_document(std::string_view text, const std::string& name, const TextPlace& place) {
  guard_text(text, name);
  try {
    const toml::table table = toml::parse(text, name);
    Node root{place, converted_table(table, place)};
    return root;
  } catch (const BrokenInvariant& broken) {
    throw Error(Fault::case_file, name,
                fmt::format("not valid TOML (parser: {})", broken.condition), "",
                error_code::toml_syntax);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw Error(Fault::case_file, fmt::format("{}:{}:{}", name, at.line, at.column),
                fmt::format("not valid TOML: {}", error.description()), "",
                error_code::toml_syntax);
  }
}

} // namespace billet::io
