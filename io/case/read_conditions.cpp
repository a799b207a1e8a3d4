// Supports and loads.

#include "io/case/read_parts.h"
#include "io/case/values.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace billet::io {

namespace {

constexpr std::array components{Word<std::size_t>{"x", 0}, Word<std::size_t>{"y", 1},
                                Word<std::size_t>{"z", 2}};
constexpr std::array plane_components{components[0], components[1]};

std::optional<std::size_t> as_component(const At& at) {
  return at.context.in_plane() ? as_word(at, plane_components) : as_word(at, components);
}

std::optional<std::array<bool, 3>> as_fix(const At& at) {
  const List* const list = at.list(1);
  if (list == nullptr || list->empty()) {
    at.complain_found("a list of components such as [\"x\", \"y\"]");
    return std::nullopt;
  }
  std::array<bool, 3> fix{};
  for (std::size_t i = 0; i < list->size(); ++i)
    if (const auto component = as_component(at.item((*list)[i], i)))
      fix[*component] = true;
  return fix;
}

void read_move(TableReader& table, Support& support) {
  const std::optional<At> at = table.find("move");
  if (!at)
    return;
  TableReader move(*at);
  bool has_any = false;
  for (const Word<std::size_t>& component : components) {
    if (component.value == 2 && at->context.in_plane())
      continue;
    const std::optional<At> moved = move.find(component.word);
    if (!moved)
      continue;
    has_any = true;
    move.optional(component.word, support.move[component.value], as_time_function,
                  Number{quantity::length, any_value});
    if (support.fix[component.value])
      moved->complain("the component is fixed already, allowed is one of 'fix' and 'move'");
  }
  if (!has_any && move.is_table())
    at->refuse("allowed is a function of time for at least one component");
  move.finish();
}

std::optional<Load> as_pressure_load(TableReader& table) {
  PressureLoad load;
  table.required("pressure", load.pressure, as_time_function, Number{quantity::stress, any_value});
  return Load{{}, load};
}

std::optional<Load> as_traction_load(TableReader& table) {
  TractionLoad load{Vec3::Zero(), 1.0};
  table.required("traction", load.traction, as_vector, Number{quantity::stress, any_value});
  table.optional("amplitude", load.amplitude, as_time_function, Number{});
  return Load{{}, load};
}

std::optional<Load> as_body_force(TableReader& table) {
  BodyForce load{Vec3::Zero(), 1.0};
  table.required("body_force", load.force, as_vector, Number{quantity::force_density, any_value});
  table.optional("amplitude", load.amplitude, as_time_function, Number{});
  return Load{{}, load};
}

struct LoadKind {
  std::string_view key;
  std::optional<Load> (*read)(TableReader&);
};

constexpr std::array load_kinds{LoadKind{"pressure", &as_pressure_load},
                                LoadKind{"traction", &as_traction_load},
                                LoadKind{"body_force", &as_body_force}};

/// The one kind that the load has; complains about none and two.
const LoadKind* kind_of(TableReader& table) {
  if (Inquiry* const inquiry = table.at().inquiry()) {
    std::vector<std::string> keys(load_kinds.size());
    std::transform(load_kinds.begin(), load_kinds.end(), keys.begin(),
                   [](const LoadKind& kind) { return std::string(kind.key); });
    return &load_kinds[inquiry->choose(keys)];
  }
  const LoadKind* chosen = nullptr;
  for (const LoadKind& kind : load_kinds) {
    const std::optional<At> at = table.find(kind.key);
    if (at && chosen != nullptr)
      at->complain("the load has another kind already, allowed is one of pressure, traction and "
                   "body_force");
    if (at)
      chosen = &kind;
  }
  if (chosen == nullptr && table.is_table())
    table.at().refuse("allowed is exactly one of the keys pressure, traction, body_force");
  return chosen;
}

} // namespace

std::optional<Support> as_support(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Support support;
  table.optional("name", support.name, as_name);
  table.required("where", support.where, as_where);
  table.optional("fix", support.fix, as_fix);
  read_move(table, support);
  if (!table.find("fix") && !table.find("move"))
    at.refuse("allowed is at least one of the keys fix and move");
  table.finish();
  return support;
}

std::optional<Load> as_load(const At& at) {
  TableReader table(at);
  const LoadKind* const kind = kind_of(table);
  std::optional<Load> load = kind != nullptr ? kind->read(table) : std::nullopt;
  Where where;
  table.required("where", where, as_where);
  const bool is_body_force = load && std::holds_alternative<BodyForce>(load->kind);
  if (is_body_force && !std::holds_alternative<Everywhere>(where.kind))
    table.find("where")->complain_found("\"all\" for a body force");
  if (load)
    load->where = where;
  if (kind != nullptr)
    table.finish();
  return load;
}

} // namespace billet::io
