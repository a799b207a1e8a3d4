#include "io/case/document.h"
#include "io/case/read_case.h"
#include "io/compare/compare_parts.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>

namespace billet::io {

namespace {

using Values = std::map<std::string, Node>;

/// Every value of a tree by its path.
void values_of(const Node& node, const std::string& path, Values& into) {
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (const auto* const table = node.as<Table>())
    for (const Entry& entry : table->entries)
      values_of(entry.node, below(entry.key), into);
  else if (const auto* const list = node.as<List>())
    for (std::size_t i = 0; i < list->size(); ++i)
      values_of((*list)[i], below(item_name((*list)[i], i)), into);
  else
    into.emplace(path, node);
}

std::optional<double> number_of(const Node& node) {
  if (const auto* const whole = node.as<std::int64_t>())
    return static_cast<double>(*whole);
  const auto* const real = node.as<double>();
  return real != nullptr ? std::optional(*real) : std::nullopt;
}

Difference difference_of_values(const std::string& path, const Node& a, const Node& b) {
  const std::optional<double> first = number_of(a), second = number_of(b);
  if (!first || !second)
    return text_difference(path, shown(a), shown(b));
  LargestDifference largest;
  largest.look_at(*first, *second, "");
  return largest.of(path);
}

Case case_in(const std::filesystem::path& file) {
  ReadOptions options;
  options.allow_outside = true; // what lies there is compared, and not used
  return read_case(file, {}, options);
}

Values values_of_case(const Case& content, const std::filesystem::path& file) {
  Values values;
  values_of(parse_document(resolved_toml(content), file.string()), "", values);
  return values;
}

/// Files that a case names, by what they are for: "workpiece.mesh", "tool.die.surface".
using Files = std::map<std::string, std::filesystem::path>;

template <class Kind> std::optional<std::filesystem::path> path_of(const Kind& kind) {
  if constexpr (requires { kind.file.path; })
    return kind.file.path;
  else if constexpr (requires { kind.profile->path; })
    return kind.profile ? std::optional(kind.profile->path) : std::nullopt;
  else
    return std::nullopt;
}

Files files_of(const Case& content) {
  Files files;
  const auto add = [&](const std::string& what, const auto& source) {
    if (const auto path = std::visit([](const auto& kind) { return path_of(kind); }, source))
      files.emplace(what, *path);
  };
  add("workpiece.mesh", content.workpiece.mesh);
  for (const Tool& tool : content.tools)
    add("tool." + tool.name + ".surface", tool.surface);
  return files;
}

bool is_same_mesh(const std::filesystem::path& first, const std::filesystem::path& second) {
  const mechanics::Mesh a = read_mesh(first, 1.0, {.folder = {}, .anywhere = true}).mesh;
  const mechanics::Mesh b = read_mesh(second, 1.0, {.folder = {}, .anywhere = true}).mesh;
  return a.kind == b.kind && a.points == b.points && a.cells == b.cells &&
         a.node_sets == b.node_sets;
}

/// Two files byte by byte; meshes that may include others also as they are read.
Difference difference_of_files(const std::string& what,
                               const std::filesystem::path& first,
                               const std::filesystem::path& second) {
  const std::string quantity = "content of " + what;
  if (std::filesystem::equivalent(first, second))
    return text_difference(quantity, "", "");
  const std::string a = read_content(first), b = read_content(second);
  if (a == b) {
    const bool includes =
        what == "workpiece.mesh" && in_capitals(a).find("INPUT") != std::string::npos;
    Difference difference = text_difference(quantity, "", "");
    if (includes && !is_same_mesh(first, second)) {
      difference.absolute = infinity;
      difference.where = "what " + first.filename().string() + " includes";
    }
    return difference;
  }
  const auto end = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  Difference difference = text_difference(quantity, fmt::format("{} bytes", a.size()),
                                          fmt::format("{} bytes", b.size()));
  difference.where = fmt::format("{}, from line {}", first.filename().string(),
                                 1 + std::count(a.begin(), end, '\n'));
  difference.absolute = infinity; // also of the same size
  return difference;
}

/// Those that both name for the same; that one of them alone names one is a difference of values.
void compare_files(const Files& first, const Files& second, Comparison& into) {
  for (const auto& [what, path] : first)
    if (const auto other = second.find(what); other != second.end())
      into.quantities.push_back(difference_of_files(what, path, other->second));
}

} // namespace

Comparison compare_cases(const std::filesystem::path& first, const std::filesystem::path& second) {
  const Case a_case = case_in(first), b_case = case_in(second);
  const Values of_first = values_of_case(a_case, first), of_second = values_of_case(b_case, second);
  Values all = of_first;
  all.insert(of_second.begin(), of_second.end());
  Comparison comparison;
  for (const auto& [path, node] : all) {
    const auto a = of_first.find(path), b = of_second.find(path);
    comparison.quantities.push_back(
        a != of_first.end() && b != of_second.end()
            ? difference_of_values(path, a->second, b->second)
            : text_difference(path, a == of_first.end() ? "absent" : shown(node),
                              b == of_second.end() ? "absent" : shown(node)));
  }
  compare_files(files_of(a_case), files_of(b_case), comparison);
  return comparison;
}

} // namespace billet::io
