// Reads "law = NAME" and the keys of that law into a variant of laws.

#pragma once

#include "io/case/law_keys.h"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

namespace billet::io {

/// What a law has besides numbers; most have nothing.
template <class Law> void read_more(TableReader& /*table*/, Law& /*law*/) {}

// Of flow laws (read_material.cpp).
void read_more(TableReader& table, VoceFlow& law);
void read_more(TableReader& table, TableFlow& law);
void read_more(TableReader& table, PerzynaFlow& law);
void read_more(TableReader& table, JohnsonCookFlow& law);
void read_more(TableReader& table, HanselSpittelFlow& law);

// Of friction laws (read_friction.cpp).
void read_more(TableReader& table, CoulombFriction& law);
void read_more(TableReader& table, TrescaFriction& law);
void read_more(TableReader& table, ShawFriction& law);
void read_more(TableReader& table, AsperityFriction& law);

/// Reads all keys of one law.
template <class Law, class AnyLaw> void read_one_law(TableReader& table, AnyLaw& into) {
  Law law;
  for (const auto& key : LawKeys<Law>::keys) {
    if (key.is_coefficient && table.find("table")) {
      if (const std::optional<At> at = table.find(key.key))
        at->complain("'table' stands in its place: give one of the two");
      law.*key.member = 1.0;
    } else if (key.is_required)
      table.required(key.key, law.*key.member, as_number, key.kind);
    else
      table.optional(key.key, law.*key.member, as_number, key.kind);
  }
  read_more(table, law);
  into = std::move(law);
}

/// The laws of a variant by name.
template <class AnyLaw> struct LawReaders;

template <class... Laws> struct LawReaders<std::variant<Laws...>> {
  using Any = std::variant<Laws...>;
  using Reader = void (*)(TableReader&, Any&);
  static constexpr std::array<Word<Reader>, sizeof...(Laws)> words{
      Word<Reader>{LawKeys<Laws>::name, &read_one_law<Laws, Any>}...};
};

/// Reads the key "law" and the keys of that law. False: there is no such law (complained).
template <class AnyLaw> bool read_law(TableReader& table, AnyLaw& into) {
  typename LawReaders<AnyLaw>::Reader reader = nullptr;
  const auto parse = [](const At& at) { return as_word(at, LawReaders<AnyLaw>::words); };
  if (!table.required("law", reader, parse))
    return false;
  reader(table, into);
  return true;
}

} // namespace billet::io
