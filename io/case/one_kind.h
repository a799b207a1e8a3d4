// Tables whose kind is given by the key they have: { plane = ... } or { circle = ... }.

#pragma once

#include "io/case/suggestion.h"
#include "io/case/table_reader.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
      at.refuse("found the key '" + printable(key) + "', " + allowed, word->text());
      return;
    }
  at.complain(allowed);
}

/// Whether a kind is for the scenes of the case.
template <class Into> [[nodiscard]] bool fits(const Kind<Into>& kind, const ReadContext& context) {
  return !(kind.scenes == Scenes::plane && context.in_space()) &&
         !(kind.scenes == Scenes::space && context.in_plane());
}

/// Tells an inquiry of the kinds that fit, one after the other.
template <class Into>
[[nodiscard]] std::optional<Into> inquire_one_kind(const At& at,
                                                   std::span<const Kind<Into>> kinds) {
  std::vector<std::string> keys;
  std::vector<const Kind<Into>*> fitting;
  // Where no kind is for the scenes of this reading the key is not either: others have it.
  const bool any_fits = std::any_of(kinds.begin(), kinds.end(),
                                    [&](const Kind<Into>& kind) { return fits(kind, at.context); });
  for (const Kind<Into>& kind : kinds)
    if (!any_fits || fits(kind, at.context)) {
      keys.emplace_back(kind.key);
      fitting.push_back(&kind);
    }
  const Kind<Into>& kind = *fitting[at.inquiry()->choose(keys)];
  TableReader table(at);
  return read_value_of(*table.require(kind.key),
                       [&](const At& at_key) { return kind.read(table, at_key); });
}

/// Reads a table that must have the key of exactly one kind, and all the rest of its keys.
template <class Into>
[[nodiscard]] std::optional<Into> read_one_kind(const At& at, std::span<const Kind<Into>> kinds) {
  if (at.inquiry() != nullptr)
    return inquire_one_kind(at, kinds);
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
  if (!fits(*chosen, at.context)) {
    at_key.complain(chosen->scenes == Scenes::plane ? "only for scenes in the plane"
                                                    : "only for 3d scenes");
    return std::nullopt;
  }
  std::optional<Into> into = chosen->read(table, at_key);
  table.finish();
  return into;
}

} // namespace billet::io
