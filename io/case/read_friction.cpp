#include "io/case/read_law.h"
#include "io/case/read_parts.h"

#include <array>

namespace billet::io {

namespace {

using Tensor = std::array<std::array<double, 2>, 2>;

std::optional<Tensor> as_tensor(const At& at) {
  const List* const rows = as_list(at, 2, "2 rows [[q11, q12], [q21, q22]]");
  if (rows == nullptr)
    return std::nullopt;
  Tensor tensor{};
  for (std::size_t i = 0; i < 2; ++i) {
    const At row_at = at.item((*rows)[i], i);
    const List* const row = as_list(row_at, 2, "2 numbers");
    if (row == nullptr)
      return std::nullopt;
    for (std::size_t j = 0; j < 2; ++j) {
      const std::optional<double> entry = as_number(row_at.item((*row)[j], j), {});
      if (!entry)
        return std::nullopt;
      tensor[i][j] = *entry;
    }
  }
  return tensor;
}

} // namespace

void read_more(TableReader& table, CoulombFriction& law) {
  table.optional("cap", law.cap, as_shear_strength);
}

void read_more(TableReader& table, TrescaFriction& law) {
  table.optional("k", law.k, as_shear_strength);
}

void read_more(TableReader& table, ShawFriction& law) {
  table.required("k", law.k, as_shear_strength);
}

void read_more(TableReader& table, AsperityFriction& law) {
  table.required("k", law.k, as_shear_strength);
}

std::optional<Friction> as_friction(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Friction friction;
  const bool has_law = read_law(table, friction.law);
  table.optional("tensor", friction.tensor, as_tensor);
  table.optional("direction", friction.direction, as_direction);
  table.optional("evolution", friction.evolution, as_pairs, Number{quantity::length, not_negative},
                 not_negative_number);
  table.optional("table", friction.table, as_pairs, not_negative_stress, not_negative_number);
  const std::optional<At> tensor = table.find("tensor");
  if (tensor && !table.find("direction"))
    tensor->complain("needs 'direction', the first axis of the tensor");
  if (has_law)
    table.finish();
  return friction;
}

} // namespace billet::io
