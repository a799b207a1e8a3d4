#include "io/case/read_case.h"

#include "io/case/read_parts.h"
#include "io/case/setting_words.h"
#include "io/case/values.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>
#include <system_error>

namespace billet::io {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t longest_file = std::uintmax_t{16} << 20U; // 16 MiB

std::optional<UnitSystem> as_unit_system(const At& at) {
  std::vector<std::string> names;
  for (const UnitSystem& system : unit_systems())
    names.push_back(system.name);
  const std::optional<std::size_t> index = as_word_index(at, names);
  return index ? std::optional(unit_systems()[*index]) : std::nullopt;
}

/// The items of a list of tables, each read by `parse`; the path names an item by its name.
template <class Item>
std::vector<Item>
read_items(TableReader& root, std::string_view key, std::optional<Item> (*parse)(const At&)) {
  std::vector<Item> items;
  const std::optional<At> at = root.find(key);
  if (!at)
    return items;
  const List* const list = at->list();
  if (list == nullptr) {
    at->complain_found(fmt::format("a list of tables, each under [[{}]]", key));
    return items;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Node& node = (*list)[i];
    const std::string path = fmt::format("{}.{}", key, item_name(node, i));
    if (std::optional<Item> item = read_value_of(At{node, path, at->context}, parse))
      items.push_back(std::move(*item));
  }
  return items;
}

void read_materials(TableReader& root, Case& content) {
  std::optional<TableReader> materials = root.require_table("material");
  if (!materials)
    return;
  for (const auto& [name, at] : materials->named_items()) {
    const Node name_node{at.node.place, name};
    (void)as_name({name_node, at.path, at.context});
    if (std::optional<Material> material = read_value_of(at, as_material))
      content.materials.emplace(name, std::move(*material));
    else
      content.materials.emplace(name, Material{}); // for the names: complained about already
  }
}

/// A new mesh would keep what the mode that mixed faces hold softly has made of the boundary.
ContactForm default_form(const Case& content) {
  return content.remesh ? ContactForm::compatible : ContactForm::mixed;
}

Case read_root(TableReader& root) {
  Case content;
  ReadContext& context = root.context();
  root.optional("units", context.units, as_unit_system);
  content.units = context.units;
  root.required("analysis", context.analysis, [](const At& at) { return as_choice(at, analyses); });
  content.analysis = context.analysis.value_or(Analysis::plane_strain);
  root.optional("title", content.title, as_text);
  root.optional("temperature", content.temperature, as_number,
                Number{quantity::temperature, above_absolute_zero});
  root.required("workpiece", content.workpiece, as_workpiece);
  read_materials(root, content);
  content.supports = read_items<Support>(root, "support", as_support);
  content.loads = read_items<Load>(root, "load", as_load);
  content.tools = read_items<Tool>(root, "tool", as_tool);
  root.optional("contact", content.contact, as_contact);
  root.optional("time", content.time, as_time);
  content.stages = read_items<Stage>(root, "stage", as_stage);
  root.optional("solver", content.solver, as_solver);
  root.optional("remesh", content.remesh, as_remesh);
  content.measures = read_items<Measure>(root, "measure", as_measure);
  root.optional("stop", content.stop, as_stop);
  root.optional("output", content.output, as_output);
  root.finish();
  if (!content.contact.form)
    content.contact.form = default_form(content);
  return content;
}

} // namespace

std::string case_file_text(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const std::string name = file.string();
  if (!fs::exists(status))
    throw Error(Fault::case_file, name, "there is no such file", "", error_code::file);
  if (fs::is_directory(status))
    throw Error(Fault::case_file, name, "this is a folder, not a case file",
                "name the case.toml in it", error_code::file);
  if (fs::is_regular_file(status) && fs::file_size(file, error) > longest_file)
    throw Error(Fault::case_file, name, "the file is larger than 16 MiB: this is no case file", "",
                error_code::file);
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (stream && text.size() <= longest_file) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad() || (stream.fail() && !stream.eof()))
    throw Error(Fault::case_file, name, "the file cannot be read", "look at its permissions",
                error_code::file);
  return text;
}

Shape case_shape() {
  Complaints complaints("");
  ReadContext context{complaints, unit_systems().front(), std::nullopt, {}, true};
  Inquiry inquiry;
  const Node node{TextPlace{}, &inquiry};
  (void)read_value_of(At{node, "", context}, [](const At& at) {
    TableReader root(at);
    (void)read_root(root);
    return true;
  });
  return without_labels(inquiry.take()); // the scenes' keys differ little: a schema has all of them
}

Case read_case_tree(const Node& tree,
                    Complaints& complaints,
                    const fs::path& directory,
                    const ReadOptions& options) {
  complaints.throw_if_any(); // an override that leads nowhere would raise follow-on complaints
  ReadContext context{complaints, unit_systems().front(), std::nullopt,
                      directory.empty() ? fs::path(".") : directory, options.allow_outside};
  TableReader root(At{tree, "", context});
  Case content = read_root(root);
  check_whole(root.at(), content);
  complaints.throw_if_any();
  return content;
}

Case read_case_text(const std::string& text,
                    const std::string& name,
                    const fs::path& directory,
                    const std::vector<std::string>& overrides,
                    const ReadOptions& options) {
  Complaints complaints(name);
  Node tree = parse_document(text, name);
  apply_overrides(tree, overrides, complaints);
  return read_case_tree(tree, complaints, directory, options);
}

Case read_case(const fs::path& file,
               const std::vector<std::string>& overrides,
               const ReadOptions& options) {
  return read_case_text(case_file_text(file), file.string(), file.parent_path(), overrides,
                        options);
}

} // namespace billet::io
