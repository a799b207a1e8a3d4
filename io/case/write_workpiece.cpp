#include "io/case/write_law.h"

#include <fmt/format.h>

#include <type_traits>

namespace billet::io {

namespace {

std::string mesh_text(const BoxMesh& mesh, int size) {
  std::vector<std::string> cells;
  std::vector<std::string> grading;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    cells.push_back(toml_text(mesh.cells[i]));
    grading.push_back(toml_text(mesh.grading[i]));
  }
  return TomlTable()
      .add("box", fmt::format("[{}, {}]", toml_text(mesh.low, size), toml_text(mesh.high, size)))
      .add("cells", toml_list(cells))
      .add("grading", toml_list(grading))
      .on_one_line();
}

std::string mesh_text(const CylinderMesh& mesh, int /*size*/) {
  TomlTable inner;
  inner.add("radius", toml_text(mesh.radius)).add("height", toml_text(mesh.height));
  return TomlTable()
      .add("cylinder", inner.on_one_line())
      .add("cells", fmt::format("[{}, {}]", mesh.cells[0], mesh.cells[1]))
      .add("sector", toml_text(mesh.sector))
      .on_one_line();
}

std::string mesh_text(const FileMesh& mesh, int /*size*/) {
  return TomlTable().add("file", toml_text(mesh.file)).on_one_line();
}

std::string mesh_text(const OutlineMesh& mesh, int /*size*/) {
  return TomlTable()
      .add("outline", toml_text(mesh.file))
      .add("size", toml_text(mesh.size))
      .on_one_line();
}

std::string mesh_text(const StlMesh& mesh, int /*size*/) {
  TomlTable table;
  table.add("stl", toml_text(mesh.file)).add("size", toml_text(mesh.size));
  if (!mesh.unit.empty())
    table.add("unit", toml_text(std::string_view(mesh.unit)));
  table.add("feature_angle", toml_text(mesh.feature_angle));
  if (mesh.details)
    table.add("details", toml_text(*mesh.details));
  return table.on_one_line();
}

std::string mesh_text(const StepMesh& mesh, int /*size*/) {
  TomlTable table;
  table.add("step", toml_text(mesh.file)).add("size", toml_text(mesh.size));
  if (mesh.chord_error)
    table.add("chord_error", toml_text(*mesh.chord_error));
  table.add("feature_angle", toml_text(mesh.feature_angle));
  if (mesh.details)
    table.add("details", toml_text(*mesh.details));
  return table.on_one_line();
}

} // namespace

std::string toml_text(const mechanics::AnyStaticLaw& law) { return law_text(law); }

std::string toml_text(const Material& material) {
  TomlTable elastic;
  elastic.add("young", toml_text(material.elastic.young))
      .add("poisson", toml_text(material.elastic.poisson));
  TomlTable table;
  if (!material.library.empty())
    table.add("library", toml_text(std::string_view(material.library)));
  table.add("elastic", elastic.on_one_line());
  if (material.flow)
    table.add("flow", law_text(*material.flow));
  if (material.hardness)
    table.add("hardness", toml_text(*material.hardness));
  if (material.density)
    table.add("density", toml_text(*material.density));
  if (material.heat_capacity)
    table.add("heat_capacity", toml_text(*material.heat_capacity));
  if (material.heating)
    table.add("heating", toml_text(*material.heating));
  return table.on_lines();
}

std::string toml_text(const Place& place, int size) {
  TomlTable table;
  table.add("translate", toml_text(place.translate, size));
  if (place.rotate) {
    TomlTable rotate;
    rotate.add("point", toml_text(place.rotate->point, size))
        .add("axis", toml_text(place.rotate->axis, 3))
        .add("degrees", toml_text(place.rotate->degrees));
    table.add("rotate", rotate.on_one_line());
  }
  return table.on_one_line();
}

std::string toml_text(const Workpiece& workpiece, int size) {
  return TomlTable()
      .add("element", toml_text(std::string_view(workpiece.element)))
      .add("material", toml_text(std::string_view(workpiece.material)))
      .add("mesh",
           std::visit([&](const auto& mesh) { return mesh_text(mesh, size); }, workpiece.mesh))
      .add("place", toml_text(workpiece.place, size))
      .on_lines();
}

} // namespace billet::io
