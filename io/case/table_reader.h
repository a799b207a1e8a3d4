// Reads the keys of one table and complains about everything that is wrong with them.
//
// A reader remembers which keys it was asked for: what is left over in the end is unknown. Nothing
// is thrown: a value that cannot be read leaves the target as it is and adds a complaint, so that
// all errors of a file are reported together.

#pragma once

#include "io/case/case.h"
#include "io/case/document.h"
#include "io/case/inquiry.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace billet::io {

/// What all readers of a file share.
struct ReadContext {
  Complaints& complaints;
  UnitSystem units;
  std::optional<Analysis> analysis; ///< none: not known (already complained about)
  std::filesystem::path directory;  ///< of the case file
  bool allow_outside = false;

  [[nodiscard]] bool in_plane() const { return analysis && *analysis != Analysis::solid; }
  [[nodiscard]] bool in_space() const { return analysis == Analysis::solid; }
};

/// A node to be read, with its dotted path for messages.
struct At {
  const Node& node;
  std::string path;
  ReadContext& context;

  /// Complains "PATH: MESSAGE" at the node's place.
  void complain(const std::string& message,
                const std::string& remedy = {},
                std::string_view code = error_code::case_refused) const;
  /// Complains about the value of this one key.
  void refuse(const std::string& message, const std::string& remedy = {}) const {
    complain(message, remedy, error_code::value_refused);
  }
  /// Complains "PATH: found VALUE, allowed is ALLOWED".
  void complain_found(const std::string& allowed, const std::string& remedy = {}) const;
  /// Where the node stands, for messages: "case.toml:12:9".
  [[nodiscard]] std::string place() const { return context.complaints.text(node.place); }
  /// The i-th item of a list.
  [[nodiscard]] At item(const Node& item_node, std::size_t i) const;

  /// What asks the reader, if it stands in place of the value.
  [[nodiscard]] Inquiry* inquiry() const {
    Inquiry* const* const inquiry = node.as<Inquiry*>();
    return inquiry != nullptr ? *inquiry : nullptr;
  }
  /// Tells an inquiry what is expected. False: this is a value.
  template <class... Alternatives> bool expect(Alternatives... alternatives) const {
    if (Inquiry* const asking = inquiry())
      (asking->expect(std::move(alternatives)), ...);
    return inquiry() != nullptr;
  }
  /// Whether the value is a table, where nothing else is allowed.
  [[nodiscard]] bool is_table() const {
    return inquiry() != nullptr || node.as<Table>() != nullptr;
  }
  /// Whether the value is a T, where other types are allowed as well.
  template <class T> [[nodiscard]] bool is_a() const {
    static const std::array<std::string, 2> both{"one type", "another"};
    return inquiry() != nullptr ? inquiry()->choose(both) == 0 : node.as<T>() != nullptr;
  }
  /// The items of a list, where nothing else is allowed; null: it is none.
  ///
  /// @param least  the fewest that are allowed, which the caller checks
  [[nodiscard]] const List* list(std::size_t least = 0) const;
};

/// Reads a value: parse(at, spec...). An inquiry is read once for each way that the reader may go.
template <class Parse, class... Spec>
auto read_value_of(const At& at, const Parse& parse, const Spec&... spec) {
  Inquiry* const inquiry = at.inquiry();
  if (inquiry == nullptr)
    return parse(at, spec...);
  inquiry->begin();
  auto value = parse(at, spec...);
  while (inquiry->next())
    value = parse(at, spec...);
  return value;
}

/// The keys of one table.
class TableReader {
public:
  /// Reads `at`; complains when it is no table, and is empty then.
  explicit TableReader(At at);

  [[nodiscard]] const At& at() const { return at_; }
  [[nodiscard]] ReadContext& context() const { return at_.context; }
  /// Whether the node was a table at all.
  [[nodiscard]] bool is_table() const { return at_.is_table(); }

  /// Whether a key is there, where the other keys depend on it.
  [[nodiscard]] bool has(std::string_view key);

  /// The value of a key, if it is there.
  [[nodiscard]] std::optional<At> find(std::string_view key);
  /// The value of a key; complains if it is not there.
  [[nodiscard]] std::optional<At> require(std::string_view key);
  /// The table of a key, if it is there.
  [[nodiscard]] std::optional<TableReader> find_table(std::string_view key);
  /// The table of a key; complains if it is not there.
  [[nodiscard]] std::optional<TableReader> require_table(std::string_view key);

  /// Reads a key that may be absent: into = parse(at, spec...). True when it was read.
  template <class Into, class Parse, class... Spec>
  bool optional(std::string_view key, Into& into, Parse parse, const Spec&... spec) {
    const std::optional<At> at = find(key);
    note_initial(key, into);
    return assign(at, into, parse, spec...);
  }

  /// Reads a key that must be there: into = parse(at, spec...). True when it was read.
  template <class Into, class Parse, class... Spec>
  bool required(std::string_view key, Into& into, Parse parse, const Spec&... spec) {
    return assign(require(key), into, parse, spec...);
  }

  /// The keys and values of a table whose keys are names given by the user; all count as known.
  [[nodiscard]] std::vector<std::pair<std::string, At>> named_items();

  /// Keys that were asked for so far.
  [[nodiscard]] const std::vector<std::string>& known_keys() const { return known_; }
  /// Keys of the table that nobody asked for so far.
  [[nodiscard]] std::vector<std::string> unknown_keys() const;
  /// Complains about the keys nobody asked for. To be called once, last. A key that is missing and
  /// one that is written in its place are one mistake, and one complaint.
  void finish();

private:
  template <class Into, class Parse, class... Spec>
  static bool
  assign(const std::optional<At>& at, Into& into, const Parse& parse, const Spec&... spec) {
    if (!at)
      return false;
    auto value = read_value_of(*at, parse, spec...);
    if (!value)
      return false;
    into = std::move(*value);
    return true;
  }

  /// Tells an inquiry the default of a key.
  template <class Into> void note_initial(std::string_view key, const Into& into) const {
    if constexpr (std::is_same_v<Into, bool>) {
      if (at_.inquiry() != nullptr)
        at_.inquiry()->set_initial(key, into ? "true" : "false");
    } else if constexpr (std::is_arithmetic_v<Into>) {
      if (at_.inquiry() != nullptr && into != 0 && std::isfinite(static_cast<double>(into)))
        note_initial_number(key, static_cast<double>(into));
    }
  }
  void note_initial_number(std::string_view key, double value) const;

  /// A key that must be there and is not.
  struct Missing {
    std::string key;
    std::size_t complaint;
  };

  [[nodiscard]] bool is_known(const std::string& key) const;
  /// Withdraws the complaint of a missing key. False: it is not missing.
  bool resolve_missing(const std::string& key);
  /// What is said of an unknown key.
  [[nodiscard]] std::string remedy_for(const std::string& key, std::size_t n_unknown);

  At at_;
  const Table* table_;
  std::vector<std::string> known_;
  std::vector<Missing> missing_;
};

} // namespace billet::io
