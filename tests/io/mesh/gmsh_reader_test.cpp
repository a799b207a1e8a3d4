#include "geometry/base/error.h"
#include "io/mesh/read_mesh.h"
#include "mechanics/elements/mesh_check.h"
#include "mechanics/mesh/mesh_edges.h"
#include "mechanics/mesh/mesh_generators.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace billet::io::gmsh_reader_test {
namespace {

using mechanics::ElementKind;
using mechanics::Index;
using mechanics::Mesh;
using test::TemporaryFolder;

constexpr std::array all_kinds{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                               ElementKind::hex8,  ElementKind::hex20, ElementKind::tet10};

int gmsh_type(ElementKind kind) {
  constexpr std::array numbers{3, 16, 9, 5, 17, 4, 11};
  return numbers[static_cast<std::size_t>(kind)];
}

/// Edges in Gmsh's order, from the drawings of its manual.
std::vector<std::pair<int, int>> gmsh_edges(ElementKind kind) {
  if (kind == ElementKind::hex20)
    return {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
            {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  if (kind == ElementKind::tet10)
    return {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}};
  std::vector<std::pair<int, int>> edges;
  for (const auto& [a, b] : mechanics::element_edges(kind))
    edges.emplace_back(a, b);
  return edges;
}

/// Nodes of a cell in Gmsh's order.
std::vector<Index> gmsh_order(ElementKind kind, std::span<const Index> cell) {
  const auto n = static_cast<std::size_t>(mechanics::corners_per_element(kind));
  std::vector<Index> nodes(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(n));
  if (!mechanics::is_quadratic(kind))
    return nodes;
  for (const auto& [a, b] : gmsh_edges(kind)) {
    const auto edges = mechanics::element_edges(kind);
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (std::minmax(edges[i][0], edges[i][1]) == std::minmax(a, b))
        nodes.push_back(cell[n + i]);
  }
  return nodes;
}

/// Builds a file piece by piece, in text or in bytes of either order.
class Writer {
public:
  enum class Mode { text, binary, swapped };
  explicit Writer(Mode mode) : mode_(mode) {}

  Writer& line(const std::string& text) { // always text
    content_ += text + "\n";
    return *this;
  }
  Writer& small(std::int32_t value) { return number(value); }
  Writer& large(std::int64_t value) { return number(value); }
  Writer& real(double value) { return number(value); }
  Writer& end_line() {
    content_ += "\n";
    return *this;
  }
  Writer& format(const std::string& version) {
    line("$MeshFormat").line(fmt::format("{} {} 8", version, mode_ == Mode::text ? 0 : 1));
    if (mode_ != Mode::text)
      small(1).end_line();
    return line("$EndMeshFormat");
  }
  [[nodiscard]] bool text() const { return mode_ == Mode::text; }
  [[nodiscard]] const std::string& content() const { return content_; }

private:
  template <class Number> Writer& number(Number value) {
    if (mode_ == Mode::text) {
      content_ += fmt::format("{} ", value);
      return *this;
    }
    std::array<char, sizeof(Number)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(Number));
    if (mode_ == Mode::swapped)
      std::reverse(bytes.begin(), bytes.end());
    content_.append(bytes.data(), bytes.size());
    return *this;
  }
  Mode mode_;
  std::string content_;
};

constexpr std::int64_t shift = 100; ///< node i of the mesh has the number 2 i + shift in the file
std::int64_t number_of(Index node) { return 2 * static_cast<std::int64_t>(node) + shift; }

constexpr const char* names = "$PhysicalNames\n2\n0 7 \"pinned nodes\"\n{0} 3 \"body\"\n"
                              "$EndPhysicalNames";

std::string version_2(const Mesh& mesh, Writer::Mode mode) {
  Writer file(mode);
  file.format("2.2").line(fmt::format(names, mesh.dimension()));
  file.line("$Nodes").line(std::to_string(mesh.n_points()));
  for (Index i = 0; i < mesh.n_points(); ++i) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(i)];
    file.small(static_cast<std::int32_t>(number_of(i))).real(p.x()).real(p.y()).real(p.z());
    if (file.text())
      file.end_line();
  }
  file.end_line().line("$EndNodes").line("$Elements").line(std::to_string(mesh.n_elements() + 1));
  const int type = gmsh_type(mesh.kind);
  if (file.text())
    file.small(1).small(15).small(2).small(7).small(1);
  else
    file.small(15).small(1).small(2).small(1).small(7).small(1);
  file.small(static_cast<std::int32_t>(number_of(0)));
  if (!file.text())
    file.small(type).small(mesh.n_elements()).small(2);
  for (Index i = 0; i < mesh.n_elements(); ++i) {
    if (file.text())
      file.end_line().small(i + 2).small(type).small(2).small(3).small(1);
    else
      file.small(i + 2).small(3).small(1);
    for (const Index node : gmsh_order(mesh.kind, mesh.cell(i)))
      file.small(static_cast<std::int32_t>(number_of(node)));
  }
  return file.end_line().line("$EndElements").content();
}

/// One point entity and one entity of the body, each in its group; nodes in two blocks.
void add_entities(Writer& file, int dimension) {
  file.line("$Entities").large(1).large(0);
  file.large(dimension == 2 ? 1 : 0).large(dimension == 3 ? 1 : 0);
  file.small(1).real(0).real(0).real(0).large(1).small(7);
  file.small(4);
  for (int i = 0; i < 6; ++i)
    file.real(0);
  file.large(1).small(-3).large(2).small(1).small(-2);
  file.end_line().line("$EndEntities");
}

std::string version_4(const Mesh& mesh, Writer::Mode mode) {
  Writer file(mode);
  const int dimension = mesh.dimension();
  file.format("4.1").line(fmt::format(names, dimension));
  add_entities(file, dimension);
  const auto point = [&](Index i) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(i)];
    file.real(p.x()).real(p.y()).real(p.z());
  };
  file.line("$Nodes").large(2).large(mesh.n_points()).large(shift).large(9999);
  file.small(0).small(1).small(0).large(1).large(number_of(0));
  point(0);
  file.small(2).small(4).small(1).large(mesh.n_points() - 1); // with parameters u, v
  for (Index i = 1; i < mesh.n_points(); ++i)
    file.large(number_of(i));
  for (Index i = 1; i < mesh.n_points(); ++i) {
    point(i);
    file.real(0.5).real(0.25);
  }
  file.end_line().line("$EndNodes").line("$Elements");
  file.large(2).large(mesh.n_elements() + 1).large(1).large(mesh.n_elements() + 1);
  file.small(0).small(1).small(15).large(1).large(1).large(number_of(0));
  file.small(dimension).small(4).small(gmsh_type(mesh.kind)).large(mesh.n_elements());
  for (Index i = 0; i < mesh.n_elements(); ++i) {
    file.large(i + 2);
    for (const Index node : gmsh_order(mesh.kind, mesh.cell(i)))
      file.large(number_of(node));
  }
  return file.end_line().line("$EndElements").content();
}

Mesh sample(ElementKind kind) {
  return mechanics::box_mesh(
      {.kind = kind, .high = {2, 3, 4}, .cells = {2, 3, 2}, .grading = {2, 1, 1}});
}

class GmshRoundTrip : public testing::TestWithParam<std::tuple<int, Writer::Mode>> {};

TEST_P(GmshRoundTrip, gives_back_points_cells_and_sets_of_every_kind) {
  const auto& [version, mode] = GetParam();
  for (const ElementKind kind : all_kinds) {
    const TemporaryFolder folder;
    const Mesh mesh = sample(kind);
    const std::string content = version == 2 ? version_2(mesh, mode) : version_4(mesh, mode);
    const MeshFile file = read_mesh(folder.file("part.msh", content));
    EXPECT_EQ(file.mesh.kind, kind);
    EXPECT_EQ(file.mesh.points, mesh.points) << name(kind);
    EXPECT_EQ(file.mesh.cells, mesh.cells) << name(kind);
    ASSERT_EQ(file.labels.nodes.size(), mesh.points.size());
    EXPECT_EQ(file.labels.nodes[3], number_of(3));
    ASSERT_EQ(file.labels.elements.size(), static_cast<std::size_t>(mesh.n_elements()));
    EXPECT_EQ(file.labels.elements[3], 5); // the first is of the pinned node
    ASSERT_EQ(file.mesh.node_sets.size(), 2U);
    EXPECT_EQ(file.mesh.node_sets.at("pinned nodes"), std::vector<Index>{0});
    EXPECT_EQ(file.mesh.node_sets.at("body").size(), mesh.points.size());
    EXPECT_TRUE(file.notes.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(versions,
                         GmshRoundTrip,
                         testing::Combine(testing::Values(2, 4),
                                          testing::Values(Writer::Mode::text,
                                                          Writer::Mode::binary,
                                                          Writer::Mode::swapped)));

// --- hand-written files --------------------------------------------------------------------------

constexpr const char* format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
constexpr const char* square = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";

std::string elements(const std::string& lines, int n) {
  return fmt::format("$Elements\n{}\n{}$EndElements\n", n, lines);
}

MeshFile read_text(const std::string& text) {
  const TemporaryFolder folder;
  return read_mesh(folder.file("part.msh", text));
}

/// The complaint of a file that cannot be read.
std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.file("part.msh", text);
  try {
    (void)read_mesh(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::geometry);
    EXPECT_FALSE(error.complaints().front().place.empty());
    return error.what();
  }
  return "";
}

TEST(GmshReader, groups_of_lower_dimension_become_sets_and_unnamed_ones_are_numbered) {
  const MeshFile file =
      read_text(std::string(format) + square +
                elements("1 1 2 5 1 1 2\n2 1 2 5 1 2 3\n3 1 2 0 1 3 4\n4 3 2 9 1 1 2 3 4\n", 4));
  EXPECT_EQ(file.mesh.n_elements(), 1);
  EXPECT_EQ(file.mesh.node_sets.at("curve-5"), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(file.mesh.node_sets.at("surface-9"), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(file.mesh.node_sets.size(), 2U);
}

TEST(GmshReader, an_element_repeated_for_a_second_group_is_kept_once) {
  const MeshFile file = read_text(std::string(format) + square +
                                  elements("1 3 2 1 1 1 2 3 4\n1 3 2 2 1 1 2 3 4\n", 2));
  EXPECT_EQ(file.mesh.n_elements(), 1);
  EXPECT_EQ(file.mesh.node_sets.size(), 2U);
  EXPECT_EQ(file.notes.size(), 1U);
}

TEST(GmshReader, nodes_within_faces_of_nine_node_elements_are_left_out_with_a_note) {
  std::string nodes = "$Nodes\n9\n";
  constexpr std::array<std::array<double, 2>, 9> places{
      {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}}};
  for (std::size_t i = 0; i < 9; ++i)
    nodes += fmt::format("{} {} {} 0\n", i + 1, places[i][0], places[i][1]);
  const MeshFile file =
      read_text(format + nodes + "$EndNodes\n" + elements("1 10 2 0 1 1 2 3 4 5 6 7 8 9\n", 1));
  EXPECT_EQ(file.mesh.kind, ElementKind::quad8);
  EXPECT_EQ(file.mesh.n_points(), 8);
  EXPECT_EQ(file.notes.size(), 2U);
}

TEST(GmshReader, sections_it_has_no_use_for_are_passed_over) {
  const MeshFile file =
      read_text(std::string(format) + "$Comments\n$Nodes in a comment\n$EndComments\n" + square +
                elements("1 3 2 0 1 1 2 3 4\n", 1) + "$NodeData\n1\n\"T\"\n$EndNodeData\n");
  EXPECT_EQ(file.mesh.n_points(), 4);
}

TEST(GmshReader, every_truncation_of_a_file_is_an_error_never_a_crash) {
  for (const auto mode : {Writer::Mode::text, Writer::Mode::binary})
    for (const bool new_format : {false, true}) {
      const Mesh mesh = mechanics::box_mesh({.kind = ElementKind::hex8});
      const std::string whole = new_format ? version_4(mesh, mode) : version_2(mesh, mode);
      const std::size_t end = whole.rfind("$EndElements");
      for (std::size_t length = 0; length < end + 12; ++length)
        ASSERT_NE(complaint(whole.substr(0, length)), "") << length;
    }
}

TEST(GmshReader, a_file_with_any_byte_changed_gives_a_mesh_or_an_error) {
  const Mesh mesh = mechanics::box_mesh({.kind = ElementKind::hex8});
  for (const auto mode : {Writer::Mode::text, Writer::Mode::binary})
    for (const bool new_format : {false, true}) {
      std::string content = new_format ? version_4(mesh, mode) : version_2(mesh, mode);
      for (std::size_t i = 0; i < content.size(); ++i) {
        const char before = std::exchange(content[i], i % 2 == 0 ? '9' : '\xff');
        EXPECT_NO_FATAL_FAILURE((void)complaint(content));
        content[i] = before;
      }
    }
}

struct Broken {
  const char* what;
  std::string content;
  const char* expected;
};

std::vector<Broken> broken_files() {
  const std::string head = format;
  const std::string quad = elements("1 3 2 0 1 1 2 3 4\n", 1);
  const std::string head_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  return {
      {"empty", "", "$MeshFormat"},
      {"something else", "solid part\nfacet normal 0 0 1\n", "$MeshFormat"},
      {"version 4.0", "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n", "version \"4.0\""},
      {"version 1", "$NOD\n4\n", "$MeshFormat"},
      {"numbers of 4 bytes", "$MeshFormat\n2.2 0 4\n$EndMeshFormat\n", "4 bytes"},
      {"no byte order", "$MeshFormat\n2.2 1 8\nabcd\n$EndMeshFormat\n", "byte order"},
      {"no nodes", head + quad, "node 1, which is not given"},
      {"no elements", head + square, "no $Elements"},
      {"no closing line", head + "$Nodes\n1\n1 0 0 0\n" + quad, "$EndNodes is expected"},
      {"too few nodes", head + "$Nodes\n5\n1 0 0 0\n2 1 0 0\n$EndNodes\n" + quad, "part.msh:8"},
      {"huge count", head + "$Nodes\n999999999999\n1 0 0 0\n$EndNodes\n", "announced"},
      {"count beyond 64 bits", head + "$Nodes\n99999999999999999999\n", "not a whole number"},
      {"negative count", head + "$Nodes\n-4\n$EndNodes\n", "-4 nodes"},
      {"nan", head + "$Nodes\n1\n1 nan 0 0\n$EndNodes\n", "part.msh:6: \"nan\""},
      {"infinity", head + "$Nodes\n1\n1 0 inf 0\n$EndNodes\n", "\"inf\""},
      {"overflow", head + "$Nodes\n1\n1 0 1e999 0\n$EndNodes\n", "\"1e999\""},
      {"no number", head + "$Nodes\n1\n1 0 O.5 0\n$EndNodes\n", "\"O.5\""},
      {"node twice", head + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", "node 1 is given twice"},
      {"missing node", head + square + elements("1 3 2 0 1 1 2 3 44\n", 1), "node 44"},
      {"unknown type", head + square + elements("1 777 2 0 1 1 2 3 4\n", 1), "type 777"},
      {"linear triangles", head + square + elements("1 2 2 0 1 1 2 3\n", 1), "second order"},
      {"only lines", head + square + elements("1 1 2 0 1 1 2\n", 1), "no plane and no solid"},
      {"mixture", head + square + elements("1 3 2 0 1 1 2 3 4\n2 2 2 0 1 1 2 3\n", 2),
       "1 quad4, 1 tri3"},
      {"negative number of tags", head + square + elements("1 3 -2 0 1 1 2 3 4\n", 1), "heading"},
      {"name without quotes", head + "$PhysicalNames\n1\n2 1 top\n$EndPhysicalNames\n", "\"name\""},
      {"section never closed", head + "$Comments\nbla\n", "$EndComments"},
      {"4.1: wrong total", head_4 + "$Nodes\n1 5 1 5\n2 1 0 1\n1\n0 0 0\n$EndNodes\n", "5 nodes"},
      {"4.1: huge block", head_4 + "$Nodes\n1 1 1 1\n2 1 0 99999999999\n1\n", "announced"},
      {"4.1: wrong dimension",
       head_4 + "$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 0 0\n$EndNodes\n$Elements\n1 1 1 1\n3 1 3 1\n1 1 1 "
                "1 1\n",
       "dimension 3"},
      {"4.1: entities cut", head_4 + "$Entities\n0 0 1 0\n1 0 0 0\n$EndEntities\n", "$EndEntities"},
  };
}

TEST(GmshReader, broken_files_are_refused_with_place_and_reason) {
  for (const Broken& broken : broken_files()) {
    const std::string text = complaint(broken.content);
    EXPECT_NE(text.find(broken.expected), std::string::npos) << broken.what << ": " << text;
  }
}

} // namespace
} // namespace billet::io::gmsh_reader_test
