#include "billet/case.h"

#include "io/advice/scene_advice.h"
#include "io/case/read_case.h"
#include "io/results/atomic_file.h"
#include "io/results/frames.h"
#include "io/scene/scene_builder.h"
#include "io/slips/slips.h"
#include "mechanics/linear/blas.h"
#include "process/loop/process.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "billet/case_inside.h"
#include "billet/translated.h"

namespace billet {

namespace {

constexpr std::string_view warning_mark = "warning: ";

/// Whether a change makes an earlier one of no effect: it is of the same key, or of one above.
bool supersedes(const Change& later, const Change& earlier) {
  return !later.path.empty() && later.path.size() <= earlier.path.size() &&
         std::equal(later.path.begin(), later.path.end(), earlier.path.begin());
}

/// Whether a key may mean another item of a list after a change: one of a name, of a whole item, or
/// of a list of tables.
bool moves_items(const Change& change) {
  constexpr std::size_t of_item = 2; // parts of its key: tool.punch
  const std::size_t equals = change.text.find('=');
  if (change.erases || equals == std::string::npos || change.path.empty())
    return change.erases;
  std::string value = change.text.substr(equals + 1);
  std::erase_if(value, [](char c) { return c == ' ' || c == '\t'; });
  return change.path.back() == "name" || value.starts_with("[{") ||
         (change.path.size() <= of_item && value.starts_with("{"));
}

/// Adds a change. Earlier ones of the same key go, so that a loop over its values ends with one;
/// but for those before a change that moves items, which may be of another one.
void add(Change change, std::vector<Change>& changes) {
  if (!change.erases) {
    const auto last_move = std::find_if(changes.rbegin(), changes.rend(), moves_items);
    changes.erase(std::remove_if(last_move.base(), changes.end(),
                                 [&](const Change& c) { return supersedes(change, c); }),
                  changes.end());
  }
  changes.push_back(std::move(change));
}

Change assignment(std::string text) {
  std::vector<std::string> path = io::key_parts(text).value_or(std::vector<std::string>{});
  return {std::move(text), std::move(path), false};
}

Change removal(std::string_view key) {
  return {std::string(key), io::key_parts(key).value_or(std::vector<std::string>{}), true};
}

void move_to(std::vector<std::string> lines, std::vector<std::string>& all) {
  std::move(lines.begin(), lines.end(), std::back_inserter(all));
}

/// Those of the notes that are warnings, without the mark.
std::vector<std::string> warnings_of(const std::vector<std::string>& notes) {
  std::vector<std::string> warnings;
  for (const std::string& note : notes)
    if (note.starts_with(warning_mark))
      warnings.push_back(note.substr(warning_mark.size()));
  return warnings;
}

CaseReport report_of(const io::Case& content, const std::string& name) {
  io::require_known_fields(content.output, name);
  std::vector<std::string> notes = io::number_slips(content);
  io::BuiltScene built = io::build_scene(content, name);
  move_to(std::move(built.notes), notes);
  const process::Process process(std::move(built.scene));
  const process::Run& run = process.view();
  move_to(io::meeting_slips(run.scene, content.units), notes);
  move_to(io::scene_slips(content, run), notes);
  CaseReport report{warnings_of(notes), {}};
  for (io::Advice& advice : io::scene_advice(content, run.scene))
    report.advice.push_back(std::move(advice.text));
  return report;
}

} // namespace

io::Node Case::Inside::tree(io::Complaints& complaints) const {
  io::Node root = io::parse_document(text, name);
  for (const Change& change : changes)
    if (change.erases)
      io::erase_key(root, change.text, complaints);
    else
      io::apply_override(root, change.text, complaints);
  return root;
}

io::Case Case::Inside::read() const {
  io::Complaints complaints(name);
  return io::read_case_tree(tree(complaints), complaints, folder, {allow_outside});
}

void Case::Inside::change(std::vector<Change> additional) {
  Inside changed = *this;
  for (Change& change : additional)
    add(std::move(change), changed.changes);
  changed.content = changed.read();
  *this = std::move(changed);
}

std::string Case::Inside::current_text() const {
  if (changes.empty())
    return text;
  io::Complaints none(name);
  return io::toml_file(tree(none));
}

Case::Case(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Case::~Case() = default;
Case::Case(const Case& other) : inside_(std::make_unique<Inside>(*other.inside_)) {}
Case& Case::operator=(const Case& other) {
  inside_ = std::make_unique<Inside>(*other.inside_);
  return *this;
}
Case::Case(Case&& other) noexcept = default;
Case& Case::operator=(Case&& other) noexcept = default;

Case Case::load(const std::filesystem::path& file,
                const std::vector<std::string>& overrides,
                bool allow_outside) {
  return translated([&] {
    auto inside = std::make_unique<Inside>(
        Inside{io::case_file_text(file), file.string(), file.parent_path(), allow_outside});
    for (const std::string& text : overrides)
      add(assignment(text), inside->changes);
    inside->content = inside->read();
    return Case(std::move(inside));
  });
}

Case Case::from_text(std::string text, const std::filesystem::path& folder, bool allow_outside) {
  return translated([&] {
    auto inside =
        std::make_unique<Inside>(Inside{std::move(text), "case text", folder, allow_outside});
    inside->content = inside->read();
    return Case(std::move(inside));
  });
}

void Case::set(std::string_view key, std::string_view value) {
  std::string text(key);
  set({text.append("=").append(value)});
}

void Case::set(const std::vector<std::string>& assignments) {
  std::vector<Change> changes;
  changes.reserve(assignments.size());
  for (const std::string& text : assignments)
    changes.push_back(assignment(text));
  translated([&] { inside_->change(std::move(changes)); });
}

void Case::erase(std::string_view key) {
  translated([&] { inside_->change({removal(key)}); });
}

std::string Case::text() const {
  return translated([&] { return inside_->current_text(); });
}

std::string Case::resolved_text() const { return io::resolved_toml(inside_->content); }

void Case::save(const std::filesystem::path& file) const {
  translated([&] {
    const std::string text = inside_->current_text();
    static_cast<void>(
        io::read_case_text(text, file.string(), file.parent_path(), {}, {inside_->allow_outside}));
    io::write_file(file, text);
  });
}

const std::string& Case::name() const { return inside_->name; }
const std::filesystem::path& Case::folder() const { return inside_->folder; }

CaseReport Case::check() const {
  const mechanics::KernelSettings settings;
  return translated([&] { return report_of(inside_->content, inside_->name); });
}

} // namespace billet
