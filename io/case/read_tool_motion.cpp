#include "io/case/one_kind.h"
#include "io/case/read_parts.h"
#include "io/case/values.h"

#include <array>

namespace billet::io {

namespace {

/// Rows [t, ux, uy(, uz)] as one function of time for each component.
std::optional<DisplacementMotion> as_displacement(const At& at) {
  std::vector<Number> columns(at.context.in_space() ? 4 : 3, any_length);
  columns.front() = {quantity::duration, any_value};
  const auto rows = as_table(at, columns);
  if (!rows)
    return std::nullopt;
  DisplacementMotion motion;
  for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
    std::vector<std::pair<double, double>> points;
    for (const std::vector<double>& row : *rows)
      points.emplace_back(row[0], row[i + 1]);
    motion.displacement[i] = TimeFunction(std::move(points));
  }
  return motion;
}

template <class Turn> void read_axis(TableReader& table, Turn& turn) {
  table.required("point", turn.point, as_vector, any_length);
  if (table.context().in_space())
    table.required("axis", turn.axis, as_axis);
  else
    table.optional("axis", turn.axis, as_axis);
}

std::optional<RotationMotion> as_rotation(const At& at) {
  TableReader table(at);
  RotationMotion motion;
  read_axis(table, motion);
  table.required("speed", motion.speed, as_time_function,
                 Number{quantity::angular_speed, any_value});
  table.finish();
  return motion;
}

std::optional<TorqueMotion> as_torque(const At& at) {
  TableReader table(at);
  TorqueMotion motion;
  read_axis(table, motion);
  table.required("value", motion.value, as_time_function, Number{quantity::torque, any_value});
  if (at.context.analysis == Analysis::axisymmetric)
    at.complain("a tool of an axisymmetric scene cannot turn by itself, allowed is force");
  table.finish();
  return motion;
}

std::optional<ForceMotion> as_force(const At& at) {
  TableReader table(at);
  ForceMotion motion;
  table.required("direction", motion.direction, as_direction);
  table.required("value", motion.value, as_time_function, Number{quantity::force, any_value});
  refuse_radial(table, motion.direction);
  table.finish();
  return motion;
}

std::optional<VelocityMotion> as_velocity(const At& at) {
  const std::optional<Vec3> velocity = as_vector(at, {quantity::speed, any_value});
  return velocity ? std::optional(VelocityMotion{*velocity}) : std::nullopt;
}

/// Complains when more than one of the keys is there.
void refuse_two(TableReader& table, std::initializer_list<std::string_view> keys) {
  bool has_one = false;
  for (const std::string_view key : keys) {
    const std::optional<At> at = table.find(key);
    if (at && has_one)
      at->complain("the motion is given already by another key, allowed is one");
    has_one = has_one || at.has_value();
  }
}

} // namespace

void refuse_radial(TableReader& table, const Vec3& direction) {
  if (table.context().analysis == Analysis::axisymmetric && direction.x() != 0.0)
    table.find("direction")->refuse("found a radial part, allowed is [0, 1] or [0, -1]");
}

std::optional<ToolMotion> as_tool_motion(const At& at) {
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  ToolMotion motion;
  table.optional("velocity", motion.translation, as_velocity);
  table.optional("displacement", motion.translation, as_displacement);
  table.optional("force", motion.translation, as_force);
  table.optional("press", motion.translation, as_press);
  table.optional("rotation", motion.rotation, as_rotation);
  table.optional("torque", motion.rotation, as_torque);
  refuse_two(table, {"velocity", "displacement", "force", "press"});
  refuse_two(table, {"rotation", "torque"});
  if (!table.find("velocity") && !table.find("displacement") && !table.find("force") &&
      !table.find("press") && !table.find("rotation") && !table.find("torque"))
    complain_of_kinds(at, table,
                      "allowed is velocity, displacement, force, press, rotation or torque");
  else
    table.finish();
  return motion;
}

} // namespace billet::io
