#include "io/case/table_reader.h"

#include "io/case/suggestion.h"

#include <fmt/format.h>

#include <algorithm>

namespace billet::io {

namespace {

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? printable(key) : fmt::format("{}.{}", path, printable(key));
}

} // namespace

void At::complain(const std::string& message, const std::string& remedy) const {
  context.complaints.add(node.place, path.empty() ? message : path + ": " + message, remedy);
}

void At::complain_found(const std::string& allowed, const std::string& remedy) const {
  complain(fmt::format("found {}, allowed is {}", shown(node), allowed), remedy);
}

At At::item(const Node& item_node, std::size_t i) const {
  return {item_node, joined(path, std::to_string(i)), context};
}

TableReader::TableReader(At at) : at_(std::move(at)), table_(at_.node.as<Table>()) {
  if (table_ == nullptr)
    at_.complain_found("a table");
}

std::optional<At> TableReader::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end())
    known_.emplace_back(key);
  const Node* const node = table_ != nullptr ? table_->find(key) : nullptr;
  if (node == nullptr)
    return std::nullopt;
  return At{*node, joined(at_.path, key), at_.context};
}

std::optional<At> TableReader::require(std::string_view key) {
  std::optional<At> at = find(key);
  if (!at && table_ != nullptr)
    at_.context.complaints.add(at_.node.place,
                               fmt::format("{}: missing, it must be given", joined(at_.path, key)));
  return at;
}

std::optional<TableReader> TableReader::find_table(std::string_view key) {
  const std::optional<At> at = find(key);
  return at ? std::optional(TableReader(*at)) : std::nullopt;
}

std::optional<TableReader> TableReader::require_table(std::string_view key) {
  const std::optional<At> at = require(key);
  return at ? std::optional(TableReader(*at)) : std::nullopt;
}

std::vector<std::pair<std::string, At>> TableReader::named_items() {
  std::vector<std::pair<std::string, At>> items;
  if (table_ == nullptr)
    return items;
  for (const Entry& entry : table_->entries) {
    known_.push_back(entry.key);
    items.emplace_back(entry.key, At{entry.node, joined(at_.path, entry.key), at_.context});
  }
  return items;
}

void TableReader::finish() {
  if (table_ == nullptr)
    return;
  for (const Entry& entry : table_->entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end())
      continue;
    const TextPlace place = entry.node.place.override != 0 ? entry.node.place : entry.place;
    at_.context.complaints.add(place, fmt::format("{}: unknown key", joined(at_.path, entry.key)),
                               suggestion(entry.key, known_));
  }
}

} // namespace billet::io
