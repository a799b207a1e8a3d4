#include "io/case/setting_words.h"
#include "io/case/write_law.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <span>
#include <utility>

namespace billet::io {

namespace {

/// { KEY = { ... }, inside = ... }.
std::string with_inside(std::string_view key, const TomlTable& inner, bool inside) {
  return TomlTable().add(key, inner.on_one_line()).add("inside", toml_text(inside)).on_one_line();
}

std::string surface_text(const PlaneSurface& surface, int size) {
  TomlTable inner;
  inner.add("point", toml_text(surface.point, size)).add("normal", toml_text(surface.normal, size));
  return TomlTable().add("plane", inner.on_one_line()).on_one_line();
}

std::string surface_text(const CircleSurface& surface, int size) {
  TomlTable inner;
  inner.add("centre", toml_text(surface.centre, size)).add("radius", toml_text(surface.radius));
  return with_inside("circle", inner, surface.inside);
}

std::string surface_text(const SphereSurface& surface, int size) {
  TomlTable inner;
  inner.add("centre", toml_text(surface.centre, size)).add("radius", toml_text(surface.radius));
  return with_inside("sphere", inner, surface.inside);
}

std::string surface_text(const CylinderSurface& surface, int size) {
  TomlTable inner;
  inner.add("point", toml_text(surface.point, size))
      .add("axis", toml_text(surface.axis, size))
      .add("radius", toml_text(surface.radius));
  return with_inside("cylinder", inner, surface.inside);
}

std::string surface_text(const ConeSurface& surface, int size) {
  TomlTable inner;
  inner.add("apex", toml_text(surface.apex, size))
      .add("axis", toml_text(surface.axis, size))
      .add("half_angle", toml_text(surface.half_angle));
  return with_inside("cone", inner, surface.inside);
}

std::string surface_text(const TorusSurface& surface, int size) {
  TomlTable inner;
  inner.add("centre", toml_text(surface.centre, size))
      .add("axis", toml_text(surface.axis, size))
      .add("major", toml_text(surface.major))
      .add("minor", toml_text(surface.minor));
  return with_inside("torus", inner, surface.inside);
}

std::string surface_text(const RevolutionSurface& surface, int size) {
  TomlTable inner;
  inner.add("point", toml_text(surface.point, size)).add("axis", toml_text(surface.axis, size));
  if (surface.profile) {
    inner.add("profile", toml_text(*surface.profile));
  } else {
    std::vector<std::string> points;
    for (const Vec2& point : surface.points)
      points.push_back(toml_text(std::vector<double>{point.x(), point.y()}));
    inner.add("points", toml_list(points)).add("closed", toml_text(surface.closed));
  }
  inner.add("flip", toml_text(surface.flip));
  return TomlTable().add("revolution", inner.on_one_line()).on_one_line();
}

std::string surface_text(const ProfileSurface& surface, int /*size*/) {
  return TomlTable()
      .add("profile", toml_text(surface.file))
      .add("flip", toml_text(surface.flip))
      .on_one_line();
}

std::string surface_text(const PointsSurface& surface, int size) {
  std::vector<std::string> points;
  for (const Vec3& point : surface.points)
    points.push_back(toml_text(point, size));
  return TomlTable()
      .add("points", toml_list(points))
      .add("closed", toml_text(surface.closed))
      .add("flip", toml_text(surface.flip))
      .on_one_line();
}

std::string surface_text(const StlSurface& surface, int /*size*/) {
  return TomlTable()
      .add("stl", toml_text(surface.file))
      .add("unit", toml_text(std::string_view(surface.unit)))
      .add("smooth", toml_text(surface.smooth))
      .add("feature_angle", toml_text(surface.feature_angle))
      .add("flip", toml_text(surface.flip))
      .on_one_line();
}

std::string surface_text(const StepSurface& surface, int /*size*/) {
  TomlTable table;
  table.add("step", toml_text(surface.file));
  if (surface.chord_error)
    table.add("chord_error", toml_text(*surface.chord_error));
  return table.add("smooth", toml_text(surface.smooth))
      .add("feature_angle", toml_text(surface.feature_angle))
      .add("flip", toml_text(surface.flip))
      .on_one_line();
}

void write_motion(TomlTable& table, const VelocityMotion& motion, int size) {
  table.add("velocity", toml_text(motion.velocity, size));
}

void write_motion(TomlTable& table, const DisplacementMotion& motion, int size) {
  std::vector<std::string> rows;
  const auto& times = motion.displacement.front().points();
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::vector<double> row{times[i].first};
    for (std::size_t j = 0; j < static_cast<std::size_t>(size); ++j)
      row.push_back(motion.displacement[j].points()[i].second);
    rows.push_back(toml_text(row));
  }
  table.add("displacement", toml_list(rows));
}

void write_motion(TomlTable& table, const ForceMotion& motion, int size) {
  TomlTable inner;
  inner.add("direction", toml_text(motion.direction, size)).add("value", toml_text(motion.value));
  table.add("force", inner.on_one_line());
}

TomlTable press_table(const CrankMotion& crank, int size) {
  return TomlTable()
      .add("kind", "\"crank\"")
      .add("direction", toml_text(crank.direction, size))
      .add("radius", toml_text(crank.radius))
      .add("rod", toml_text(crank.rod))
      .add("speed", toml_text(crank.speed))
      .add("start", toml_text(crank.start));
}

TomlTable striking_table(std::string_view kind, const StrikingPress& press, int size) {
  return TomlTable()
      .add("kind", toml_text(kind))
      .add("direction", toml_text(press.direction, size))
      .add("efficiency", toml_text(press.efficiency))
      .add("force", toml_text(press.force));
}

TomlTable press_table(const HammerMotion& hammer, int size) {
  return striking_table("hammer", hammer.press, size)
      .add("mass", toml_text(hammer.mass))
      .add("velocity", toml_text(hammer.velocity));
}

TomlTable press_table(const ScrewMotion& screw, int size) {
  return striking_table("screw", screw.press, size)
      .add("inertia", toml_text(screw.inertia))
      .add("pitch", toml_text(screw.pitch))
      .add("speed", toml_text(screw.speed))
      .add("mass", toml_text(screw.mass));
}

void write_motion(TomlTable& table, const PressMotion& motion, int size) {
  const TomlTable inner =
      std::visit([&](const auto& press) { return press_table(press, size); }, motion);
  table.add("press", inner.on_one_line());
}

void write_motion(TomlTable& table, const RotationMotion& motion, int size) {
  TomlTable inner;
  inner.add("point", toml_text(motion.point, size))
      .add("axis", toml_text(motion.axis, 3))
      .add("speed", toml_text(motion.speed));
  table.add("rotation", inner.on_one_line());
}

void write_motion(TomlTable& table, const TorqueMotion& motion, int size) {
  TomlTable inner;
  inner.add("point", toml_text(motion.point, size))
      .add("axis", toml_text(motion.axis, 3))
      .add("value", toml_text(motion.value));
  table.add("torque", inner.on_one_line());
}

std::string motion_text(const ToolMotion& motion, int size) {
  TomlTable table;
  const auto write = [&](const auto& kind) { write_motion(table, kind, size); };
  if (motion.translation)
    std::visit(write, *motion.translation);
  if (motion.rotation)
    std::visit(write, *motion.rotation);
  return table.on_one_line();
}

/// Values of a table as lists within lists, one level for each axis that is given.
std::string nested(std::span<const double> values, std::span<const std::size_t> sizes) {
  if (sizes.size() == 1)
    return toml_text(std::vector<double>(values.begin(), values.end()));
  std::vector<std::string> rows;
  const std::size_t size = values.size() / sizes.front();
  for (std::size_t i = 0; i < sizes.front(); ++i)
    rows.push_back(nested(values.subspan(i * size, size), sizes.subspan(1)));
  return fmt::format("[{}]", fmt::join(rows, ", "));
}

std::string table_text(const FrictionTable& friction) {
  TomlTable table;
  std::vector<std::size_t> sizes;
  for (const auto& [key, axis] :
       {std::pair{"pressure", &friction.pressure}, std::pair{"speed", &friction.speed},
        std::pair{"sliding", &friction.sliding}}) {
    if (axis->empty())
      continue;
    table.add(key, toml_text(*axis));
    sizes.push_back(axis->size());
  }
  return table.add("values", nested(friction.values, sizes)).on_one_line();
}

} // namespace

std::string toml_text(const Friction& friction, int size) {
  TomlTable table;
  const bool with_coefficient = friction.table.values.empty();
  std::visit([&](const auto& law) { write_law(table, law, with_coefficient); }, friction.law);
  if (friction.tensor) {
    const auto& [first, second] = *friction.tensor;
    table.add("tensor",
              fmt::format("[[{}, {}], [{}, {}]]", first[0], first[1], second[0], second[1]));
  }
  if (friction.direction)
    table.add("direction", toml_text(*friction.direction, size));
  if (!friction.evolution.empty())
    table.add("evolution", toml_text(friction.evolution));
  if (!friction.table.values.empty())
    table.add("table", table_text(friction.table));
  return table.on_one_line();
}

std::string toml_text(const Tool& tool, int size) {
  TomlTable table;
  table.add("name", toml_text(std::string_view(tool.name)))
      .add("surface",
           std::visit([&](const auto& kind) { return surface_text(kind, size); }, tool.surface))
      .add("place", toml_text(tool.place, size));
  if (tool.motion.translation || tool.motion.rotation)
    table.add("motion", motion_text(tool.motion, size));
  table.add("touch", toml_text(tool.touch)).add("friction", toml_text(tool.friction, size));
  if (tool.wear) {
    TomlTable wear;
    wear.add("law", "\"archard\"")
        .add("K", toml_text(tool.wear->K))
        .add("hardness", toml_text(tool.wear->hardness));
    if (tool.wear->K_workpiece)
      wear.add("K_workpiece", toml_text(*tool.wear->K_workpiece));
    wear.add("strokes", toml_text(tool.wear->strokes));
    table.add("wear", wear.on_one_line());
  }
  if (tool.active)
    table.add("active", fmt::format("[{}, {}]", (*tool.active)[0], (*tool.active)[1]));
  return table.on_lines();
}

} // namespace billet::io
