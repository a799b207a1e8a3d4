#include "io/case/inquiry.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace billet::io {

Node Inquiry::make_node(Inquiry*& made) {
  made = &below_.emplace_back(this);
  return {TextPlace{}, made};
}

const List* Inquiry::expect_list(std::size_t size, std::size_t least, std::size_t most) {
  if (items_.empty()) {
    item_inquiries_.resize(size);
    for (Inquiry*& inquiry : item_inquiries_)
      items_.push_back(make_node(inquiry));
  }
  least_ = least;
  most_ = most;
  return &items_;
}

const Node* Inquiry::key(std::string_view key, bool required) {
  is_table_ = true;
  if (std::find(absent_.begin(), absent_.end(), key) != absent_.end())
    return nullptr;
  for (Key& own : keys_)
    if (own.key == key) {
      own.required = own.required || required;
      return &own.node;
    }
  Inquiry* inquiry = nullptr;
  Node node = make_node(inquiry);
  return &keys_.emplace_back(Key{std::string(key), std::move(node), inquiry, required, {}}).node;
}

const Node* Inquiry::named() {
  is_table_ = true;
  if (named_.empty()) {
    Inquiry* inquiry = nullptr;
    Node node = make_node(inquiry);
    named_.push_back(Key{"", std::move(node), inquiry, false, {}});
  }
  return &named_.front().node;
}

void Inquiry::set_initial(std::string_view key, std::string initial) {
  for (Key& own : keys_)
    if (own.key == key)
      own.initial = std::move(initial);
}

std::size_t Inquiry::choose(std::span<const std::string> labels) {
  if (!is_being_read_)
    throw std::logic_error("a reader goes different ways outside of read_value_of: " +
                           labels.front());
  if (next_choice_ == choices_.size())
    choices_.push_back({labels.size(), 0});
  const std::size_t chosen = choices_[next_choice_++].chosen;
  labels_.push_back(labels[chosen]);
  return chosen;
}

bool Inquiry::has(std::string_view key) {
  const std::vector<std::string> labels{"with " + std::string(key), "without " + std::string(key)};
  const bool is_there = choose(labels) == 0;
  if (is_there)
    (void)this->key(key, true);
  (is_there ? present_ : absent_).emplace_back(key);
  return is_there;
}

void Inquiry::begin() {
  is_being_read_ = true;
  choices_.clear();
  next_choice_ = 0;
}

bool Inquiry::next() {
  finish_reading();
  next_choice_ = 0;
  while (!choices_.empty() && choices_.back().chosen + 1 == choices_.back().options)
    choices_.pop_back();
  if (choices_.empty()) {
    is_being_read_ = false;
    return false;
  }
  ++choices_.back().chosen;
  return true;
}

void Inquiry::finish_reading() {
  if (!items_.empty()) {
    Shape item;
    for (Inquiry* const inquiry : item_inquiries_)
      merge(item, inquiry->take());
    add(current_, ListShape{{std::move(item)}, least_, most_});
  }
  if (is_table_) {
    TableShape table{labels_, {}, {}};
    for (Key& key : keys_) {
      Shape shape = key.inquiry->take();
      if (shape.alternatives.empty())
        continue; // refused whatever it is
      if (requires_nothing_)
        shape = nothing_required(std::move(shape));
      const bool is_asked = std::find(present_.begin(), present_.end(), key.key) != present_.end();
      const bool required = key.required && (!requires_nothing_ || is_asked);
      table.keys.push_back({key.key, std::move(shape), required, key.initial});
    }
    for (const Key& key : named_)
      table.named.push_back(key.inquiry->take());
    add(current_, std::move(table));
  }
  merge(found_, std::move(current_));
  current_ = {};
  is_table_ = requires_nothing_ = false;
  labels_.clear();
  present_.clear();
  absent_.clear();
  keys_.clear();
  named_.clear();
  items_.clear();
  item_inquiries_.clear();
  below_.clear();
}

Shape Inquiry::take() {
  finish_reading();
  return std::exchange(found_, {});
}

} // namespace billet::io
