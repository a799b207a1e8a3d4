#include "io/case/document.h"
#include "io/case/read_case.h"
#include "io/compare/compare_parts.h"

#include <map>

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

Values values_of_case(const std::filesystem::path& file) {
  ReadOptions options;
  options.allow_outside = true; // nothing of them is read
  Values values;
  values_of(parse_document(resolved_toml(read_case(file, {}, options)), file.string()), "", values);
  return values;
}

} // namespace

Comparison compare_cases(const std::filesystem::path& first, const std::filesystem::path& second) {
  const Values of_first = values_of_case(first), of_second = values_of_case(second);
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
  return comparison;
}

} // namespace billet::io
