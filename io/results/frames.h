// What a person sees of a run at one time: fields at the nodes, at the faces, of the tools.
//
// Values of integration points reach the nodes without extrapolation: each node takes the nearest
// point of every element around it and the mean of these, so no picture shows more than the largest
// computed value. Field names: DESIGN's list; units are those of the case.

#pragma once

#include "io/case/case.h"
#include "io/results/vtk_writer.h"
#include "process/loop/process.h"

#include <span>
#include <string>
#include <vector>

namespace billet::io {

/// Labels and choices that every frame shares.
struct FrameSettings {
  UnitSystem units;
  std::string analysis; ///< "plane-strain", "axisymmetric", "3d"
  std::string title;
};

/// The workpiece with its fields.
[[nodiscard]] WorkpieceFrame workpiece_frame(const process::Run& run,
                                             std::span<const Vec3> points,
                                             const FrameSettings& settings);
/// The candidate faces with pressure, shear, gap and status of their points (means over a face).
[[nodiscard]] SurfaceFrame
contact_frame(const process::Run& run, std::span<const Vec3> points, const FrameSettings& settings);
/// A tool where it is now; unbounded surfaces are drawn a little beyond the workpiece, and as far
/// as they are worn.
[[nodiscard]] SurfaceFrame tool_frame(const process::Run& run,
                                      std::size_t tool,
                                      std::span<const Vec3> points,
                                      const FrameSettings& settings);

/// Names of all fields a frame may hold; the last one only with `fields = "all"`.
[[nodiscard]] const std::vector<std::string>& known_fields();

/// Complains of names in the case's `output.fields` that are no field.
/// @throws Error (Fault::case_file)
void require_known_fields(const OutputSettings& output, const std::string& place);

/// Keeps the fields that the case asks for.
void select_fields(std::vector<Field>& fields, const OutputSettings& output);

/// Positions of unknowns as points in space, z = 0 in the plane.
[[nodiscard]] std::vector<Vec3> points_of(std::span<const double> x, int dimension);

} // namespace billet::io
