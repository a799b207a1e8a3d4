// From the triangles of an STL, or of a STEP file cut into such, to a surface fit for a tool.
//
// `examine` repairs what can be repaired within a tolerance and looks for everything a rigid tool
// must not have; `tool_mesh` refuses what it found. What was found and done is reported by
// stl_report.h.
//
// Units   lengths of the case after scaling. Guide: docs/guide/stl-tools.md.

#pragma once

#include "geometry/base/error.h"
#include "geometry/repair/mesh_health.h"
#include "geometry/repair/mesh_parts.h"
#include "geometry/repair/mesh_repair.h"
#include "geometry/repair/self_intersection.h"
#include "geometry/triangles/triangle_mesh.h"
#include "io/tools/facet_file.h"

#include <vector>

namespace billet::io {

/// How a file of triangles is to be taken.
struct StlUse {
  double scale = 1.0; ///< from the units of the file to those of the case, > 0
  bool flip = false;  ///< turns the surface inside out
  double feature_angle = geometry::default_feature_angle; ///< [degrees]
};

/// A surface after its repair, and what was found and done on the way.
struct StlTool {
  geometry::TriangleMesh mesh;
  geometry::Repairs repairs;
  geometry::MeshParts parts;
  geometry::MeshHealth health;               ///< after the repair
  geometry::SelfIntersections intersections; ///< only looked for if nothing else is wrong
  double precision = 0.0;            ///< of single-precision coordinates as large as these [mm]
  std::vector<Complaint> complaints; ///< why it cannot serve as a tool; empty: it can
};

/// Scales, repairs and checks.
[[nodiscard]] StlTool examine(const FacetFile& file, const StlUse& use);

/// The same for a surface that must serve as a tool.
///
/// @throws Error(Fault::geometry) with every complaint
[[nodiscard]] StlTool tool_mesh(const FacetFile& file, const StlUse& use);

} // namespace billet::io
