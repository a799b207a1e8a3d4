// Two layers of a part of the picture: behind, tools of glass; before them, all the rest.
//
// Glass in front of the part would mix its grey into the colours, and these have to be those of the
// legend. So the part is drawn over the glass, and only the edges of tools run across it. VTK in a
// header: only for sources of this folder.

#pragma once

#include "app/render/view.h"

#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <array>

namespace billet::render {

/// How lines are drawn.
struct Pen {
  float width = 1.0F; ///< [pixels]
  std::array<double, 3> colour{0.15, 0.15, 0.15};
  double opacity = 1.0;
  double lift = 0.0;  ///< towards the viewer of a scene of the plane [mm]
  double ahead = 1.0; ///< multiple of the usual offset before faces that it lies in
};

class Stage {
public:
  /// @param flat  colours without light, in the plane
  explicit Stage(bool flat);

  /// Puts both layers into the window: left, bottom, right, top as shares of it.
  void enter(vtkRenderWindow& window, const std::array<double, 4>& place);
  void look(const Aim& aim, const Sight& sight);

  /// Faces or lines in the colours of their array `Shown::values`.
  void add_coloured(vtkPolyData& data, vtkLookupTable& map, float line_width, double lift);
  /// Faces in one colour.
  ///
  /// @param hides  what lies in them: a tool lies in the faces that it touches, to the softness of
  ///               contact
  void add_plain(vtkPolyData& faces, const std::array<double, 3>& colour, bool hides = false);
  void add_glass(vtkPolyData& faces);
  void add_lines(vtkPolyData& lines, const Pen& pen);

private:
  void add(vtkRenderer& layer, vtkPolyDataMapper& mapper, vtkProperty& property, double lift);

  bool flat_;
  vtkNew<vtkRenderer> behind_, before_;
};

} // namespace billet::render
