// Writes a law with all its keys; the mirror of read_law.h.

#pragma once

#include "io/case/law_keys.h"
#include "io/case/toml_text.h"

namespace billet::io {

/// What a law has besides numbers; most have nothing.
template <class Law> void write_more(TomlTable& /*table*/, const Law& /*law*/) {}

void write_more(TomlTable& table, const TableFlow& law);
void write_more(TomlTable& table, const PerzynaFlow& law);
void write_more(TomlTable& table, const CoulombFriction& law);
void write_more(TomlTable& table, const TrescaFriction& law);
void write_more(TomlTable& table, const ShawFriction& law);
void write_more(TomlTable& table, const AsperityFriction& law);

/// Writes the name and the keys of a law, without its coefficient where a table stands in its
/// place. Numbers that may be absent and are 0 are left out: they
/// say nothing, and some are not available in every version.
template <class Law>
void write_law(TomlTable& table, const Law& law, bool with_coefficient = true) {
  table.add("law", toml_text(LawKeys<Law>::name));
  for (const auto& key : LawKeys<Law>::keys)
    if ((key.is_required || law.*key.member != 0.0) && (with_coefficient || !key.is_coefficient))
      table.add(key.key, toml_text(law.*key.member));
  write_more(table, law);
}

} // namespace billet::io
