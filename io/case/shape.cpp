#include "io/case/shape.h"

#include <algorithm>
#include <type_traits>

namespace billet::io {

namespace {

bool same_quantity(const Quantity& a, const Quantity& b) {
  return a.name == b.name && a.takes_unit == b.takes_unit;
}

bool same_bounds(const Bounds& a, const Bounds& b) {
  return a.low == b.low && a.high == b.high && a.low_open == b.low_open &&
         a.high_open == b.high_open;
}

KeyShape* find_key(TableShape& table, const std::string& key) {
  const auto found = std::find_if(table.keys.begin(), table.keys.end(),
                                  [&](const KeyShape& one) { return one.key == key; });
  return found == table.keys.end() ? nullptr : &*found;
}

/// A key is required where both require it.
void merge_keys(TableShape& into, TableShape&& from) {
  for (KeyShape& own : into.keys)
    if (find_key(from, own.key) == nullptr)
      own.required = false;
  for (KeyShape& key : from.keys) {
    KeyShape* const own = find_key(into, key.key);
    if (own == nullptr) {
      key.required = false;
      into.keys.push_back(std::move(key));
      continue;
    }
    own->required = own->required && key.required;
    merge(own->shape, std::move(key.shape));
  }
  for (Shape& named : from.named)
    if (into.named.empty())
      into.named.push_back(std::move(named));
    else
      merge(into.named.front(), std::move(named));
}

// Takes `from` into `into` if the two can be one alternative.

bool absorb(NumberShape& into, NumberShape& from) {
  return same_quantity(into.measured, from.measured) && same_bounds(into.bounds, from.bounds);
}

bool absorb(CountShape& into, CountShape& from) {
  into = {std::min(into.least, from.least), std::max(into.most, from.most)};
  return true;
}

bool absorb(TextShape& into, TextShape& from) {
  return into.what == from.what && into.pattern == from.pattern;
}

bool absorb(WordShape& into, WordShape& from) {
  for (std::string& word : from.words)
    if (std::find(into.words.begin(), into.words.end(), word) == into.words.end())
      into.words.push_back(std::move(word));
  return true;
}

bool absorb(FlagShape& /*into*/, FlagShape& /*from*/) { return true; }

bool absorb(AnyShape& into, AnyShape& from) { return into.what == from.what; }

bool absorb(ListShape& into, ListShape& from) {
  into.least = std::min(into.least, from.least);
  into.most = std::max(into.most, from.most);
  merge(into.item.front(), std::move(from.item.front()));
  return true;
}

bool absorb(TableShape& into, TableShape& from) {
  if (into.labels != from.labels)
    return false;
  merge_keys(into, std::move(from));
  return true;
}

bool absorb_any(Alternative& into, Alternative& from) {
  return into.index() == from.index() &&
         std::visit(
             [&](auto& own) {
               return absorb(own, std::get<std::remove_reference_t<decltype(own)>>(from));
             },
             into);
}

void forget_required(Shape& shape) {
  for (Alternative& alternative : shape.alternatives)
    if (auto* const table = std::get_if<TableShape>(&alternative))
      for (KeyShape& key : table->keys) {
        key.required = false;
        forget_required(key.shape);
      }
}

} // namespace

void add(Shape& into, Alternative alternative) {
  for (Alternative& own : into.alternatives)
    if (absorb_any(own, alternative))
      return;
  into.alternatives.push_back(std::move(alternative));
}

void merge(Shape& into, Shape from) {
  for (Alternative& alternative : from.alternatives)
    add(into, std::move(alternative));
}

Shape without_labels(Shape shape) {
  Shape merged;
  for (Alternative& alternative : shape.alternatives) {
    if (auto* const table = std::get_if<TableShape>(&alternative))
      table->labels.clear();
    add(merged, std::move(alternative));
  }
  return merged;
}

Shape nothing_required(Shape shape) {
  forget_required(shape);
  return shape;
}

} // namespace billet::io
