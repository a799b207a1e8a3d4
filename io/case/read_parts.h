// The parts of a case file, each read by a source of its own.

#pragma once

#include "io/case/table_reader.h"

#include <optional>
#include <vector>

namespace billet::io {

[[nodiscard]] std::optional<Material> as_material(const At& at);
[[nodiscard]] std::optional<Workpiece> as_workpiece(const At& at);
[[nodiscard]] std::optional<std::string> as_element(const At& at);
[[nodiscard]] std::optional<Support> as_support(const At& at);
[[nodiscard]] std::optional<Load> as_load(const At& at);
[[nodiscard]] std::optional<Tool> as_tool(const At& at);
[[nodiscard]] std::optional<ToolSurface> as_tool_surface(const At& at);
[[nodiscard]] std::optional<ToolMotion> as_tool_motion(const At& at);
/// The value of `press`, one of the motions of a press.
[[nodiscard]] std::optional<PressMotion> as_press(const At& at);
/// Complains of a direction with a radial part in an axisymmetric scene: tools go along its axis.
void refuse_radial(TableReader& table, const Vec3& direction);
[[nodiscard]] std::optional<Friction> as_friction(const At& at);
[[nodiscard]] std::optional<Place> as_place(const At& at);
[[nodiscard]] std::optional<ContactSettings> as_contact(const At& at);
[[nodiscard]] std::optional<TimeSettings> as_time(const At& at);
[[nodiscard]] std::optional<Stage> as_stage(const At& at);
[[nodiscard]] std::optional<SolverSettings> as_solver(const At& at);
[[nodiscard]] std::optional<Remesh> as_remesh(const At& at);
[[nodiscard]] std::optional<Measure> as_measure(const At& at);
[[nodiscard]] std::optional<StopSettings> as_stop(const At& at);
[[nodiscard]] std::optional<OutputSettings> as_output(const At& at);

/// Checks what no part can check alone: names that refer to other parts, times that must fit.
/// Sets the end of the run where the stages give it.
void check_whole(const At& root, Case& content);

} // namespace billet::io
