#include "study/node_text.h"

#include "io/case/inquiry.h"
#include "io/case/toml_text.h"

#include <fmt/format.h>

namespace billet::study {

namespace {

struct Writer {
  std::string operator()(bool value) const { return io::toml_text(value); }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return io::toml_text(value); }
  std::string operator()(const std::string& value) const {
    return io::toml_text(std::string_view(value));
  }
  std::string operator()(const io::Date&) const { return "a date"; }
  std::string operator()(io::Inquiry* asking) const {
    asking->expect(io::AnyShape{"a value of the case file"});
    return "0";
  }
  std::string operator()(const io::List& list) const {
    std::vector<std::string> items;
    for (const io::Node& item : list)
      items.push_back(toml_text(item));
    return io::toml_list(items);
  }
  std::string operator()(const io::Table& table) const {
    io::TomlTable text;
    for (const io::Entry& entry : table.entries)
      text.add(entry.key, toml_text(entry.node));
    return text.on_one_line();
  }
};

} // namespace

std::string toml_text(const io::Node& node) { return std::visit(Writer{}, node.value); }

} // namespace billet::study
