// Gmsh's .msh, versions 2.2 and 4.1, text and binary: https://gmsh.info/doc/texinfo/gmsh.html,
// "MSH file format".

#include "io/mesh/raw_mesh.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

/// A type of cell by Gmsh's number.
struct GmshType {
  int number;
  const char* name;
  int dimension;
  int n_nodes;                     ///< in the file
  std::optional<ElementKind> kind; ///< takes the first nodes of the file's
};

constexpr std::array gmsh_types{
    GmshType{1, "line2", 1, 2, {}},
    GmshType{2, "tri3", 2, 3, {}},
    GmshType{3, "quad4", 2, 4, ElementKind::quad4},
    GmshType{4, "tet4", 3, 4, {}},
    GmshType{5, "hex8", 3, 8, ElementKind::hex8},
    GmshType{6, "prism6", 3, 6, {}},
    GmshType{7, "pyramid5", 3, 5, {}},
    GmshType{8, "line3", 1, 3, {}},
    GmshType{9, "tri6", 2, 6, ElementKind::tri6},
    GmshType{10, "quad9", 2, 9, ElementKind::quad8},
    GmshType{11, "tet10", 3, 10, ElementKind::tet10},
    GmshType{12, "hex27", 3, 27, ElementKind::hex20},
    GmshType{13, "prism18", 3, 18, {}},
    GmshType{14, "pyramid14", 3, 14, {}},
    GmshType{15, "point", 0, 1, {}},
    GmshType{16, "quad8", 2, 8, ElementKind::quad8},
    GmshType{17, "hex20", 3, 20, ElementKind::hex20},
    GmshType{18, "prism15", 3, 15, {}},
    GmshType{19, "pyramid13", 3, 13, {}},
    GmshType{20, "tri9", 2, 9, {}},
    GmshType{21, "tri10", 2, 10, {}},
    GmshType{26, "line4", 1, 4, {}},
    GmshType{27, "line5", 1, 5, {}},
    GmshType{29, "tet20", 3, 20, {}},
    GmshType{36, "quad16", 2, 16, {}},
    GmshType{92, "hex64", 3, 64, {}},
};

/// Position in the file of each node in VTK's order, where they differ. Gmsh's hexahedron has its
/// edges in the order 01 03 04 12 15 23 26 37 45 47 56 67, its tetrahedron 01 12 02 03 23 13.
constexpr std::array<int, 20> hex20_order{0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                          13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
constexpr std::array<int, 10> tet10_order{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

int position_in_file(ElementKind kind, int node) {
  if (kind == ElementKind::hex20)
    return hex20_order[static_cast<std::size_t>(node)];
  if (kind == ElementKind::tet10)
    return tet10_order[static_cast<std::size_t>(node)];
  return node;
}

/// Reads one file section by section.
class GmshReader {
public:
  explicit GmshReader(const std::filesystem::path& path) : scanner_(path) {}

  RawMesh read() {
    read_format();
    while (true) {
      const std::string_view heading = scanner_.word();
      if (heading.empty())
        break;
      read_section(std::string(heading));
    }
    if (!have_nodes_ || !have_elements_)
      scanner_.fail(fmt::format("the file has no ${} section", have_nodes_ ? "Elements" : "Nodes"),
                    "the file may have been cut short");
    name_sets();
    return std::move(mesh_);
  }

private:
  using Group = std::pair<int, std::int64_t>; ///< dimension and number

  // --- numbers, in text or bytes ---------------------------------------------------------------

  std::int64_t small_number() {
    return binary_ ? scanner_.raw<std::int32_t>(swapped_) : scanner_.integer();
  }
  /// What Gmsh 4 calls size_t.
  std::int64_t large_number() {
    return binary_ ? scanner_.raw<std::int64_t>(swapped_) : scanner_.integer();
  }
  double coordinate() {
    const double value = binary_ ? scanner_.raw<double>(swapped_) : scanner_.real();
    if (!std::isfinite(value))
      scanner_.fail("a coordinate is not a finite number");
    return value;
  }
  std::int64_t large_count(const char* what, std::size_t least_bytes) {
    const std::int64_t n = large_number();
    if (n < 0)
      scanner_.fail(fmt::format("{} {} are announced", n, what));
    scanner_.require_room(static_cast<std::uint64_t>(n), what, least_bytes);
    return n;
  }

  void read_format() {
    if (scanner_.word() != "$MeshFormat")
      scanner_.fail("a Gmsh file begins with $MeshFormat",
                    "is it a .msh of Gmsh, version 2.2 or 4.1?");
    const std::string version(scanner_.word());
    if (version != "2.2" && version != "4.1")
      scanner_.fail(
          fmt::format("version \"{}\" of Gmsh's format is not read", version.substr(0, 20)),
          "save the mesh in version 4.1 or 2.2 (gmsh -format msh41)");
    new_format_ = version == "4.1";
    const std::int64_t binary = scanner_.integer();
    const std::int64_t size = scanner_.integer();
    if ((binary != 0 && binary != 1) || size != 8)
      scanner_.fail(
          fmt::format("file type {} with numbers of {} bytes is not known", binary, size));
    binary_ = binary == 1;
    scanner_.line();
    if (binary_)
      read_byte_order();
    expect("$EndMeshFormat");
  }

  void read_byte_order() {
    const auto one = scanner_.raw<std::int32_t>(false);
    constexpr std::int32_t one_swapped = 0x01000000;
    if (one != 1 && one != one_swapped)
      scanner_.fail("the mark of the byte order is missing");
    swapped_ = one == one_swapped;
  }

  void expect(const std::string& heading) {
    if (scanner_.word() != heading)
      scanner_.fail(fmt::format("{} is expected here", heading),
                    "a count above may be wrong, or the file cut short");
    scanner_.line();
  }

  void read_section(const std::string& heading) {
    if (!heading.starts_with('$') || heading.starts_with("$End"))
      scanner_.fail(fmt::format("a section such as $Nodes is expected, not \"{}\"",
                                trimmed(heading).substr(0, 20)));
    scanner_.line();
    if (heading == "$ParametricNodes")
      scanner_.fail("nodes with parameters are not read in version 2.2",
                    "set Mesh.SaveParametric = 0 in Gmsh, or save in version 4.1");
    if (heading == "$PhysicalNames")
      read_physical_names();
    else if (heading == "$Entities")
      read_entities();
    else if (heading == "$Nodes")
      new_format_ ? read_nodes_4() : read_nodes_2();
    else if (heading == "$Elements")
      new_format_ ? read_elements_4() : read_elements_2();
    else
      return skip_section("$End" + heading.substr(1));
    expect("$End" + heading.substr(1));
  }

  void skip_section(const std::string& end) {
    while (!scanner_.at_end())
      if (scanner_.line() == end)
        return;
    scanner_.fail(fmt::format("{} is missing", end), "the file may have been cut short");
  }

  void read_physical_names() {
    for (std::size_t n = scanner_.count("names", 6); n > 0; --n) {
      const std::int64_t dimension = scanner_.integer();
      const std::int64_t number = scanner_.integer();
      const std::string_view quoted = scanner_.line();
      if (dimension < 0 || dimension > 3 || quoted.size() < 3 || quoted.front() != '"' ||
          quoted.back() != '"')
        scanner_.fail("a name is written: dimension number \"name\"");
      names_[{static_cast<int>(dimension), number}] = quoted.substr(1, quoted.size() - 2);
    }
  }

  void read_entities() {
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& n : counts)
      n = large_count("entities", 8);
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i)
        read_entity(dimension);
  }

  void read_entity(int dimension) {
    const std::int64_t number = small_number();
    for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i)
      binary_ ? scanner_.raw<double>(swapped_) : scanner_.real(); // the box is of no use here
    for (std::int64_t n = large_count("groups", 2); n > 0; --n)
      entity_groups_[{dimension, number}].push_back(std::abs(small_number()));
    if (dimension > 0)
      for (std::int64_t n = large_count("bounding entities", 2); n > 0; --n)
        small_number();
  }

  // --- nodes -----------------------------------------------------------------------------------

  void add_number(std::int64_t number) {
    if (!numbers_.add(number))
      scanner_.fail(fmt::format("node {} is given twice", number));
    mesh_.labels.push_back(number);
  }

  Vec3 place() {
    const double x = coordinate();
    const double y = coordinate();
    const double z = coordinate();
    return {x, y, z};
  }

  void read_nodes_2() {
    have_nodes_ = true;
    const std::size_t n = scanner_.count("nodes", 8);
    if (binary_)
      scanner_.line();
    for (std::size_t i = 0; i < n; ++i) {
      add_number(small_number());
      mesh_.points.push_back(place());
    }
  }

  void read_nodes_4() {
    have_nodes_ = true;
    const std::int64_t n_blocks = large_count("blocks of nodes", 8);
    const std::int64_t n_nodes = large_count("nodes", 8);
    large_number();
    large_number();
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const std::int64_t dimension = small_number();
      small_number();
      const bool parametric = small_number() != 0;
      const std::int64_t n = large_count("nodes", 8);
      for (std::int64_t i = 0; i < n; ++i)
        add_number(large_number());
      for (std::int64_t i = 0; i < n; ++i) {
        mesh_.points.push_back(place());
        for (std::int64_t u = 0; parametric && u < std::min<std::int64_t>(dimension, 3); ++u)
          coordinate();
      }
    }
    if (n_nodes != static_cast<std::int64_t>(mesh_.points.size()))
      scanner_.fail(
          fmt::format("{} nodes are announced, {} are given", n_nodes, mesh_.points.size()));
  }

  // --- elements --------------------------------------------------------------------------------

  const GmshType& type(std::int64_t number) const {
    for (const GmshType& known : gmsh_types)
      if (known.number == number)
        return known;
    scanner_.fail(fmt::format("elements of Gmsh's type {} are not known", number),
                  "known are quad4, quad8, tri6, hex8, hex20, tet10");
  }

  /// Reads the nodes of one cell, stores it and enters its nodes in its groups.
  void
  read_cell(const GmshType& type, std::int64_t label, const std::vector<std::int64_t>& groups) {
    std::array<Index, 64> nodes{};
    for (int i = 0; i < type.n_nodes; ++i) {
      const std::int64_t number = new_format_ ? large_number() : small_number();
      const Index node = numbers_.find(number);
      if (node < 0)
        scanner_.fail(fmt::format("an element has node {}, which is not given", number));
      nodes[static_cast<std::size_t>(i)] = node;
    }
    CellBlock& block =
        mesh_.blocks[type.kind ? std::string(mechanics::name(*type.kind)) : type.name];
    block.dimension = type.dimension;
    block.kind = type.kind;
    ++block.count;
    if (type.kind)
      block.labels.push_back(label);
    if (type.kind)
      for (int i = 0; i < mechanics::nodes_per_element(*type.kind); ++i)
        block.nodes.push_back(nodes[static_cast<std::size_t>(position_in_file(*type.kind, i))]);
    for (const std::int64_t group : groups) {
      std::vector<Index>& set = groups_[{type.dimension, group}];
      set.insert(set.end(), nodes.begin(), nodes.begin() + type.n_nodes);
    }
    if (type.number == 10 || type.number == 12)
      ++n_centres_;
  }

  void read_elements_2() {
    have_elements_ = true;
    const std::size_t n = scanner_.count("elements", 6);
    if (binary_)
      scanner_.line();
    for (std::size_t i = 0; i < n;) {
      // In text each element has its own heading and number before it; in bytes a block has.
      const std::int64_t own_label = binary_ ? 0 : small_number();
      const GmshType& cell_type = type(small_number());
      const std::int64_t in_block = binary_ ? small_number() : 1;
      const std::int64_t n_tags = small_number();
      if (in_block < 1 || n_tags < 0 || static_cast<std::uint64_t>(in_block) > n - i)
        scanner_.fail("the heading of a block of elements is wrong");
      scanner_.require_room(static_cast<std::uint64_t>(n_tags), "tags", 2);
      for (std::int64_t k = 0; k < in_block; ++k, ++i) {
        const std::int64_t label = binary_ ? small_number() : own_label;
        read_cell(cell_type, label, read_tags(n_tags));
      }
    }
  }

  /// The first tag of an element of version 2.2 is its physical group; 0: none.
  std::vector<std::int64_t> read_tags(std::int64_t n) {
    std::vector<std::int64_t> groups;
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t tag = small_number();
      if (i == 0 && tag != 0)
        groups.push_back(std::abs(tag));
    }
    return groups;
  }

  void read_elements_4() {
    have_elements_ = true;
    const std::int64_t n_blocks = large_count("blocks of elements", 8);
    const std::int64_t n_elements = large_count("elements", 4);
    large_number();
    large_number();
    std::int64_t n_read = 0;
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const std::int64_t dimension = small_number();
      const std::int64_t entity = small_number();
      const GmshType& cell_type = type(small_number());
      const std::int64_t n = large_count("elements", 4);
      if (dimension != cell_type.dimension)
        scanner_.fail(fmt::format("elements of type {} on an entity of dimension {}",
                                  cell_type.name, dimension));
      const std::vector<std::int64_t>& groups = entity_groups_[{cell_type.dimension, entity}];
      for (std::int64_t i = 0; i < n; ++i, ++n_read) {
        const std::int64_t label = large_number();
        read_cell(cell_type, label, groups);
      }
    }
    if (n_read != n_elements)
      scanner_.fail(fmt::format("{} elements are announced, {} are given", n_elements, n_read));
  }

  /// Gives the groups their names; those without one are called curve-1, surface-1, ...
  void name_sets() {
    constexpr std::array sorts{"point", "curve", "surface", "volume"};
    for (auto& [group, nodes] : groups_) {
      const auto named = names_.find(group);
      const std::string name =
          named != names_.end()
              ? named->second
              : fmt::format("{}-{}", sorts[static_cast<std::size_t>(group.first)], group.second);
      std::vector<Index>& set = mesh_.node_sets[name];
      set.insert(set.end(), nodes.begin(), nodes.end());
    }
    if (n_centres_ > 0)
      mesh_.notes.push_back(fmt::format("{} elements with 9 or 27 nodes were read with 8 or 20: "
                                        "nodes within faces and cells were "
                                        "left out",
                                        n_centres_));
  }

  Scanner scanner_;
  bool new_format_ = false;
  bool binary_ = false;
  bool swapped_ = false;
  bool have_nodes_ = false;
  bool have_elements_ = false;
  RawMesh mesh_;
  NodeNumbers numbers_;
  std::map<Group, std::string> names_;
  std::map<Group, std::vector<std::int64_t>> entity_groups_;
  std::map<Group, std::vector<Index>> groups_;
  std::size_t n_centres_ = 0;
};

} // namespace

RawMesh read_gmsh(const std::filesystem::path& path) { return GmshReader(path).read(); }

} // namespace billet::io
