// The user's "key=value" overrides, applied to the tree before it is read.

#include "io/case/document.h"
#include "io/case/suggestion.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <utility>

namespace billet::io {

namespace {

constexpr std::size_t most_parts = 32; // as for keys of the file

struct Override {
  std::vector<std::string> path;
  std::string_view value;
};

/// Takes one part of a dotted key, quoted or not, off the front of `text`; none when it is empty.
std::optional<std::string> take_part(std::string_view& text) {
  text = trimmed(text);
  if (!text.empty() && (text.front() == '"' || text.front() == '\'')) {
    const std::size_t end = text.find(text.front(), 1);
    if (end == std::string_view::npos)
      return std::nullopt;
    std::string part(text.substr(1, end - 1));
    text = trimmed(text.substr(end + 1));
    return part;
  }
  const std::string_view part = trimmed(text.substr(0, text.find_first_of(".=")));
  text.remove_prefix(std::min(text.find_first_of(".="), text.size()));
  return part.empty() ? std::nullopt : std::optional(std::string(part));
}

/// Takes a dotted key off the front of `text`, up to its end or to '='; none when it has not that
/// form.
std::optional<std::vector<std::string>> take_key(std::string_view& text) {
  std::vector<std::string> parts;
  while (parts.size() < most_parts) {
    std::optional<std::string> part = take_part(text);
    if (!part)
      return std::nullopt;
    parts.push_back(std::move(*part));
    if (text.empty() || text.front() == '=')
      return parts;
    if (text.front() != '.')
      return std::nullopt;
    text.remove_prefix(1);
  }
  return std::nullopt;
}

/// "a.b=v" as parts and value; none when it has not that form.
std::optional<Override> as_override(std::string_view text) {
  std::optional<std::vector<std::string>> path = take_key(text);
  if (!path || text.empty())
    return std::nullopt;
  return Override{std::move(*path), trimmed(text.substr(1))};
}

/// A TOML value, or the text itself where it is none.
Node parsed_value(std::string_view text, const TextPlace& place) {
  Node as_text{place, std::string(text)};
  if (text.find('\n') != std::string_view::npos)
    return as_text;
  try {
    Node root = parse_document("v = " + std::string(text), "--set", place);
    Table& table = *root.as<Table>();
    return table.entries.size() == 1 ? std::move(table.entries.front().node) : as_text;
  } catch (const Error&) {
    return as_text;
  }
}

std::optional<std::string> name_of(const Node& item) {
  const Table* const table = item.as<Table>();
  const Node* const name = table != nullptr ? table->find("name") : nullptr;
  const std::string* const text = name != nullptr ? name->as<std::string>() : nullptr;
  return text != nullptr ? std::optional(*text) : std::nullopt;
}

Node* item_of(List& list, const std::string& part) {
  const std::optional<std::size_t> index = index_of_item(list, part);
  return index ? &list[*index] : nullptr;
}

std::string remedy_for(const List& list, const std::string& part) {
  std::vector<std::string> names;
  for (const Node& item : list)
    if (const std::optional<std::string> name = name_of(item))
      names.push_back(*name);
  if (!names.empty())
    return suggestion(part, names);
  if (list.empty())
    return "the list is empty";
  return fmt::format("items are named by their index, 0 to {}", list.size() - 1);
}

/// One step down the tree; a table is given the key if it lacks it. Null: complained.
Node* step(Node& from,
           const std::string& part,
           const std::string& path,
           const TextPlace& place,
           Complaints& complaints) {
  if (Table* const table = from.as<Table>()) {
    if (Node* const found = table->find(part))
      return found;
    table->entries.push_back({part, place, Node{place, Table{}}});
    return &table->entries.back().node;
  }
  List* const list = from.as<List>();
  if (list == nullptr) {
    complaints.add(place, fmt::format("{} is {}, it has no '{}'", path, shown(from), part), "",
                   error_code::key_unknown);
    return nullptr;
  }
  Node* const item = item_of(*list, part);
  if (item == nullptr)
    complaints.add(place, fmt::format("there is no {}.{}", path, part), remedy_for(*list, part),
                   error_code::key_unknown);
  return item;
}

/// Removes a part from a table or a list. False: it has none of that name.
bool erase_part(Node& from, const std::string& part) {
  if (Table* const table = from.as<Table>())
    return std::erase_if(table->entries, [&](const Entry& e) { return e.key == part; }) > 0;
  List* const list = from.as<List>();
  const Node* const item = list != nullptr ? item_of(*list, part) : nullptr;
  if (item == nullptr)
    return false;
  list->erase(list->begin() + (item - list->data()));
  return true;
}

/// What a part leads to, without making it. Null: nothing.
Node* existing(Node& from, const std::string& part) {
  if (Table* const table = from.as<Table>())
    return table->find(part);
  List* const list = from.as<List>();
  return list != nullptr ? item_of(*list, part) : nullptr;
}

} // namespace

std::optional<std::vector<std::string>> key_parts(std::string_view text) { return take_key(text); }

std::optional<std::size_t> index_of_item(const List& list, const std::string& part) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (name_of(list[i]) == part)
      return i;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool is_index = error == std::errc{} && end == part.data() + part.size();
  return is_index && index < list.size() ? std::optional(index) : std::nullopt;
}

void apply_override(Node& root, const std::string& text, Complaints& complaints) {
  const TextPlace place{0, 0, complaints.add_override(text)};
  const std::optional<Override> override = as_override(text);
  if (!override) {
    complaints.add(place, "allowed is KEY=VALUE with a dotted key such as contact.penalty=1e4", "",
                   error_code::usage);
    return;
  }
  Node* node = &root;
  std::string path;
  for (const std::string& part : override->path) {
    node = step(*node, part, path, place, complaints);
    if (node == nullptr)
      return;
    path += (path.empty() ? "" : ".") + part;
  }
  *node = parsed_value(override->value, place);
}

void apply_overrides(Node& root,
                     const std::vector<std::string>& overrides,
                     Complaints& complaints) {
  for (const std::string& text : overrides)
    apply_override(root, text, complaints);
}

void erase_key(Node& root, const std::string& key, Complaints& complaints) {
  const std::optional<std::vector<std::string>> path = key_parts(key);
  Node* node = path ? &root : nullptr;
  for (std::size_t i = 0; node != nullptr && i + 1 < path->size(); ++i)
    node = existing(*node, (*path)[i]);
  if (node == nullptr || !erase_part(*node, path->back()))
    complaints.add({}, fmt::format("there is no {} that could be removed", printable(key)), "",
                   error_code::key_unknown);
}

} // namespace billet::io
