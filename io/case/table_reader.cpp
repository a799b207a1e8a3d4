#include "io/case/table_reader.h"

#include "io/case/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace billet::io {

namespace {

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? printable(key) : fmt::format("{}.{}", path, printable(key));
}

} // namespace

void At::complain(const std::string& message,
                  const std::string& remedy,
                  std::string_view code) const {
  if (inquiry() != nullptr)
    return; // nothing is wrong where nothing is given
  context.complaints.add(node.place, path.empty() ? message : path + ": " + message, remedy, code);
}

void At::complain_found(const std::string& allowed, const std::string& remedy) const {
  refuse(fmt::format("found {}, allowed is {}", shown(node), allowed), remedy);
}

const List* At::list(std::size_t least) const {
  if (Inquiry* const asking = inquiry())
    return asking->expect_list(std::max<std::size_t>(least, 1), least,
                               std::numeric_limits<std::size_t>::max());
  return node.as<List>();
}

At At::item(const Node& item_node, std::size_t i) const {
  return {item_node, joined(path, std::to_string(i)), context};
}

TableReader::TableReader(At at) : at_(std::move(at)), table_(at_.node.as<Table>()) {
  if (at_.inquiry() != nullptr)
    at_.inquiry()->expect_table();
  else if (table_ == nullptr)
    at_.complain_found("a table");
}

std::optional<At> TableReader::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end())
    known_.emplace_back(key);
  Inquiry* const inquiry = at_.inquiry();
  const Node* const node = inquiry != nullptr  ? inquiry->key(key, false)
                           : table_ != nullptr ? table_->find(key)
                                               : nullptr;
  if (node == nullptr)
    return std::nullopt;
  return At{*node, joined(at_.path, key), at_.context};
}

std::optional<At> TableReader::require(std::string_view key) {
  std::optional<At> at = find(key);
  if (at && at_.inquiry() != nullptr)
    (void)at_.inquiry()->key(key, true);
  if (!at && table_ != nullptr)
    missing_.push_back(
        {std::string(key),
         at_.context.complaints.add(
             at_.node.place, fmt::format("{}: missing, it must be given", joined(at_.path, key)),
             "", error_code::key_missing)});
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
  if (Inquiry* const inquiry = at_.inquiry())
    items.emplace_back("name", At{*inquiry->named(), joined(at_.path, "name"), at_.context});
  if (table_ == nullptr)
    return items;
  for (const Entry& entry : table_->entries) {
    known_.push_back(entry.key);
    items.emplace_back(entry.key, At{entry.node, joined(at_.path, entry.key), at_.context});
  }
  return items;
}

bool TableReader::has(std::string_view key) {
  return at_.inquiry() != nullptr ? at_.inquiry()->has(key) : find(key).has_value();
}

void TableReader::note_initial_number(std::string_view key, double value) const {
  at_.inquiry()->set_initial(key, fmt::format("{}", value));
}

bool TableReader::is_known(const std::string& key) const {
  return std::find(known_.begin(), known_.end(), key) != known_.end();
}

bool TableReader::resolve_missing(const std::string& key) {
  const auto at = std::find_if(missing_.begin(), missing_.end(),
                               [&](const Missing& missing) { return missing.key == key; });
  if (at == missing_.end())
    return false;
  at_.context.complaints.withdraw(at->complaint);
  missing_.erase(at);
  return true;
}

std::string TableReader::remedy_for(const std::string& key, std::size_t n_unknown) {
  std::vector<std::string> missing;
  for (const Missing& one : missing_)
    missing.push_back(one.key);
  if (const std::optional<Meant> word = meant(key, missing)) {
    resolve_missing(word->word);
    return word->text();
  }
  std::string remedy = suggestion(key, known_);
  if (missing.size() == 1 && n_unknown == 1) {
    resolve_missing(missing.front());
    remedy =
        fmt::format("'{}' is missing{}{}", missing.front(), remedy.empty() ? "" : "; ", remedy);
  }
  return remedy;
}

std::vector<std::string> TableReader::unknown_keys() const {
  std::vector<std::string> keys;
  if (table_ != nullptr)
    for (const Entry& entry : table_->entries)
      if (!is_known(entry.key))
        keys.push_back(entry.key);
  return keys;
}

void TableReader::finish() {
  if (table_ == nullptr)
    return;
  std::size_t n_unknown = unknown_keys().size();
  for (const Entry& entry : table_->entries) {
    if (is_known(entry.key))
      continue;
    const TextPlace place = entry.node.place.override != 0 ? entry.node.place : entry.place;
    at_.context.complaints.add(place, fmt::format("{}: unknown key", joined(at_.path, entry.key)),
                               remedy_for(entry.key, n_unknown), error_code::key_unknown);
  }
}

} // namespace billet::io
