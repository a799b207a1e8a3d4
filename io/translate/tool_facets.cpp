#include "io/translate/tool_facets.h"

#include "geometry/base/angle.h"
#include "geometry/surfaces/smooth_triangle_surface.h"
#include "io/tools/stl_tool.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace billet::io {

std::string stl_text(const std::string& name, const std::vector<Facet>& facets) {
  std::string text = "solid " + name + "\n";
  for (const Facet& f : facets) {
    const Vec3 n = (f[1] - f[0]).cross(f[2] - f[0]).normalized();
    text += fmt::format(" facet normal {:.9g} {:.9g} {:.9g}\n  outer loop\n", n[0], n[1], n[2]);
    for (const Vec3& corner : f)
      text += fmt::format("   vertex {:.9g} {:.9g} {:.9g}\n", corner[0], corner[1], corner[2]);
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

std::string stl_surface(const std::string& file, const std::string& unit, double feature_angle) {
  return fmt::format("{{ stl = \"{}\", unit = \"{}\"{} }}", file, unit,
                     feature_angle > 0.0
                         ? fmt::format(", smooth = true, feature_angle = {:.4g}", feature_angle)
                         : "");
}

std::optional<double> curving_of(const std::vector<Facet>& facets, double feature_angle) {
  FacetFile file;
  file.facets = facets;
  const StlTool tool = examine(file, {1.0, false, feature_angle});
  if (!tool.complaints.empty())
    return std::nullopt;
  return geometry::chord_error(tool.mesh, feature_angle * degree);
}

} // namespace billet::io
