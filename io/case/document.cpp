#include "io/case/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace billet::io {

namespace {

constexpr std::size_t most_complaints = 100; // more help nobody

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string escaped(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte < 0x20 || byte == 0x7F)
    return fmt::format("\\x{:02x}", byte);
  return {c};
}

} // namespace

int Complaints::add_override(std::string text) {
  overrides_.push_back(std::move(text));
  return static_cast<int>(overrides_.size());
}

std::size_t Complaints::add(const TextPlace& place,
                            std::string message,
                            std::string remedy,
                            std::string_view code) {
  found_.push_back({place, std::move(message), std::move(remedy), code});
  return found_.size() - 1;
}

bool Complaints::empty() const {
  return std::all_of(found_.begin(), found_.end(),
                     [](const Found& found) { return found.is_withdrawn; });
}

std::string Complaints::text(const TextPlace& place) const {
  if (place.override != 0)
    return "--set " + printable(overrides_[static_cast<std::size_t>(place.override - 1)]);
  if (place.line == 0)
    return name_;
  return fmt::format("{}:{}:{}", name_, place.line, place.column);
}

void Complaints::throw_if_any() {
  std::erase_if(found_, [](const Found& found) { return found.is_withdrawn; });
  if (found_.empty())
    return;
  std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
    return std::tie(a.place.override, a.place.line, a.place.column) <
           std::tie(b.place.override, b.place.line, b.place.column);
  });
  std::vector<Complaint> complaints;
  for (const Found& found : found_) {
    if (complaints.size() == most_complaints) {
      complaints.push_back(
          {name_, fmt::format("and {} more", found_.size() - most_complaints), "", found.code});
      break;
    }
    complaints.push_back({text(found.place), found.message, found.remedy, found.code});
  }
  throw Error(Fault::case_file, std::move(complaints));
}

const Node* Table::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &found->node;
}

Node* Table::find(std::string_view key) {
  return const_cast<Node*>(std::as_const(*this).find(key)); // NOLINT: this is not const
}

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::size_t size = std::min(text.size(), longest);
  while (size < text.size() && size > 0 && continues_character(text[size]))
    --size;
  std::string result;
  for (const char c : text.substr(0, size))
    result += escaped(c);
  return size < text.size() ? result + "..." : result;
}

std::string shown(const Node& node) {
  if (const auto* const text = node.as<std::string>())
    return fmt::format("\"{}\"", printable(*text));
  if (const auto* const integer = node.as<std::int64_t>())
    return fmt::format("{}", *integer);
  if (const auto* const real = node.as<double>())
    return fmt::format("{}", *real);
  if (const auto* const boolean = node.as<bool>())
    return *boolean ? "true" : "false";
  if (const auto* const list = node.as<List>())
    return list->empty() ? "an empty list" : fmt::format("a list of {}", list->size());
  return node.as<Table>() != nullptr ? "a table" : "a date or time";
}

std::string item_name(const Node& item, std::size_t i) {
  const Table* const table = item.as<Table>();
  const Node* const name = table != nullptr ? table->find("name") : nullptr;
  const std::string* const text = name != nullptr ? name->as<std::string>() : nullptr;
  return text != nullptr && !text->empty() ? printable(*text) : std::to_string(i);
}

} // namespace billet::io
