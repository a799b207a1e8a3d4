// Abaqus and CalculiX input files: *NODE, *ELEMENT, *NSET, *ELSET, *INCLUDE. What else stands in
// them (loads, materials, steps) is passed over; keywords that would make or move nodes are
// refused.

#include "geometry/base/error.h"
#include "io/mesh/included_lines.h"
#include "io/mesh/raw_mesh.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace billet::io {

namespace {

using mechanics::ElementKind;
using mechanics::Index;

/// The first comma that is not between quotes.
std::size_t first_comma(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    quoted = quoted != (text[i] == '"');
    if (text[i] == ',' && !quoted)
      return i;
  }
  return std::string_view::npos;
}

std::string_view unquoted(std::string_view text) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
    return text.substr(1, text.size() - 2);
  return text;
}

/// Parts between commas, without blanks at their ends; a comma at the end opens no new part.
std::vector<std::string_view> comma_parts(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t comma = first_comma(text);
    parts.push_back(trimmed(text.substr(0, comma)));
    text = comma == std::string_view::npos ? std::string_view() : trimmed(text.substr(comma + 1));
  }
  return parts;
}

/// A family of element names: letters, number of nodes, then letters for its formulation.
struct Family {
  const char* prefix;
  int dimension; ///< of the cell, not of the space
  bool solid;
};

/// Longest prefixes first.
constexpr std::array families{
    Family{"SFM3D", 2, false}, Family{"STRI", 2, false}, Family{"C3D", 3, true},
    Family{"CPE", 2, true},    Family{"CPS", 2, true},   Family{"CAX", 2, true},
    Family{"M3D", 2, false},   Family{"R3D", 2, false},  Family{"T2D", 1, false},
    Family{"T3D", 1, false},   Family{"S", 2, false},
};

struct AbaqusType {
  int dimension = 0;
  int n_nodes = 0;
  std::optional<ElementKind> kind;
};

std::optional<ElementKind> solid_kind(int dimension, std::int64_t n_nodes) {
  constexpr std::array solids{ElementKind::quad4, ElementKind::quad8, ElementKind::tri6,
                              ElementKind::hex8,  ElementKind::hex20, ElementKind::tet10};
  for (const ElementKind kind : solids)
    if (mechanics::dimension(kind) == dimension && mechanics::nodes_per_element(kind) == n_nodes)
      return kind;
  return {};
}

/// The type of a name such as C3D20R; no nodes: not known.
AbaqusType abaqus_type(const std::string& name) {
  for (const Family& family : families) {
    if (!name.starts_with(family.prefix))
      continue;
    const std::size_t digits = std::string_view(family.prefix).size();
    const std::size_t end = std::min(name.find_first_not_of("0123456789", digits), name.size());
    const bool letters_only =
        std::all_of(name.begin() + static_cast<std::ptrdiff_t>(end), name.end(),
                    [](unsigned char c) { return std::isalpha(c) != 0; });
    std::int64_t n = 0;
    if (!letters_only || !parse_integer(std::string_view(name).substr(digits, end - digits), n) ||
        n < 1 || n > 27)
      return {};
    return {family.dimension, static_cast<int>(n),
            family.solid ? solid_kind(family.dimension, n) : std::nullopt};
  }
  return {};
}

/// What may come with a body and is no part of it: springs, masses, couplings, beams, users' own.
bool is_no_body(std::string_view type) {
  constexpr std::array<std::string_view, 13> beginnings{
      "SPRING", "DASHPOT", "MASS", "ROTARYI", "GAP", "DCOUP", "CONN",
      "PIPE",   "B21",     "B22",  "B3",      "ITT", "U"};
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view beginning) { return type.starts_with(beginning); });
}

/// Numbers of nodes or elements under a name.
struct NamedSet {
  std::string name;  ///< as first written
  std::string place; ///< of its first members
  std::vector<std::int64_t> members;
};
using Sets = std::map<std::string, NamedSet>; ///< by name in capitals

/// A keyword line with its parameters.
struct Keyword {
  std::string name;                              ///< in capitals, without the star
  std::map<std::string, std::string> parameters; ///< names in capitals

  [[nodiscard]] std::string value(const char* key) const {
    const auto found = parameters.find(key);
    return found == parameters.end() ? std::string() : found->second;
  }
};

class AbaqusReader {
public:
  AbaqusReader(const std::filesystem::path& path, const IncludeBounds& bounds)
      : lines_(path, bounds) {}

  RawMesh read() {
    bool more = next_line();
    while (more) {
      if (line().front() != '*')
        lines_.fail("a keyword such as *NODE is expected before the first data");
      const Keyword keyword = read_keyword();
      more = read_data(keyword);
    }
    if (mesh_.points.empty())
      lines_.fail("the file has no *NODE", "is it an input file of Abaqus or CalculiX?");
    resolve_sets();
    return std::move(mesh_);
  }

private:
  [[nodiscard]] std::string_view line() const { return lines_.line(); }

  /// Moves to the next line that is not blank or a comment.
  bool next_meaningful() {
    while (lines_.next())
      if (!line().empty() && !line().starts_with("**"))
        return true;
    return false;
  }

  /// The same, where *INCLUDE is replaced by what it includes.
  bool next_line() {
    while (next_meaningful()) {
      if (line().front() != '*')
        return true;
      const std::string_view text = line().substr(1);
      if (in_capitals(trimmed(text.substr(0, text.find(',')))) != "INCLUDE")
        return true;
      const Keyword keyword = read_keyword();
      if (keyword.parameters.contains("PASSWORD"))
        lines_.fail("an encrypted file is to be included");
      lines_.include(keyword.value("INPUT"));
    }
    return false;
  }

  Keyword read_keyword() {
    std::string text(line().substr(1));
    while (text.ends_with(',') && next_meaningful())
      text += line();
    Keyword keyword;
    for (const std::string_view part : comma_parts(text)) {
      const std::size_t equals = part.find('=');
      const std::string key = in_capitals(trimmed(part.substr(0, equals)));
      if (keyword.name.empty())
        keyword.name = key;
      else
        keyword.parameters[key] = equals == std::string_view::npos
                                      ? ""
                                      : std::string(unquoted(trimmed(part.substr(equals + 1))));
    }
    return keyword;
  }

  void refuse_generators(const Keyword& keyword) const {
    if (keyword.name == "NODE" && !keyword.value("SYSTEM").empty() &&
        in_capitals(keyword.value("SYSTEM")) != "R")
      lines_.fail(fmt::format("*NODE with SYSTEM={} gives coordinates that are not rectangular",
                              keyword.value("SYSTEM").substr(0, 20)),
                  "write all nodes with x, y, z");
    constexpr std::array makers{"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"};
    if (std::find(makers.begin(), makers.end(), keyword.name) != makers.end())
      lines_.fail(
          fmt::format("*{} makes or moves nodes or elements, which is not done here", keyword.name),
          "write all nodes and elements out");
  }

  /// Reads the lines that belong to a keyword; false at the end of the file.
  bool read_data(const Keyword& keyword) {
    refuse_generators(keyword);
    constexpr std::array ties{"TIE", "EQUATION", "MPC"};
    if (std::find(ties.begin(), ties.end(), keyword.name) != ties.end() &&
        ++n_ties_[keyword.name] == 1)
      mesh_.notes.push_back(fmt::format(
          "warning: [passed-over] {}: *{} is passed over: what it joins is not joined here",
          lines_.place_in_note(), keyword.name));
    using Action = void (AbaqusReader::*)(const Keyword&);
    Action action = &AbaqusReader::ignore_line;
    if (keyword.name == "NODE")
      action = &AbaqusReader::read_node;
    else if (keyword.name == "ELEMENT")
      start_elements(keyword), action = &AbaqusReader::read_element;
    else if (keyword.name == "NSET" || keyword.name == "ELSET")
      action = &AbaqusReader::read_set_line;
    else if (keyword.name == "INSTANCE")
      action = &AbaqusReader::refuse_placed_instance;
    const bool is_mesh = keyword.name == "NODE" || keyword.name == "ELEMENT";
    if (is_mesh && keyword.parameters.contains("INPUT"))
      lines_.include(keyword.value("INPUT"));
    while (next_line()) {
      if (line().front() == '*') {
        finish_element();
        return true;
      }
      (this->*action)(keyword);
    }
    finish_element();
    return false;
  }

  void ignore_line(const Keyword&) {}

  void refuse_placed_instance(const Keyword&) {
    lines_.fail("an *INSTANCE that is moved or turned is not read",
                "write the mesh in its final place, without parts and instances");
  }

  std::int64_t number(std::string_view text) const {
    std::int64_t value = 0;
    if (!parse_integer(text, value))
      lines_.fail(fmt::format("\"{}\" is not a whole number", text.substr(0, 30)));
    return value;
  }

  NamedSet& named(Sets& sets, const std::string& name) const {
    NamedSet& set = sets[in_capitals(name)];
    if (set.name.empty()) {
      set.name = name;
      set.place = lines_.place();
    }
    return set;
  }

  // --- nodes and elements ----------------------------------------------------------------------

  void read_node(const Keyword& keyword) {
    const std::vector<std::string_view> parts = comma_parts(line());
    if (parts.size() < 3)
      lines_.fail("a node is written: number, x, y[, z]");
    const std::int64_t node = number(parts[0]);
    if (!numbers_.add(node))
      lines_.fail(fmt::format("node {} is given twice", node),
                  "give every node a number of its own; files with several parts are not read");
    Vec3 point = Vec3::Zero();
    for (std::size_t i = 1; i < std::min<std::size_t>(parts.size(), 4); ++i)
      if (!parts[i].empty() && !parse_real(parts[i], point[static_cast<Eigen::Index>(i) - 1]))
        lines_.fail(fmt::format("\"{}\" is not a finite number", parts[i].substr(0, 30)));
    mesh_.points.push_back(point);
    mesh_.labels.push_back(node);
    if (const std::string set = keyword.value("NSET"); !set.empty())
      named(node_sets_, set).members.push_back(node);
  }

  void start_elements(const Keyword& keyword) {
    type_name_ = in_capitals(keyword.value("TYPE"));
    type_ = abaqus_type(type_name_);
    if (type_name_ == "B31" || type_name_ == "B21")
      type_ = {1, 2, {}};
    if (passes_over() && ++n_passed_over_[type_name_] == 1)
      mesh_.notes.push_back(
          fmt::format("warning: [passed-over] {}: elements of type {} are passed over",
                      lines_.place_in_note(), type_name_.substr(0, 20)));
    else if (type_.n_nodes == 0 && !passes_over())
      lines_.fail(fmt::format("elements of type \"{}\" are not known", type_name_.substr(0, 20)),
                  "known are CPE4, CPE8, CPE6, CAX4, CAX8, CAX6, C3D8, C3D20, C3D10 and their "
                  "variants");
  }

  [[nodiscard]] bool passes_over() const { return type_.n_nodes == 0 && is_no_body(type_name_); }

  /// An element may go on over several lines, until it has all its nodes.
  void read_element(const Keyword& keyword) {
    if (passes_over()) {
      elements_.try_emplace(number(comma_parts(line()).front())); // sets may name it
      return;
    }
    const bool begins = pending_.empty();
    for (const std::string_view part : comma_parts(line()))
      pending_.push_back(number(part));
    const auto whole = static_cast<std::size_t>(type_.n_nodes) + 1;
    if (pending_.size() > whole)
      lines_.fail(fmt::format("element {} of type {} has more than {} nodes", pending_[0],
                              type_name_, type_.n_nodes));
    if (pending_.size() < whole) {
      if (begins)
        pending_place_ = lines_.place();
      return;
    }
    store_element();
    if (const std::string set = keyword.value("ELSET"); !set.empty())
      named(element_sets_, set).members.push_back(pending_[0]);
    pending_.clear();
  }

  void store_element() {
    CellBlock& block =
        mesh_.blocks[type_.kind ? std::string(mechanics::name(*type_.kind)) : type_name_];
    block.dimension = type_.dimension;
    block.kind = type_.kind;
    if (type_.kind)
      mesh_.type = type_name_;
    ++block.count;
    std::vector<Index>& nodes = elements_[pending_[0]];
    if (!nodes.empty())
      lines_.fail(fmt::format("element {} is given twice", pending_[0]),
                  "files with several parts are not read");
    for (std::size_t i = 1; i < pending_.size(); ++i) {
      const Index node = numbers_.find(pending_[i]);
      if (node < 0)
        lines_.fail(fmt::format("element {} has node {}, which is not given before it", pending_[0],
                                pending_[i]));
      nodes.push_back(node);
    }
    if (!type_.kind)
      return;
    block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
    block.labels.push_back(pending_[0]);
  }

  void finish_element() {
    if (!pending_.empty())
      throw Error(Fault::geometry, pending_place_,
                  fmt::format("element {} of type {} has only {} of its {} nodes", pending_[0],
                              type_name_, pending_.size() - 1, type_.n_nodes),
                  "", error_code::mesh_file);
  }

  // --- sets ------------------------------------------------------------------------------------

  void read_set_line(const Keyword& keyword) {
    const bool of_nodes = keyword.name == "NSET";
    const std::string name = keyword.value(of_nodes ? "NSET" : "ELSET");
    if (name.empty())
      lines_.fail(fmt::format("*{} has no name", keyword.name),
                  fmt::format("write *{0}, {0}=NAME", keyword.name));
    Sets& sets = of_nodes ? node_sets_ : element_sets_;
    const std::vector<std::string_view> parts = comma_parts(line());
    if (keyword.parameters.contains("GENERATE"))
      return generate(parts, named(sets, name));
    for (const std::string_view part : parts) {
      std::int64_t member = 0;
      if (parse_integer(part, member)) {
        named(sets, name).members.push_back(member);
        continue;
      }
      const auto other = sets.find(in_capitals(unquoted(part)));
      if (other == sets.end())
        lines_.fail(fmt::format("\"{}\" is neither a number nor the name of a set given before",
                                part.substr(0, 40)));
      const std::vector<std::int64_t> members = other->second.members;
      require_budget(members.size());
      NamedSet& set = named(sets, name);
      set.members.insert(set.members.end(), members.begin(), members.end());
    }
  }

  /// Sets made of ranges and of other sets grow faster than the file: a few lines could fill the
  /// memory.
  void require_budget(std::size_t n) {
    constexpr std::size_t most = 50'000'000;
    n_expanded_ += n;
    if (n_expanded_ > most)
      lines_.fail(fmt::format("the sets have more than {} members together", most));
  }

  void generate(const std::vector<std::string_view>& parts, NamedSet& set) {
    if (parts.size() < 2 || parts.size() > 3)
      lines_.fail("GENERATE is followed by: first, last[, step]");
    const std::int64_t first = number(parts[0]);
    const std::int64_t last = number(parts[1]);
    const std::int64_t step = parts.size() == 3 ? number(parts[2]) : 1;
    if (first < 0 || last < first || step < 1)
      lines_.fail(fmt::format("a set from {} to {} in steps of {} cannot be", first, last, step));
    const std::size_t most = std::max(mesh_.points.size(), elements_.size());
    if (static_cast<std::uint64_t>((last - first) / step) >= most)
      lines_.fail(fmt::format("a set from {} to {} has more members than the mesh", first, last));
    require_budget(static_cast<std::size_t>((last - first) / step) + 1);
    for (std::int64_t member = first;; member += step) {
      set.members.push_back(member);
      if (last - member < step)
        break;
    }
  }

  /// Turns numbers into nodes; a set of elements stands for their nodes.
  void resolve_sets() {
    for (const auto& [key, set] : node_sets_) {
      std::vector<Index>& nodes = mesh_.node_sets[set.name];
      for (const std::int64_t member : set.members) {
        const Index node = numbers_.find(member);
        if (node < 0)
          throw Error(Fault::geometry, set.place,
                      fmt::format("the set {} has node {}, which is not given", set.name, member),
                      "", error_code::mesh_file);
        nodes.push_back(node);
      }
    }
    for (const auto& [key, set] : element_sets_) {
      if (node_sets_.contains(key)) {
        mesh_.notes.push_back(fmt::format(
            "the set of elements {0} was left out: there is a set of nodes {0}", set.name));
        continue;
      }
      std::vector<Index>& nodes = mesh_.node_sets[set.name];
      for (const std::int64_t member : set.members) {
        const auto element = elements_.find(member);
        if (element == elements_.end())
          throw Error(
              Fault::geometry, set.place,
              fmt::format("the set {} has element {}, which is not given", set.name, member), "",
              error_code::mesh_file);
        nodes.insert(nodes.end(), element->second.begin(), element->second.end());
      }
    }
  }

  IncludedLines lines_;
  RawMesh mesh_;
  NodeNumbers numbers_;
  std::unordered_map<std::int64_t, std::vector<Index>> elements_;
  Sets node_sets_;
  Sets element_sets_;
  std::size_t n_expanded_ = 0;
  std::string type_name_;
  AbaqusType type_;
  std::vector<std::int64_t> pending_;        ///< number and nodes of the element being read
  std::string pending_place_;                ///< of its number
  std::map<std::string, int> n_ties_;        ///< keywords that join, by name
  std::map<std::string, int> n_passed_over_; ///< keywords of elements that are, by type
};

} // namespace

RawMesh read_abaqus(const std::filesystem::path& path, const IncludeBounds& bounds) {
  return AbaqusReader(path, bounds).read();
}

} // namespace billet::io
