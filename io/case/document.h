// The text of a case file as a tree of tables, lists and values that know their place.
//
// The only contact with the TOML library is toml_parser.cpp; what the rest sees are these nodes.
// The text is guarded first: the library may overflow its stack on very deep texts.

#pragma once

#include "geometry/base/error.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace billet::io {

/// Where something stands: line and column of the file, or one of the user's overrides.
struct TextPlace {
  int line = 0;     ///< from 1; 0: the file as a whole
  int column = 0;   ///< from 1
  int override = 0; ///< from 1: number of the override; 0: the file
};

/// Collects what is wrong with a file, to report all of it together.
class Complaints {
public:
  /// @param name  of the file, as the user gave it
  explicit Complaints(std::string name) : name_(std::move(name)) {}

  /// Makes an override known; its number for TextPlace.
  int add_override(std::string text);
  /// @return  the number of the complaint, to withdraw it by
  std::size_t add(const TextPlace& place,
                  std::string message,
                  std::string remedy = {},
                  std::string_view code = error_code::case_refused);
  /// Takes a complaint back that follows from another one.
  void withdraw(std::size_t number) { found_[number].is_withdrawn = true; }
  [[nodiscard]] bool empty() const;

  /// Throws an Error of all complaints in the order of their places, if there are any.
  void throw_if_any();

  /// "case.toml:12:9", or the override.
  [[nodiscard]] std::string text(const TextPlace& place) const;

private:
  struct Found {
    TextPlace place;
    std::string message;
    std::string remedy;
    std::string_view code;
    bool is_withdrawn = false;
  };

  std::string name_;
  std::vector<std::string> overrides_;
  std::vector<Found> found_;
};

struct Node;
struct Entry;
class Inquiry;

/// A date or a time of day: TOML has them, a case file has no use for them.
struct Date {};

using List = std::vector<Node>;

struct Table {
  std::vector<Entry> entries; ///< keys are unique

  [[nodiscard]] const Node* find(std::string_view key) const;
  [[nodiscard]] Node* find(std::string_view key);
};

/// A value, a list or a table; where a reader is asked what it reads, an inquiry (inquiry.h).
struct Node {
  TextPlace place;
  std::variant<bool, std::int64_t, double, std::string, Date, List, Table, Inquiry*> value;

  template <class T> [[nodiscard]] const T* as() const { return std::get_if<T>(&value); }
  template <class T> [[nodiscard]] T* as() { return std::get_if<T>(&value); }
};

struct Entry {
  std::string key;
  TextPlace place; ///< of the key
  Node node;
};

/// Text for a message: control characters escaped, cut if long.
[[nodiscard]] std::string printable(std::string_view text);

/// How a message shows a value: text in quotes and cut if long, "a list", "a table".
[[nodiscard]] std::string shown(const Node& node);

/// How messages call the i-th item of a list: by its key `name` if it has one, else by its index.
[[nodiscard]] std::string item_name(const Node& item, std::size_t i);

/// Parses a TOML text; `root` is a table.
///
/// @param place  override 0: places are those of the text; else every place is this one
/// @throws Error with Fault::case_file on a syntax error or a text beyond the guards
[[nodiscard]] Node
parse_document(std::string_view text, const std::string& name, const TextPlace& place = {});

/// Refuses texts that the parser cannot take: too long, keys or brackets too deep.
///
/// @throws Error with Fault::case_file
void guard_text(std::string_view text, const std::string& name);

/// Applies a "key=value" override to the tree; one that leads nowhere is complained about.
void apply_override(Node& root, const std::string& text, Complaints& complaints);

/// Applies several, in their order.
void apply_overrides(Node& root, const std::vector<std::string>& overrides, Complaints& complaints);

/// Removes what a dotted key leads to; complains where there is nothing.
void erase_key(Node& root, const std::string& key, Complaints& complaints);

/// The parts of a dotted key, quoted or not, up to its end or to '='; none when it has not that
/// form.
[[nodiscard]] std::optional<std::vector<std::string>> key_parts(std::string_view text);

/// The item of a list that a part of a key means: by its name, else by its index from 0. None:
/// there is no such item.
[[nodiscard]] std::optional<std::size_t> index_of_item(const List& list, const std::string& part);

/// The tree as the text of a case file, without comments: parsing it gives the same tree.
/// @pre root is a table and holds no Date
[[nodiscard]] std::string toml_file(const Node& root);

} // namespace billet::io
