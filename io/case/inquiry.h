// Asks a reader what it reads.
//
// An inquiry stands in a tree of nodes in the place of a value. The functions that read values
// (values.h, TableReader) tell it what they expect and get a value that would do; so the reader
// itself is the only list of keys, kinds of values and words, and billet schema is made of it.
//
// Where the reader goes different ways, as with the law of friction, the inquiry answers with the
// first way, and is read again for each of the others (read_value_of in table_reader.h). What one
// reading has asked for is one alternative of the shape.

#pragma once

#include "io/case/document.h"
#include "io/case/shape.h"

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

class Inquiry {
public:
  explicit Inquiry(Inquiry* parent = nullptr) : parent_(parent) {}

  // --- what a value is expected to be ---------------------------------------------------------

  void expect(Alternative alternative) { add(current_, std::move(alternative)); }
  /// A list; its items, each an inquiry. @param size  how many are made
  [[nodiscard]] const List* expect_list(std::size_t size, std::size_t least, std::size_t most);
  void expect_table() { is_table_ = true; }
  /// The value of a key of a table; null: in this alternative the key is not there.
  [[nodiscard]] const Node* key(std::string_view key, bool required);
  /// The value of any key, in a table whose keys the user names.
  [[nodiscard]] const Node* named();
  /// The default of a key asked for already, as JSON.
  void set_initial(std::string_view key, std::string initial);
  /// No key needs to be given, here and below, but those whose presence was asked for.
  void require_nothing() { requires_nothing_ = true; }

  // --- the ways a reader may go ---------------------------------------------------------------

  /// One of the labels, another one at each reading. Of a table: its keys depend on it.
  [[nodiscard]] std::size_t choose(std::span<const std::string> labels);
  /// Whether a key is there: both, one after the other.
  [[nodiscard]] bool has(std::string_view key);
  /// The table that the value is in.
  [[nodiscard]] Inquiry& parent() const { return *parent_; }

  /// Begins the first reading.
  void begin();
  /// Begins the next one. False: all ways have been gone.
  [[nodiscard]] bool next();

  /// All that was asked for, when the readings are over.
  [[nodiscard]] Shape take();

private:
  struct Choice {
    std::size_t options;
    std::size_t chosen;
  };
  struct Key {
    std::string key;
    Node node;
    Inquiry* inquiry;
    bool required;
    std::string initial;
  };

  Node make_node(Inquiry*& made);
  /// Ends a reading: what it asked for is an alternative.
  void finish_reading();

  Inquiry* parent_;
  bool is_being_read_ = false;
  std::vector<Choice> choices_;
  std::size_t next_choice_ = 0;
  Shape found_; ///< of earlier readings

  // Of this reading.
  Shape current_;
  bool is_table_ = false;
  bool requires_nothing_ = false;
  std::vector<std::string> labels_;
  std::vector<std::string> present_, absent_; ///< of has()
  std::deque<Key> keys_;
  std::deque<Key> named_; ///< none or one
  List items_;
  std::size_t least_ = 0, most_ = 0;
  std::vector<Inquiry*> item_inquiries_;
  std::deque<Inquiry> below_;
};

} // namespace billet::io
