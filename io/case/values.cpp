#include "io/case/values.h"

#include "io/case/suggestion.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

namespace billet::io {

namespace {

constexpr int largest_count = 1'000'000;

/// How a text that should be a plain number is written as one; empty: it is none.
std::string as_plain_number(std::string_view text) {
  text = trimmed(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view rest = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  if (error != std::errc{} || !(rest.empty() || rest == "%"))
    return {};
  return fmt::format("write {}{}", rest.empty() ? value : value / 100.0,
                     rest.empty() ? ", without quotes" : "");
}

/// A finite number in the case's units, bounds not yet checked.
std::optional<double> finite_number(const At& at, const Number& kind) {
  std::optional<double> value;
  if (const auto* const integer = at.node.as<std::int64_t>())
    value = static_cast<double>(*integer);
  else if (const auto* const real = at.node.as<double>())
    value = *real;
  else if (const auto* const text = at.node.as<std::string>()) {
    const Outcome<double> in_units = converted(*text, kind.measured, at.context.units);
    if (!in_units) {
      at.refuse(fmt::format("found {}, {}", shown(at.node), in_units.error().reason),
                kind.measured.takes_unit ? "" : as_plain_number(*text));
      return std::nullopt;
    }
    value = *in_units;
  }
  if (!value)
    at.complain_found(kind.measured.takes_unit
                          ? fmt::format("a number or {} such as \"10 {}\"", kind.measured.name,
                                        kind.measured.example)
                          : "a number");
  else if (!std::isfinite(*value))
    at.complain_found("a finite number");
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Where a list must have as many entries as the scene has dimensions.
std::size_t vector_size(const At& at, const List& list) {
  if (at.context.in_plane())
    return 2;
  if (at.context.in_space())
    return 3;
  return list.size() == 2 ? 2 : 3; // the analysis is not known
}

const List* vector_items(const At& at) {
  const std::size_t size = at.context.in_space() ? 3 : 2;
  return at.inquiry() != nullptr ? at.inquiry()->expect_list(size, size, size) : at.node.as<List>();
}

/// A value within bounds.
double some_value(const Bounds& bounds) {
  for (const double value : {1.0, 0.5})
    if (bounds.admit(value))
      return value;
  return 0.5 * (bounds.low + bounds.high);
}

bool is_part_of_name(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80 || c == '_' || c == '-' || c == ' ';
}

/// Letters of a text in UTF-8, all bytes but those that continue one.
std::size_t n_letters(std::string_view text) {
  constexpr unsigned continues = 0x80, of = 0xC0;
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & of) != continues;
  }));
}

} // namespace

std::string bounds_text(const Bounds& bounds) {
  const auto& [low, high, low_open, high_open] = bounds;
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  if (has_low && has_high)
    return fmt::format("{} {} value {} {}", low,
                       low_open ? "<" : "<=", high_open ? "<" : "<=", high);
  if (has_low)
    return fmt::format("a value {} {}", low_open ? ">" : ">=", low);
  return has_high ? fmt::format("a value {} {}", high_open ? "<" : "<=", high) : "a number";
}

std::optional<double> as_number(const At& at, const Number& kind) {
  if (at.expect(NumberShape{kind.measured, kind.bounds}))
    return some_value(kind.bounds);
  const std::optional<double> value = finite_number(at, kind);
  if (!value || kind.bounds.admit(*value))
    return value;
  at.complain_found(bounds_text(kind.bounds));
  return std::nullopt;
}

std::optional<std::string> as_text(const At& at) {
  if (at.expect(TextShape{"a text", {}}))
    return "text";
  if (const auto* const text = at.node.as<std::string>())
    return *text;
  at.complain_found("a text in quotes");
  return std::nullopt;
}

std::optional<bool> as_flag(const At& at) {
  if (at.expect(FlagShape{}))
    return false;
  if (const auto* const flag = at.node.as<bool>())
    return *flag;
  at.complain_found("true or false");
  return std::nullopt;
}

std::optional<int> as_count(const At& at) {
  if (at.expect(CountShape{1, largest_count}))
    return 1;
  const auto* const value = at.node.as<std::int64_t>();
  if (value != nullptr && *value >= 1 && *value <= largest_count)
    return static_cast<int>(*value);
  if (const auto* const real = at.node.as<double>();
      real != nullptr && std::floor(*real) == *real) {
    at.refuse(fmt::format("found {:.1f}, allowed is a whole number from 1 to {}, without a point",
                          *real, largest_count));
    return std::nullopt;
  }
  at.complain_found(fmt::format("a whole number from 1 to {}", largest_count));
  return std::nullopt;
}

std::optional<std::string> as_name(const At& at) {
  if (at.expect(TextShape{"a name", "^[^ ](.*[^ ])?$"}))
    return "name";
  const auto* const text = at.node.as<std::string>();
  constexpr std::size_t longest = 64;
  if (text != nullptr && !text->empty() && n_letters(*text) <= longest &&
      std::all_of(text->begin(), text->end(), is_part_of_name) && text->front() != ' ' &&
      text->back() != ' ')
    return *text;
  at.complain_found("a name of 1 to 64 letters, digits, '_', '-' and inner spaces");
  return std::nullopt;
}

const List* as_list(const At& at, std::size_t size, const std::string& allowed) {
  if (Inquiry* const inquiry = at.inquiry())
    return inquiry->expect_list(size, size, size);
  const List* const list = at.node.as<List>();
  if (list != nullptr && list->size() == size)
    return list;
  at.complain_found("a list of " + allowed);
  return nullptr;
}

std::optional<std::vector<std::string>> as_texts(const At& at) {
  const List* const list = at.list(1);
  if (list == nullptr || list->empty()) {
    at.complain_found("a list of at least one text");
    return std::nullopt;
  }
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < list->size(); ++i)
    if (std::optional<std::string> text = as_text(at.item((*list)[i], i)))
      texts.push_back(std::move(*text));
  return texts.size() == list->size() ? std::optional(texts) : std::nullopt;
}

std::optional<std::vector<double>> as_numbers(const At& at, const Number& kind) {
  const List* const list = at.list(1);
  if (list == nullptr || list->empty()) {
    at.complain_found("a list of at least one number");
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < list->size(); ++i)
    if (const std::optional<double> number = as_number(at.item((*list)[i], i), kind))
      numbers.push_back(*number);
  return numbers.size() == list->size() ? std::optional(numbers) : std::nullopt;
}

std::optional<Vec3> as_vector(const At& at, const Number& kind) {
  const List* const list = vector_items(at);
  const std::size_t size = list != nullptr ? vector_size(at, *list) : 0;
  if (list == nullptr || list->size() != size) {
    at.complain_found(at.context.in_plane()   ? "a list of 2 numbers (the scene is in the plane)"
                      : at.context.in_space() ? "a list of 3 numbers (the scene is 3d)"
                                              : "a list of 2 or 3 numbers");
    return std::nullopt;
  }
  Vec3 vector = Vec3::Zero();
  bool good = true;
  for (std::size_t i = 0; i < size; ++i) {
    const std::optional<double> entry = as_number(at.item((*list)[i], i), kind);
    good = good && entry.has_value();
    vector[static_cast<Eigen::Index>(i)] = entry.value_or(0.0);
  }
  return good ? std::optional(vector) : std::nullopt;
}

std::optional<Vec3> as_direction(const At& at) {
  std::optional<Vec3> vector = as_vector(at, {});
  if (!vector || vector->cwiseAbs().maxCoeff() > 0.0)
    return vector;
  at.refuse("found a zero vector, allowed is a direction");
  return std::nullopt;
}

std::optional<Vec3> as_axis(const At& at) {
  if (!at.context.in_plane())
    return as_direction(at);
  constexpr auto allowed = "[0, 0, 1] or [0, 0, -1] (the scene is in the plane), or no axis";
  const List* const list = as_list(at, 3, allowed);
  if (list == nullptr)
    return std::nullopt;
  Vec3 axis = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> entry = as_number(at.item((*list)[i], i), {});
    if (!entry)
      return std::nullopt;
    axis[static_cast<Eigen::Index>(i)] = *entry;
  }
  if (axis.x() == 0.0 && axis.y() == 0.0 && axis.z() != 0.0)
    return axis;
  at.refuse(fmt::format("allowed is {}", allowed));
  return std::nullopt;
}

std::optional<std::vector<std::vector<double>>> as_table(const At& at,
                                                         std::span<const Number> columns) {
  const List* const rows = at.list(1);
  if (rows == nullptr || rows->empty()) {
    at.complain_found("a list of at least one row of numbers");
    return std::nullopt;
  }
  std::vector<std::vector<double>> table;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const At row_at = at.item((*rows)[i], i);
    const List* const row =
        as_list(row_at, columns.size(), fmt::format("{} numbers", columns.size()));
    if (row == nullptr)
      return std::nullopt;
    std::vector<double> values;
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (const auto value = as_number(row_at.item((*row)[j], j), columns[j]))
        values.push_back(*value);
    if (values.size() != columns.size())
      return std::nullopt;
    if (!table.empty() && !(values[0] > table.back()[0])) {
      row_at.item(row->front(), 0)
          .complain_found(fmt::format("more than the {} of the row before", table.back()[0]));
      return std::nullopt;
    }
    table.push_back(std::move(values));
  }
  return table;
}

std::optional<std::vector<std::pair<double, double>>>
as_pairs(const At& at, const Number& first, const Number& second) {
  const std::array columns{first, second};
  const auto table = as_table(at, columns);
  if (!table)
    return std::nullopt;
  std::vector<std::pair<double, double>> pairs;
  for (const std::vector<double>& row : *table)
    pairs.emplace_back(row[0], row[1]);
  return pairs;
}

std::optional<TimeFunction> as_time_function(const At& at, const Number& kind) {
  if (!at.is_a<List>()) {
    const std::optional<double> constant = as_number(at, kind);
    return constant ? std::optional(TimeFunction(*constant)) : std::nullopt;
  }
  auto pairs = as_pairs(at, {quantity::duration, any_value}, kind);
  return pairs ? std::optional(TimeFunction(std::move(*pairs))) : std::nullopt;
}

std::optional<std::size_t> as_choice_index(const At& at, const std::vector<std::string>& words) {
  if (at.inquiry() == nullptr)
    return as_word_index(at, words);
  const std::size_t chosen = at.inquiry()->parent().choose(words);
  at.expect(WordShape{{words[chosen]}});
  return chosen;
}

std::optional<std::size_t> as_word_index(const At& at, const std::vector<std::string>& words) {
  if (at.expect(WordShape{words}))
    return 0;
  const auto* const text = at.node.as<std::string>();
  if (text != nullptr) {
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found != words.end())
      return static_cast<std::size_t>(found - words.begin());
  }
  std::string allowed;
  for (const std::string& word : words)
    allowed += fmt::format("{}\"{}\"", allowed.empty() ? "" : ", ", word);
  const std::string remedy = text != nullptr ? suggestion(*text, words) : "";
  at.complain_found(allowed, remedy.starts_with("did") ? remedy : "");
  return std::nullopt;
}

} // namespace billet::io
