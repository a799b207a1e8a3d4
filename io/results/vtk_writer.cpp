#include "io/results/vtk_writer.h"

#include "io/results/atomic_file.h"
#include "io/results/packed_data.h"
#include "io/results/xml_text.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

/// VTK's number of a cell's type.
std::uint8_t vtk_type(ElementKind kind) {
  constexpr std::uint8_t tetra = 10, quad = 9, hexahedron = 12, quadratic_triangle = 22,
                         quadratic_quad = 23, quadratic_tetra = 24, quadratic_hexahedron = 25;
  switch (kind) {
  case ElementKind::quad4:
    return quad;
  case ElementKind::quad8:
    return quadratic_quad;
  case ElementKind::tri6:
    return quadratic_triangle;
  case ElementKind::hex8:
    return hexahedron;
  case ElementKind::hex20:
    return quadratic_hexahedron;
  case ElementKind::tet4:
    return tetra;
  case ElementKind::tet10:
    return quadratic_tetra;
  }
  return 0;
}

/// What the components of a vector or a tensor are called, as a person picks one in ParaView.
std::span<const std::string_view> component_names(int components) {
  static constexpr std::array<std::string_view, 3> vector{"X", "Y", "Z"};
  static constexpr std::array<std::string_view, 6> tensor{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  if (components == 3)
    return vector;
  return components == 6 ? std::span<const std::string_view>(tensor)
                         : std::span<const std::string_view>();
}

/// The attributes of an array that tell of its components.
std::string shape_of(int components) {
  std::string shape = fmt::format("NumberOfComponents=\"{}\"", components);
  int number = 0;
  for (const std::string_view name : component_names(components))
    shape += fmt::format(" ComponentName{}=\"{}\"", number++, name);
  return shape;
}

template <class T> constexpr std::string_view type_name;
template <> constexpr std::string_view type_name<double> = "Float64";
template <> constexpr std::string_view type_name<Index> = "Int32";
template <> constexpr std::string_view type_name<std::uint8_t> = "UInt8";
static_assert(sizeof(Index) == sizeof(std::int32_t));

/// The text of a file, put together line by line.
class VtkText {
public:
  VtkText(std::string_view type, Packing packing) : type_(type), packing_(packing) {
    line("<?xml version=\"1.0\"?>");
    line("<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\"{}>", type_,
         std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian",
         packing == Packing::zlib ? " compressor=\"vtkZLibDataCompressor\"" : "");
    line("<{}>", type_);
  }

  template <class... Args> void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }
  template <class T>
  void array(std::string_view name, std::span<const T> values, std::string_view shape = "") {
    line("<DataArray type=\"{}\" Name=\"{}\" {} format=\"binary\">", type_name<T>,
         xml_escaped(name), shape);
    append_packed(std::as_bytes(values), packing_, text_);
    text_ += "\n</DataArray>\n";
  }
  void points(std::span<const Vec3> points) {
    line("<Points>");
    array("Points", std::span(points.empty() ? nullptr : points.front().data(), 3 * points.size()),
          "NumberOfComponents=\"3\"");
    line("</Points>");
  }
  void
  fields(std::string_view place, const std::vector<Field>& fields, [[maybe_unused]] std::size_t n) {
    line("<{}>", place);
    for (const Field& field : fields) {
      assert(field.values.size() == n * idx(field.components));
      array<double>(field.name, field.values, shape_of(field.components));
    }
    line("</{}>", place);
  }
  /// Time, notes and units: what is true for a frame as a whole. A text is the name of an array
  /// with one number.
  template <class Frame> void field_data(const Frame& frame) {
    line("<FieldData>");
    array("TimeValue", std::span(&frame.time, 1), single);
    for (const auto& [name, value] : frame.notes)
      note(name, value);
    for (const std::vector<Field>* fields : {&frame.point_fields, &frame.cell_fields})
      for (const Field& field : *fields)
        if (!field.unit.empty())
          note("unit of " + field.name, field.unit);
    line("</FieldData>");
  }

  std::string finished() {
    line("</Piece>");
    line("</{}>", type_);
    line("</VTKFile>");
    return std::move(text_);
  }

private:
  static constexpr std::string_view single = "NumberOfTuples=\"1\"";

  void note(std::string_view name, std::string_view value) {
    constexpr std::uint8_t present = 1;
    array(fmt::format("{}: {}", name, value), std::span(&present, 1), single);
  }

  std::string_view type_;
  Packing packing_;
  std::string text_;
};

/// Compresses what a disk would feel. Packing a small frame costs more than all the rest of
/// writing it.
template <class Frame> Packing packing_for(const Frame& frame) {
  std::size_t values = 3 * frame.points.size();
  for (const std::vector<Field>* fields : {&frame.point_fields, &frame.cell_fields})
    for (const Field& field : *fields)
      values += field.values.size();
  constexpr std::size_t large = 65536;
  return values < large ? Packing::plain : Packing::zlib;
}

/// Cells of any length: their nodes one after another, and where each cell ends.
struct CellLists {
  std::vector<Index> nodes;
  std::vector<Index> ends;

  explicit CellLists(const std::vector<std::vector<Index>>& cells) {
    for (const std::vector<Index>& cell : cells) {
      nodes.insert(nodes.end(), cell.begin(), cell.end());
      ends.push_back(static_cast<Index>(nodes.size()));
    }
  }
};

} // namespace

void add_face(SurfaceFrame& frame, std::span<const Index> nodes, int dimension) {
  if (dimension == 2) {
    std::vector<Index>& line = frame.lines.emplace_back(nodes.begin(), nodes.end());
    if (line.size() == 3)
      std::swap(line[1], line[2]);
    return;
  }
  std::vector<Index>& polygon = frame.polygons.emplace_back();
  const bool quadratic = nodes.size() > 4;
  const std::size_t n_corners = quadratic ? nodes.size() / 2 : nodes.size();
  for (std::size_t i = 0; i < n_corners; ++i) {
    polygon.push_back(nodes[i]);
    if (quadratic)
      polygon.push_back(nodes[n_corners + i]);
  }
}

void write_vtu(const std::filesystem::path& path, const WorkpieceFrame& frame) {
  const std::size_t n_nodes = idx(mechanics::nodes_per_element(frame.kind));
  const std::size_t n_cells = frame.cells.size() / n_nodes;
  std::vector<Index> ends(n_cells);
  for (std::size_t i = 0; i < n_cells; ++i)
    ends[i] = static_cast<Index>((i + 1) * n_nodes);
  VtkText text("UnstructuredGrid", packing_for(frame));
  text.field_data(frame);
  text.line("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", frame.points.size(), n_cells);
  text.fields("PointData", frame.point_fields, frame.points.size());
  text.fields("CellData", frame.cell_fields, n_cells);
  text.points(frame.points);
  text.line("<Cells>");
  text.array("connectivity", frame.cells);
  text.array<Index>("offsets", ends);
  text.array<std::uint8_t>("types", std::vector(n_cells, vtk_type(frame.kind)));
  text.line("</Cells>");
  write_file(path, text.finished());
}

void write_vtp(const std::filesystem::path& path, const SurfaceFrame& frame) {
  VtkText text("PolyData", packing_for(frame));
  text.field_data(frame);
  text.line("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">",
            frame.points.size(), frame.lines.size(), frame.polygons.size());
  text.fields("PointData", frame.point_fields, frame.points.size());
  text.fields("CellData", frame.cell_fields, frame.lines.size() + frame.polygons.size());
  text.points(frame.points);
  const auto add = [&text](std::string_view place, const std::vector<std::vector<Index>>& cells) {
    const CellLists lists(cells);
    text.line("<{}>", place);
    text.array<Index>("connectivity", lists.nodes);
    text.array<Index>("offsets", lists.ends);
    text.line("</{}>", place);
  };
  add("Lines", frame.lines);
  add("Polys", frame.polygons);
  write_file(path, text.finished());
}

} // namespace billet::io
