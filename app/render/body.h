// The part as it is drawn: faces with their fields, and lines on them, from the cells of a frame.
// VTK in a header: only for sources of this folder.

#pragma once

#include "app/render/copies.h"
#include "app/render/cuts.h"
#include "app/render/results.h"
#include "app/render/shown.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

namespace billet::render {

/// What becomes of a section or a sector before it is drawn.
struct Completion {
  std::optional<double> revolve; ///< [degree]
  std::vector<Copy> copies{Copy{}};
  std::vector<HalfSpace> sides; ///< of the mirror planes where the part is
  std::vector<Removed> removed;
  bool flat = false; ///< a scene of the plane, not revolved
};

struct Body {
  vtkSmartPointer<vtkPolyData> faces; ///< with normals, but in the plane
  vtkSmartPointer<vtkPolyData> lines; ///< edges of the elements, or lines of the metal
};

/// The workpiece. The active vectors of its points are the field `arrows`, where one is named.
/// @throws Error  (Fault::usage) for flow lines where there is no "displacement"
[[nodiscard]] Body body_of(const Frame& frame,
                           const Shown& shown,
                           const SceneOptions& options,
                           const Completion& completion);

/// Faces or lines that are no body, completed in the same way: contact faces, tools.
[[nodiscard]] vtkSmartPointer<vtkPolyData> completed(vtkPolyData& surface,
                                                     const Completion& completion);

} // namespace billet::render
