// Tables whose kind is given by the key they have: { plane = ... } or { circle = ... }.

#pragma once

#include "io/case/suggestion.h"
#include "io/case/table_reader.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace billet::io {

enum class Scenes { all, plane, space };

/// One kind: its key, the scenes it is for, how to read the table that has the key.
template <class Into> struct Kind {
  std::string_view key;
  Scenes scenes;
  std::optional<Into> (*read)(TableReader& table, const At& at_key);
};

/// Complains of a table that has the key of no kind. One of its keys may be meant for that: then
/// the complaint says which, and there is no other one.
inline void complain_of_kinds(const At& at, const TableReader& table, const std::string& allowed) {
  for (const std::string& key : table.unknown_keys())
    if (const std::optional<Meant> word = meant(key, table.known_keys())) {
      at.complain("found the key '" + printable(key) + "', " + allowed, word->text());
      return;
    }
  at.complain(allowed);
}

/// Reads a table that must have the key of exactly one kind, and all the rest of its keys.
template <class Into>
[[nodiscard]] std::optional<Into> read_one_kind(const At& at, std::span<const Kind<Into>> kinds) {
  TableReader table(at);
  const Kind<Into>* chosen = nullptr;
  std::string keys;
  for (const Kind<Into>& kind : kinds) {
    if (!keys.empty())
      keys += ", ";
    keys += kind.key;
    const std::optional<At> found = table.find(kind.key);
    if (found && chosen != nullptr) {
      found->complain("there is '" + std::string(chosen->key) +
                      "' already, allowed is one of them");
      return std::nullopt;
    }
    if (found)
      chosen = &kind;
  }
  if (chosen == nullptr) {
    if (table.is_table())
      complain_of_kinds(at, table, "allowed is exactly one of the keys " + keys);
    return std::nullopt;
  }
  const At at_key = *table.find(chosen->key);
  const bool fits = !(chosen->scenes == Scenes::plane && at.context.in_space()) &&
                    !(chosen->scenes == Scenes::space && at.context.in_plane());
  if (!fits) {
    at_key.complain(chosen->scenes == Scenes::plane ? "only for scenes in the plane"
                                                    : "only for 3d scenes");
    return std::nullopt;
  }
  std::optional<Into> into = chosen->read(table, at_key);
  table.finish();
  return into;
}

} // namespace billet::io
