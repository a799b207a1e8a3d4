// Reads single values: numbers with units, vectors, tables of numbers, words, files.
//
// Every function takes a node and gives the value, or complains and gives none.

#pragma once

#include "geometry/base/parameter.h"
#include "io/case/table_reader.h"
#include "io/case/units.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billet::io {

using allowed::above_absolute_zero;
using allowed::any_value;
using allowed::fraction;
using allowed::not_negative;
using allowed::positive;

/// The words for bounds in messages: "a value > 0".
[[nodiscard]] std::string bounds_text(const Bounds& bounds);

/// A kind of number: what it measures and what is allowed.
struct Number {
  Quantity measured = quantity::number;
  Bounds bounds = any_value;
};

inline constexpr Number positive_number{quantity::number, positive};
inline constexpr Number not_negative_number{quantity::number, not_negative};
inline constexpr Number fraction_number{quantity::number, fraction};
inline constexpr Number positive_stress{quantity::stress, positive};
inline constexpr Number not_negative_stress{quantity::stress, not_negative};
inline constexpr Number any_length{quantity::length, any_value};
inline constexpr Number positive_length{quantity::length, positive};
inline constexpr Number positive_time{quantity::duration, positive};
inline constexpr Number not_negative_time{quantity::duration, not_negative};

[[nodiscard]] std::optional<double> as_number(const At& at, const Number& kind);
[[nodiscard]] std::optional<std::string> as_text(const At& at);
[[nodiscard]] std::optional<bool> as_flag(const At& at);

/// A whole number from 1 to 1e6.
[[nodiscard]] std::optional<int> as_count(const At& at);

/// A text that may name a tool, a stage or a material: letters, digits, "_", "-", inner spaces.
[[nodiscard]] std::optional<std::string> as_name(const At& at);

/// A list of at least one text.
[[nodiscard]] std::optional<std::vector<std::string>> as_texts(const At& at);

/// A list of at least one number.
[[nodiscard]] std::optional<std::vector<double>> as_numbers(const At& at, const Number& kind);

/// A list of exactly N counts.
template <std::size_t N> [[nodiscard]] std::optional<std::array<int, N>> as_counts(const At& at);

/// As many numbers as the scene has dimensions; z is 0 in the plane.
[[nodiscard]] std::optional<Vec3> as_vector(const At& at, const Number& kind);

/// A vector of plain numbers that is not zero.
[[nodiscard]] std::optional<Vec3> as_direction(const At& at);

/// A direction in space; in the plane only z, with three entries.
[[nodiscard]] std::optional<Vec3> as_axis(const At& at);

/// Rows of `columns` numbers, the first of which increases strictly from row to row.
[[nodiscard]] std::optional<std::vector<std::vector<double>>>
as_table(const At& at, std::span<const Number> columns);

/// The same for two columns.
[[nodiscard]] std::optional<std::vector<std::pair<double, double>>>
as_pairs(const At& at, const Number& first, const Number& second);

/// A number, or a table [[time, value], ...].
[[nodiscard]] std::optional<TimeFunction> as_time_function(const At& at, const Number& kind);

/// A file that is there and, unless allowed, in the case's folder or below.
[[nodiscard]] std::optional<InputFile> as_input_file(const At& at);

/// A unit of length, and how many lengths of the case make one.
struct LengthUnit {
  std::string name;    ///< as given ("mm")
  double factor = 1.0; ///< from numbers in that unit to the case's lengths
};

/// The unit that the numbers of a file are in, such as "mm" or "in".
[[nodiscard]] std::optional<LengthUnit> as_length_unit(const At& at);

/// "x = 0", "set:NAME" or "all".
[[nodiscard]] std::optional<Where> as_where(const At& at);

/// A stress, "shear-yield" or "von-mises".
[[nodiscard]] std::optional<contact::ShearYieldStress> as_shear_strength(const At& at,
                                                                         const Number& kind);

/// A word of the case file and what it stands for.
template <class Value> struct Word {
  std::string_view word;
  Value value;
};

/// The place of a text in a list of words; complains with the nearest word.
[[nodiscard]] std::optional<std::size_t> as_word_index(const At& at,
                                                       const std::vector<std::string>& words);

/// The words of a list.
template <class Value, std::size_t N>
[[nodiscard]] std::vector<std::string> names_of(const std::array<Word<Value>, N>& words) {
  std::vector<std::string> names;
  std::transform(words.begin(), words.end(), std::back_inserter(names),
                 [](const Word<Value>& word) { return std::string(word.word); });
  return names;
}

/// What one of the words stands for.
template <class Value, std::size_t N>
[[nodiscard]] std::optional<Value> as_word(const At& at, const std::array<Word<Value>, N>& words) {
  const std::optional<std::size_t> index = as_word_index(at, names_of(words));
  return index ? std::optional(words[*index].value) : std::nullopt;
}

/// As as_word_index and as_word, for a word on which the other keys of its table depend.
[[nodiscard]] std::optional<std::size_t> as_choice_index(const At& at,
                                                         const std::vector<std::string>& words);
template <class Value, std::size_t N>
[[nodiscard]] std::optional<Value> as_choice(const At& at,
                                             const std::array<Word<Value>, N>& words) {
  const std::optional<std::size_t> index = as_choice_index(at, names_of(words));
  return index ? std::optional(words[*index].value) : std::nullopt;
}

/// Items of a list of known length; complains and gives null when it is none.
[[nodiscard]] const List* as_list(const At& at, std::size_t size, const std::string& allowed);

template <std::size_t N> std::optional<std::array<int, N>> as_counts(const At& at) {
  const List* const list = as_list(at, N, std::to_string(N) + " whole numbers");
  if (list == nullptr)
    return std::nullopt;
  std::array<int, N> counts{};
  bool good = true;
  for (std::size_t i = 0; i < N; ++i) {
    const std::optional<int> count = as_count(at.item((*list)[i], i));
    good = good && count.has_value();
    counts[i] = count.value_or(1);
  }
  return good ? std::optional(counts) : std::nullopt;
}

} // namespace billet::io
