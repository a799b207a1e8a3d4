#include "study/setters.h"

#include "geometry/base/error.h"
#include "io/case/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "study/file_text.h"

namespace billet::study {

namespace {

using Path = std::vector<std::string>;

std::optional<io::Node> document_of(const std::filesystem::path& case_file) {
  try {
    return io::parse_document(text_of_file(case_file), case_file.string());
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Parts of a key; those that name items of the document's lists are indices.
Path path_of(const std::string& key, const io::Node* document) {
  Path path = io::key_parts(key).value_or(Path{key});
  const io::Node* node = document;
  for (std::string& part : path) {
    if (node == nullptr)
      break;
    if (const auto* const list = node->as<io::List>()) {
      const std::optional<std::size_t> index = io::index_of_item(*list, part);
      node = index ? &(*list)[*index] : nullptr;
      if (index)
        part = std::to_string(*index);
    } else {
      const auto* const table = node->as<io::Table>();
      node = table != nullptr ? table->find(part) : nullptr;
    }
  }
  return path;
}

bool holds(const Path& table, const Path& key) {
  return table.size() <= key.size() && std::equal(table.begin(), table.end(), key.begin());
}

} // namespace

std::vector<std::string> keys_of(const std::vector<Level>& levels) {
  std::set<std::string> keys;
  for (const Level& level : levels)
    for (const Assignment& assignment : level.set)
      keys.insert(assignment.key);
  return {keys.begin(), keys.end()};
}

void refuse_overruled(const io::At& root,
                      const std::filesystem::path& case_file,
                      const std::vector<Setter>& setters) {
  const std::optional<io::Node> document = document_of(case_file);
  const io::Node* const known = document ? &*document : nullptr;
  for (std::size_t second = 1; second < setters.size(); ++second)
    for (const std::string& key : setters[second].keys)
      for (std::size_t first = 0; first < second; ++first)
        for (const std::string& before : setters[first].keys)
          if (holds(path_of(key, known), path_of(before, known)))
            root.complain(fmt::format("{} sets {}, and {} sets {}", setters[first].what, before,
                                      setters[second].what, key),
                          "only the last of them would count");
}

} // namespace billet::study
