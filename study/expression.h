// Expressions of names: "-punch.force_y / 1000", "ln(15 / height)".
//
// The work is muParser's. A name may hold dots and, where it is known, signs: `tool-a.force_y` is a
// column, not a difference.

#pragma once

#include <span>
#include <string>
#include <vector>

namespace billet::study {

/// An expression and what it is of.
class Expression {
public:
  /// @param known  names that it may use; the longest that fits is taken
  /// @throws Error (Fault::case_file) that shows the expression and says what is wrong with it
  Expression(const std::string& text, std::span<const std::string> known);

  /// Names that occur, as positions in `known`, each once.
  [[nodiscard]] const std::vector<std::size_t>& used() const { return used_; }

  /// What is wrong with a text whatever names there will be; empty: nothing. Words with blanks
  /// between them are taken for one name.
  [[nodiscard]] static std::string mistake_in(const std::string& text);
  /// As before, where the columns of history.csv are known; numbers of summary.json are not, and
  /// any name that begins with `summary.` is taken for one.
  [[nodiscard]] static std::string mistake_in(const std::string& text,
                                              std::span<const std::string> columns);

  /// @param values  of the names that occur, shape (used().size())
  [[nodiscard]] double operator()(std::span<const double> values) const;

private:
  std::string text_;       ///< as given
  std::string translated_; ///< with names that muParser knows: v0, v1, ...
  std::vector<std::size_t> used_;
};

} // namespace billet::study
