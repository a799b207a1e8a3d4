// A tree as the text of a case file: sections, lists of tables, the rest on one line a key.

#include "io/case/document.h"
#include "io/case/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace billet::io {

namespace {

bool is_list_of_tables(const Node& node) {
  const List* const list = node.as<List>();
  return list != nullptr && !list->empty() &&
         std::all_of(list->begin(), list->end(),
                     [](const Node& item) { return item.as<Table>() != nullptr; });
}

/// A table of tables, such as `material`.
bool holds_tables(const Table& table) {
  return !table.entries.empty() &&
         std::all_of(table.entries.begin(), table.entries.end(),
                     [](const Entry& entry) { return entry.node.as<Table>() != nullptr; });
}

/// In the order of the text, then those that were added: the parser sorts by name.
std::vector<const Entry*> in_order(const Table& table) {
  std::vector<const Entry*> entries;
  for (const Entry& entry : table.entries)
    entries.push_back(&entry);
  std::stable_sort(entries.begin(), entries.end(), [](const Entry* a, const Entry* b) {
    return std::tie(a->place.override, a->place.line, a->place.column) <
           std::tie(b->place.override, b->place.line, b->place.column);
  });
  return entries;
}

std::string value_text(const Node& node) {
  if (const auto* const boolean = node.as<bool>())
    return toml_text(*boolean);
  if (const auto* const integer = node.as<std::int64_t>())
    return fmt::format("{}", *integer);
  if (const auto* const real = node.as<double>())
    return toml_text(*real);
  if (const auto* const text = node.as<std::string>())
    return toml_text(std::string_view(*text));
  if (const List* const list = node.as<List>()) {
    std::vector<std::string> items;
    for (const Node& item : *list)
      items.push_back(value_text(item));
    return toml_list(items);
  }
  TomlTable written;
  const Table* const table = node.as<Table>();
  assert(table != nullptr);
  for (const Entry* entry : in_order(*table))
    written.add(entry->key, value_text(entry->node));
  return written.on_one_line();
}

std::string on_lines(const Table& table) {
  TomlTable written;
  for (const Entry* entry : in_order(table))
    written.add(entry->key, value_text(entry->node));
  return written.on_lines();
}

std::string section(const std::string& key, const Table& table) {
  if (!holds_tables(table))
    return fmt::format("\n[{}]\n{}", key, on_lines(table));
  std::string text;
  for (const Entry* entry : in_order(table))
    text +=
        fmt::format("\n[{}.{}]\n{}", key, toml_key(entry->key), on_lines(*entry->node.as<Table>()));
  return text;
}

} // namespace

std::string toml_file(const Node& root) {
  std::string values;
  std::string sections;
  for (const Entry* entry : in_order(*root.as<Table>())) {
    const std::string key = toml_key(entry->key);
    if (const Table* const table = entry->node.as<Table>())
      sections += section(key, *table);
    else if (is_list_of_tables(entry->node))
      for (const Node& item : *entry->node.as<List>())
        sections += fmt::format("\n[[{}]]\n{}", key, on_lines(*item.as<Table>()));
    else
      values += fmt::format("{} = {}\n", key, value_text(entry->node));
  }
  return values + sections;
}

} // namespace billet::io
