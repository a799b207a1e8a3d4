// What the case format knows and this version cannot do yet. To make a feature available, delete
// its line.

#include "io/case/read_parts.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

namespace billet::io {

namespace {

/// A key, or one value of a key. "*" stands for any name or index.
struct NotAvailable {
  std::string_view path;
  std::string_view value = {}; ///< empty: the key with any value
};

constexpr std::array features{
    NotAvailable{"solver.accuracy", "draft"},
    NotAvailable{"solver.accuracy", "fine"},
};

bool has_value(const Node& node, std::string_view value) {
  if (const auto* const text = node.as<std::string>())
    return *text == value;
  return node.as<bool>() != nullptr && shown(node) == value;
}

/// Follows the rest of a feature's path from a node, and complains where it leads to.
void refuse(const Node& node,
            const std::string& path,
            std::string_view rest,
            const NotAvailable& feature,
            Complaints& complaints) {
  if (rest.empty()) {
    if (feature.value.empty())
      complaints.add(node.place, path + ": not available in this version");
    else if (has_value(node, feature.value))
      complaints.add(node.place,
                     fmt::format("{}: {} is not available in this version", path, shown(node)));
    return;
  }
  const std::string_view part = rest.substr(0, rest.find('.'));
  const std::string_view next = rest.substr(std::min(rest.size(), part.size() + 1));
  const std::string prefix = path.empty() ? "" : path + ".";
  if (const Table* const table = node.as<Table>()) {
    for (const Entry& entry : table->entries)
      if (part == "*" || part == entry.key)
        refuse(entry.node, prefix + printable(entry.key), next, feature, complaints);
  } else if (const List* const list = node.as<List>(); list != nullptr && part == "*") {
    for (std::size_t i = 0; i < list->size(); ++i)
      refuse((*list)[i], prefix + item_name((*list)[i], i), next, feature, complaints);
  }
}

} // namespace

void refuse_not_available(const Node& root, Complaints& complaints) {
  for (const NotAvailable& feature : features)
    refuse(root, "", feature.path, feature, complaints);
}

} // namespace billet::io
