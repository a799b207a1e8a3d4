// Measures of the part's shape.

#include "io/case/read_parts.h"
#include "io/case/setting_words.h"
#include "io/case/values.h"

#include <fmt/format.h>

namespace billet::io {

namespace {

constexpr Number any_place{quantity::length, any_value};

/// Two corners, the second above the first.
std::optional<Box> as_box(const At& at) {
  const List* const corners = as_list(at, 2, "2 corners [[x0, y0], [x1, y1]]");
  if (corners == nullptr)
    return std::nullopt;
  const auto low = as_vector(at.item((*corners)[0], 0), any_place);
  const auto high = as_vector(at.item((*corners)[1], 1), any_place);
  if (!low || !high)
    return std::nullopt;
  for (Eigen::Index i = 0; i < (at.context.in_space() ? 3 : 2); ++i)
    if (!((*low)[i] < (*high)[i])) {
      at.refuse(fmt::format("the second corner must be above the first in {}, found {} and {}",
                            "xyz"[i], (*low)[i], (*high)[i]));
      return std::nullopt;
    }
  return Box{*low, *high};
}

bool is_radius(MeasureKind kind) {
  return kind == MeasureKind::equator_radius || kind == MeasureKind::contact_radius ||
         kind == MeasureKind::barrelling || kind == MeasureKind::bore;
}

bool needs_tool(MeasureKind kind) {
  return kind == MeasureKind::contact_radius || kind == MeasureKind::barrelling;
}

/// The line of radii: in axisymmetry the axis, in space given.
void read_axis(TableReader& table, Measure& measure) {
  const At& at = table.at();
  if (at.context.analysis == Analysis::plane_strain)
    at.complain("a radius needs an axis, which plane strain has not",
                "measure reach or height along a direction");
  if (!at.context.in_space())
    return;
  table.optional("point", measure.point, as_vector, any_place);
  table.required("axis", measure.axis, as_direction);
}

void read_of_kind(TableReader& table, Measure& measure) {
  if (is_radius(measure.kind))
    read_axis(table, measure);
  if (measure.kind == MeasureKind::height || measure.kind == MeasureKind::reach) {
    if (table.context().in_space() || measure.kind == MeasureKind::reach)
      table.required("direction", measure.direction, as_direction);
    else
      table.optional("direction", measure.direction, as_direction);
  }
  if (needs_tool(measure.kind)) {
    table.required("tool", measure.tool, as_name);
    table.optional("touching", measure.touching, as_number, positive_length);
  }
  if (measure.kind == MeasureKind::filling)
    table.required("within", measure.within, as_box);
  else
    table.optional("within", measure.within, as_box);
}

} // namespace

std::optional<Measure> as_measure(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  Measure measure;
  table.required("name", measure.name, as_name);
  if (table.required("kind", measure.kind,
                     [](const At& kind) { return as_choice(kind, measure_kinds); }))
    read_of_kind(table, measure);
  table.finish();
  return measure;
}

} // namespace billet::io
