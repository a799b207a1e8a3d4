// What the values of a file may look like: the answer of the reader, noted by an Inquiry.
//
// A shape is a set of alternatives. A table has one alternative for each set of keys that goes with
// a word or a key of it, such as the keys of each friction law; its labels are those words.

#pragma once

#include "geometry/base/parameter.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace billet::io {

struct Shape;
struct KeyShape;

/// A number, or a text of a number and its unit.
struct NumberShape {
  Quantity measured;
  Bounds bounds;
};

/// A whole number.
struct CountShape {
  int least;
  int most;
};

/// Any text; `what` says which, for people.
struct TextShape {
  std::string what;
  std::string pattern; ///< a regular expression of ECMA 262; empty: none
};

/// One of some words.
struct WordShape {
  std::vector<std::string> words;
};

struct FlagShape {};

/// Anything: what it is depends on another file.
struct AnyShape {
  std::string what;
};

struct ListShape {
  std::vector<Shape> item; ///< exactly one: that of all items
  std::size_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

struct TableShape {
  std::vector<std::string> labels; ///< the choices that lead to these keys
  std::vector<KeyShape> keys;
  std::vector<Shape> named; ///< none or one: that of values whose keys the user names
};

using Alternative = std::variant<NumberShape,
                                 CountShape,
                                 TextShape,
                                 WordShape,
                                 FlagShape,
                                 AnyShape,
                                 ListShape,
                                 TableShape>;

struct Shape {
  std::vector<Alternative> alternatives; ///< none: the value is always refused
};

struct KeyShape {
  std::string key;
  Shape shape;
  bool required = false;
  std::string initial; ///< its default as JSON; empty: none, or not known
};

/// Adds an alternative; tables of the same labels, lists and words become one each.
void add(Shape& into, Alternative alternative);

/// Adds all alternatives of another shape.
void merge(Shape& into, Shape from);

/// The shape with the labels of its own tables left out: they become one, of all their keys.
[[nodiscard]] Shape without_labels(Shape shape);

/// The shape with no key required, here and below: another source may give them.
[[nodiscard]] Shape nothing_required(Shape shape);

} // namespace billet::io
