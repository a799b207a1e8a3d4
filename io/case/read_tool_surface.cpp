#include "io/case/one_kind.h"
#include "io/case/read_parts.h"
#include "io/case/values.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace billet::io {

namespace {

/// `inside` is given next to the kind's key or in its table.
void read_inside(TableReader& outer, TableReader& inner, bool& inside) {
  const bool is_inner = inner.optional("inside", inside, as_flag);
  const bool is_outer = outer.optional("inside", inside, as_flag);
  if (is_inner && is_outer)
    outer.find("inside")->complain("given twice");
}

std::optional<ToolSurface> read_plane(TableReader& /*table*/, const At& at) {
  TableReader inner(at);
  PlaneSurface surface;
  inner.required("point", surface.point, as_vector, any_length);
  inner.required("normal", surface.normal, as_direction);
  inner.finish();
  return surface;
}

template <class Round> std::optional<ToolSurface> read_round(TableReader& table, const At& at) {
  TableReader inner(at);
  Round surface;
  inner.required("centre", surface.centre, as_vector, any_length);
  inner.required("radius", surface.radius, as_number, positive_length);
  read_inside(table, inner, surface.inside);
  inner.finish();
  return surface;
}

std::optional<ToolSurface> read_cylinder_surface(TableReader& table, const At& at) {
  TableReader inner(at);
  CylinderSurface surface;
  inner.required("point", surface.point, as_vector, any_length);
  inner.required("axis", surface.axis, as_direction);
  inner.required("radius", surface.radius, as_number, positive_length);
  read_inside(table, inner, surface.inside);
  inner.finish();
  return surface;
}

std::optional<ToolSurface> read_cone(TableReader& table, const At& at) {
  TableReader inner(at);
  ConeSurface surface;
  inner.required("apex", surface.apex, as_vector, any_length);
  inner.required("axis", surface.axis, as_direction);
  inner.required("half_angle", surface.half_angle, as_number,
                 Number{quantity::angle, {0.0, 90.0, true, true}});
  read_inside(table, inner, surface.inside);
  inner.finish();
  return surface;
}

std::optional<ToolSurface> read_torus(TableReader& table, const At& at) {
  TableReader inner(at);
  TorusSurface surface;
  inner.required("centre", surface.centre, as_vector, any_length);
  inner.required("axis", surface.axis, as_direction);
  const bool has_major = inner.required("major", surface.major, as_number, positive_length);
  const bool has_minor = inner.required("minor", surface.minor, as_number, positive_length);
  if (has_major && has_minor && surface.minor >= surface.major)
    inner.find("minor")->complain_found(fmt::format("less than major = {}", surface.major));
  read_inside(table, inner, surface.inside);
  inner.finish();
  return surface;
}

std::optional<ToolSurface> read_profile_surface(TableReader& table, const At& at) {
  ProfileSurface surface;
  const std::optional<InputFile> file = as_input_file(at);
  if (file)
    surface.file = *file;
  table.optional("flip", surface.flip, as_flag);
  return file ? std::optional<ToolSurface>(surface) : std::nullopt;
}

/// A point of a chain.
template <class Vec> std::optional<Vec> as_point(const At& at);

template <> std::optional<Vec3> as_point<Vec3>(const At& at) { return as_vector(at, any_length); }

/// (height, radius) of a turned chain.
template <> std::optional<Vec2> as_point<Vec2>(const At& at) {
  const List* const list = as_list(at, 2, "a list of 2 numbers, height along the axis and radius");
  if (list == nullptr)
    return std::nullopt;
  const std::optional<double> h = as_number(at.item((*list)[0], 0), any_length);
  const std::optional<double> r =
      as_number(at.item((*list)[1], 1), Number{quantity::length, not_negative});
  return h && r ? std::optional(Vec2(*h, *r)) : std::nullopt;
}

template <class Vec> std::optional<std::vector<Vec>> as_points(const At& at) {
  const List* const list = at.list(2);
  if (list == nullptr || list->size() < 2) {
    at.complain_found("a list of at least two points [[x, y], ...]");
    return std::nullopt;
  }
  std::vector<Vec> points;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::optional<Vec> point = as_point<Vec>(at.item((*list)[i], i));
    if (!point)
      return std::nullopt;
    if (!points.empty() && *point == points.back()) {
      at.item((*list)[i], i).complain("the same point as the one before");
      return std::nullopt;
    }
    points.push_back(*point);
  }
  return points;
}

/// `points`, and `closed` next to them; false if they could not be read.
template <class Vec>
bool read_chain(TableReader& table, const At& at, std::vector<Vec>& chain, bool& closed) {
  table.optional("closed", closed, as_flag);
  std::optional<std::vector<Vec>> points = as_points<Vec>(at);
  if (!points)
    return false;
  if (closed && (points->size() < 3 || points->front() == points->back()))
    at.complain("a closed chain needs three points or more, and the last is not the first again");
  chain = std::move(*points);
  return true;
}

std::optional<ToolSurface> read_points(TableReader& table, const At& at) {
  PointsSurface surface;
  table.optional("flip", surface.flip, as_flag);
  return read_chain(table, at, surface.points, surface.closed) ? std::optional<ToolSurface>(surface)
                                                               : std::nullopt;
}

std::optional<ToolSurface> read_revolution(TableReader& /*table*/, const At& at) {
  TableReader inner(at);
  RevolutionSurface surface;
  inner.required("point", surface.point, as_vector, any_length);
  inner.required("axis", surface.axis, as_direction);
  inner.optional("flip", surface.flip, as_flag);
  const bool has_profile = inner.has("profile");
  const std::optional<At> profile = has_profile ? inner.find("profile") : std::nullopt;
  const std::optional<At> points = // an inquiry sees either
      has_profile && at.inquiry() != nullptr ? std::nullopt : inner.find("points");
  bool good = false;
  if (profile && points)
    points->complain("there is 'profile' already, allowed is one of them");
  else if (profile)
    good = (surface.profile = as_input_file(*profile)).has_value();
  else if (points)
    good = read_value_of(*points, [&](const At& chain) {
      return read_chain(inner, chain, surface.points, surface.closed);
    });
  else if (inner.is_table())
    at.refuse("allowed is exactly one of the keys profile, points");
  inner.finish();
  return good ? std::optional<ToolSurface>(surface) : std::nullopt;
}

std::optional<ToolSurface> read_stl_surface(TableReader& table, const At& at) {
  StlSurface surface;
  LengthUnit unit;
  const std::optional<InputFile> file = as_input_file(at);
  if (file)
    surface.file = *file;
  table.required("unit", unit, as_length_unit);
  surface.unit = unit.name;
  surface.unit_factor = unit.factor;
  table.optional("smooth", surface.smooth, as_flag);
  table.optional("feature_angle", surface.feature_angle, as_number,
                 Number{quantity::angle, {0.0, 180.0}});
  table.optional("flip", surface.flip, as_flag);
  return file ? std::optional<ToolSurface>(surface) : std::nullopt;
}

std::optional<ToolSurface> read_step_surface(TableReader& table, const At& at) {
  StepSurface surface;
  const std::optional<InputFile> file = as_input_file(at);
  if (file)
    surface.file = *file;
  surface.unit_factor = *length_factor("mm", at.context.units);
  table.optional("chord_error", surface.chord_error, as_number, positive_length);
  table.optional("smooth", surface.smooth, as_flag);
  table.optional("feature_angle", surface.feature_angle, as_number,
                 Number{quantity::angle, {0.0, 180.0}});
  table.optional("flip", surface.flip, as_flag);
  return file ? std::optional<ToolSurface>(surface) : std::nullopt;
}

} // namespace

std::optional<ToolSurface> as_tool_surface(const At& at) {
  static constexpr std::array kinds{
      Kind<ToolSurface>{"plane", Scenes::all, &read_plane},
      Kind<ToolSurface>{"circle", Scenes::plane, &read_round<CircleSurface>},
      Kind<ToolSurface>{"cylinder", Scenes::space, &read_cylinder_surface},
      Kind<ToolSurface>{"sphere", Scenes::space, &read_round<SphereSurface>},
      Kind<ToolSurface>{"cone", Scenes::space, &read_cone},
      Kind<ToolSurface>{"torus", Scenes::space, &read_torus},
      Kind<ToolSurface>{"revolution", Scenes::space, &read_revolution},
      Kind<ToolSurface>{"profile", Scenes::plane, &read_profile_surface},
      Kind<ToolSurface>{"points", Scenes::plane, &read_points},
      Kind<ToolSurface>{"stl", Scenes::space, &read_stl_surface},
      Kind<ToolSurface>{"step", Scenes::space, &read_step_surface},
  };
  return read_one_kind<ToolSurface>(at, kinds);
}

} // namespace billet::io
