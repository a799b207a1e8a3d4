#include "io/case/one_kind.h"
#include "io/case/read_parts.h"
#include "io/case/values.h"

#include <fmt/format.h>

#include <array>

namespace billet::io {

namespace {

struct ElementName {
  std::string_view name;
  bool in_plane;
};

constexpr std::array element_names{
    ElementName{"quad8", true},  ElementName{"quad4", true}, ElementName{"tri6", true},
    ElementName{"hex20", false}, ElementName{"hex8", false}, ElementName{"tet10", false},
};

/// The element names that fit the scene; all where the analysis is not known.
std::vector<std::string> fitting_elements(const ReadContext& context) {
  std::vector<std::string> names;
  for (const ElementName& element : element_names)
    if (!context.analysis || element.in_plane == context.in_plane())
      names.emplace_back(element.name);
  return names;
}

void read_grading(TableReader& table, BoxMesh& box) {
  std::optional<Vec3> grading;
  table.optional("grading", grading, as_vector, positive_number);
  if (!grading)
    return;
  for (std::size_t i = 0; i < 3; ++i)
    box.grading[i] = (*grading)[static_cast<Eigen::Index>(i)];
  if (!table.context().in_space() && box.grading[2] == 0.0)
    box.grading[2] = 1.0;
}

void read_cells(TableReader& table, BoxMesh& box) {
  if (table.context().in_space()) {
    table.required("cells", box.cells, as_counts<3>);
    return;
  }
  std::array<int, 2> cells = {1, 1};
  table.required("cells", cells, as_counts<2>);
  box.cells = {cells[0], cells[1], 1};
}

void check_corners(const BoxMesh& box, const At& at) {
  for (Eigen::Index i = 0; i < (at.context.in_space() ? 3 : 2); ++i)
    if (!(box.low[i] < box.high[i]))
      at.refuse(fmt::format("the second corner must be above the first in {}, found {} and {}",
                            "xyz"[i], box.low[i], box.high[i]));
  if (at.context.analysis == Analysis::axisymmetric && box.low.x() < 0.0)
    at.refuse(fmt::format("found x = {}, allowed is x >= 0: x is the radius", box.low.x()));
}

std::optional<MeshSource> read_box_mesh(TableReader& table, const At& at) {
  BoxMesh box;
  const List* const corners = as_list(at, 2, "2 corners [[x0, y0], [x1, y1]]");
  if (corners != nullptr) {
    const auto low = as_vector(at.item((*corners)[0], 0), {quantity::length, any_value});
    const auto high = as_vector(at.item((*corners)[1], 1), {quantity::length, any_value});
    if (low && high) {
      box.low = *low;
      box.high = *high;
      check_corners(box, at);
    }
  }
  if (table.context().analysis) {
    read_cells(table, box);
    read_grading(table, box);
  } else { // their number is not known
    (void)table.find("cells");
    (void)table.find("grading");
  }
  return box;
}

std::optional<int> as_sector(const At& at) {
  const std::optional<double> degrees = as_number(at, {quantity::angle, positive});
  for (const int sector : {90, 180, 360})
    if (degrees == sector)
      return sector;
  if (degrees)
    at.complain_found("90, 180 or 360 degrees");
  return std::nullopt;
}

std::optional<MeshSource> read_cylinder_mesh(TableReader& table, const At& at) {
  CylinderMesh mesh;
  TableReader inner(at);
  inner.required("radius", mesh.radius, as_number, positive_length);
  inner.required("height", mesh.height, as_number, positive_length);
  inner.optional("sector", mesh.sector, as_sector);
  inner.finish();
  table.required("cells", mesh.cells, as_counts<2>);
  table.optional("sector", mesh.sector, as_sector);
  return mesh;
}

std::optional<MeshSource> read_mesh_file(TableReader& /*table*/, const At& at) {
  const std::optional<InputFile> file = as_input_file(at);
  if (!file)
    return std::nullopt;
  return FileMesh{*file, at.context.directory, at.context.allow_outside};
}

std::optional<MeshSource> read_outline_mesh(TableReader& table, const At& at) {
  OutlineMesh mesh;
  const std::optional<InputFile> file = as_input_file(at);
  table.required("size", mesh.size, as_number, positive_length);
  if (file)
    mesh.file = *file;
  return file ? std::optional<MeshSource>(mesh) : std::nullopt;
}

/// Edges kept, and what is passed over.
template <class Body> void read_shapes(TableReader& table, Body& mesh) {
  table.optional("feature_angle", mesh.feature_angle, as_number,
                 Number{quantity::angle, {0.0, 180.0}});
  table.optional("details", mesh.details, as_number, positive_length);
  if (mesh.details && mesh.size > 0.0 && *mesh.details > mesh.size)
    table.at().complain(fmt::format("details = {} is more than size = {}: tetrahedra cannot follow "
                                    "shapes smaller than they are in any case",
                                    *mesh.details, mesh.size),
                        "give details a value below size");
}

std::optional<MeshSource> read_stl_mesh(TableReader& table, const At& at) {
  StlMesh mesh;
  const std::optional<InputFile> file = as_input_file(at);
  LengthUnit unit;
  table.required("size", mesh.size, as_number, positive_length);
  table.optional("unit", unit, as_length_unit);
  read_shapes(table, mesh);
  mesh.unit = unit.name;
  mesh.unit_factor = unit.factor;
  if (file)
    mesh.file = *file;
  return file ? std::optional<MeshSource>(mesh) : std::nullopt;
}

std::optional<MeshSource> read_step_mesh(TableReader& table, const At& at) {
  StepMesh mesh;
  const std::optional<InputFile> file = as_input_file(at);
  table.required("size", mesh.size, as_number, positive_length);
  table.optional("chord_error", mesh.chord_error, as_number, positive_length);
  read_shapes(table, mesh);
  mesh.unit_factor = *length_factor("mm", at.context.units);
  if (file)
    mesh.file = *file;
  return file ? std::optional<MeshSource>(mesh) : std::nullopt;
}

std::optional<MeshSource> as_mesh(const At& at) {
  static constexpr std::array kinds{
      Kind<MeshSource>{"box", Scenes::all, &read_box_mesh},
      Kind<MeshSource>{"cylinder", Scenes::space, &read_cylinder_mesh},
      Kind<MeshSource>{"file", Scenes::all, &read_mesh_file},
      Kind<MeshSource>{"outline", Scenes::plane, &read_outline_mesh},
      Kind<MeshSource>{"stl", Scenes::space, &read_stl_mesh},
      Kind<MeshSource>{"step", Scenes::space, &read_step_mesh},
  };
  return read_one_kind<MeshSource>(at, kinds);
}

/// The element that a mesher makes; empty: those that are given make any.
std::string_view made_by(const MeshSource& mesh) {
  if (std::holds_alternative<OutlineMesh>(mesh))
    return "tri6";
  const bool body = std::holds_alternative<StlMesh>(mesh) || std::holds_alternative<StepMesh>(mesh);
  return body ? "tet10" : "";
}

} // namespace

std::optional<std::string> as_element(const At& at) {
  const std::vector<std::string> names = fitting_elements(at.context);
  const std::optional<std::size_t> index = as_word_index(at, names);
  return index ? std::optional(names[*index]) : std::nullopt;
}

std::optional<Workpiece> as_workpiece(const At& at) {
  TableReader table(at);
  Workpiece workpiece;
  workpiece.element = at.context.in_space() ? "hex20" : "quad8";
  table.optional("element", workpiece.element, as_element);
  table.required("material", workpiece.material, as_text);
  table.required("mesh", workpiece.mesh, as_mesh);
  table.optional("place", workpiece.place, as_place);
  table.finish();
  const std::string_view made = made_by(workpiece.mesh);
  if (!made.empty() && workpiece.element != made)
    at.complain(
        fmt::format("element is \"{}\", but what the program meshes itself is made of \"{}\"",
                    workpiece.element, made),
        fmt::format("set element = \"{}\"", made));
  return workpiece;
}

} // namespace billet::io
