// What the readers of study and chart files share.

#pragma once

#include "io/case/table_reader.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/study.h"

namespace billet::study {

/// What a value is called in tables: text without its quotes.
[[nodiscard]] std::string label_of(const io::Node& node);

/// Key and value of every entry of a table.
[[nodiscard]] std::optional<std::vector<Assignment>> as_assignments(const io::At& at);

/// { label, set, size }.
[[nodiscard]] std::optional<Level> as_level(const io::At& at);

[[nodiscard]] std::optional<Engine> as_engine(const io::At& at);

/// Numbers as a list, or as { from, to, count, scale }; complains unless they increase.
[[nodiscard]] std::optional<std::vector<double>> as_steps(const io::At& at);

/// Title, case, settings of all runs and where they are made.
void read_common(io::TableReader& root, Study& study);

/// Complains of an expression that is wrong whatever names there will be: those are known only with
/// the results.
void check_expression(io::TableReader& table, const std::string& key, const std::string& text);

/// Reads a file: `read` gets its root, and complains there.
/// @throws Error (Fault::case_file) with all complaints
void read_file(const std::filesystem::path& file,
               const std::vector<std::string>& overrides,
               const std::function<void(io::TableReader& root)>& read);

/// What `read` asks for, as read_file calls it.
[[nodiscard]] io::Shape shape_of_file(const std::function<void(io::TableReader& root)>& read);

/// The items of a list of tables, each read by `parse`.
template <class Item, class Parse>
std::vector<Item> read_items(io::TableReader& root, const std::string& key, Parse parse) {
  std::vector<Item> items;
  const std::optional<io::At> at = root.find(key);
  const auto* const list = at ? at->list() : nullptr;
  if (at && list == nullptr)
    at->complain_found("a list of tables, each under [[" + key + "]]");
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
    if (std::optional<Item> item = io::read_value_of(
            io::At{(*list)[i], key + "." + io::item_name((*list)[i], i), at->context}, parse))
      items.push_back(std::move(*item));
  return items;
}

} // namespace billet::study
