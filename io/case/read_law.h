// Reads "law = NAME" and the parameters of that law into a variant of laws.
//
// Everything goes by the list `parameters` of each law (geometry/base/parameter.h). A parameter
// whose member is of a new type asks for one more `read_value`.

#pragma once

#include "io/case/values.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace billet::io {

// Read one value. False: it cannot be read (complained).
[[nodiscard]] bool read_value(const At& at, const Number& kind, double& into);
[[nodiscard]] bool
read_value(const At& at, const Number& kind, std::vector<std::pair<double, double>>& into);
[[nodiscard]] bool read_value(const At& at, const Number& kind, mechanics::AnyStaticLaw& into);
[[nodiscard]] bool read_value(const At& at, const Number& kind, contact::ShearYieldStress& into);
[[nodiscard]] bool
read_value(const At& at, const Number& kind, std::optional<contact::ShearYieldStress>& into);
[[nodiscard]] bool read_value(const At& at, const Number& kind, contact::Flattening& into);

/// "WORDS NUMBER".
[[nodiscard]] std::string with_number(std::string_view words, double number);

/// Reads the parameters of one law.
template <class Law> class LawReader {
public:
  explicit LawReader(TableReader& table) : table_(table) {}

  [[nodiscard]] Law read() {
    for_each([&](const auto& parameter) { read(parameter); });
    for_each([&](const auto& parameter) { compare(parameter); });
    return std::move(law_);
  }

private:
  template <class Use> static void for_each(const Use& use) {
    std::apply([&](const auto&... parameters) { (use(parameters), ...); }, Law::parameters);
  }

  template <class Value> void read(const Parameter<Law, Value>& parameter) {
    if (parameter.is_coefficient && table_.has("table"))
      return stand_in(parameter);
    const std::optional<At> at = parameter.presence == Presence::required
                                     ? table_.require(parameter.key)
                                     : table_.find(parameter.key);
    if (!at)
      return;
    const auto parse = [&](const At& value) {
      return read_value(value, {parameter.measured, parameter.bounds}, law_.*parameter.member);
    };
    if (read_value_of(*at, parse))
      return;
    unread_.push_back(parameter.key);
  }

  template <class Value, class Choice>
  void read(const ConditionalParameter<Law, Value, Choice>& conditional) {
    if (conditional.counts(law_))
      read(conditional.parameter);
  }

  /// A table holds the whole coefficient.
  template <class Value> void stand_in(const Parameter<Law, Value>& parameter) {
    if (const std::optional<At> at = table_.find(parameter.key))
      at->complain("'table' stands in its place: give one of the two");
    if constexpr (std::same_as<Value, double>)
      law_.*parameter.member = 1.0;
  }

  /// Complains of a number that is too small compared with another one, if both are numbers at all.
  template <class Value> void compare(const Parameter<Law, Value>& parameter) {
    if constexpr (std::same_as<Value, double>) {
      const LowerLimit<Law>& above = parameter.above;
      const std::optional<At> at = table_.find(parameter.key);
      if (above.member == nullptr || !at || !is_known(parameter.member) || !is_known(above.member))
        return;
      const double least = law_.*above.member, value = law_.*parameter.member;
      if (above.is_open ? value <= least : value < least)
        at->complain_found(with_number(above.words, least));
    }
  }

  template <class Value, class Choice>
  void compare(const ConditionalParameter<Law, Value, Choice>& conditional) {
    if (conditional.counts(law_))
      compare(conditional.parameter);
  }

  /// Whether a number has been given as it may be, or has its default.
  [[nodiscard]] bool is_known(double Law::*member) {
    bool known = false;
    for_each([&]<class One>(const One& parameter) {
      if constexpr (std::same_as<One, Parameter<Law>>)
        if (parameter.member == member)
          known = std::find(unread_.begin(), unread_.end(), parameter.key) == unread_.end() &&
                  (parameter.presence != Presence::required || table_.find(parameter.key));
    });
    return known;
  }

  TableReader& table_;
  Law law_{};
  std::vector<std::string_view> unread_; ///< given, but not as they may be
};

/// The laws of a variant by name.
template <class AnyLaw> struct LawReaders;

template <class... Laws> struct LawReaders<std::variant<Laws...>> {
  using Any = std::variant<Laws...>;
  using Reader = Any (*)(TableReader&);
  template <class Law> static Any read(TableReader& table) { return LawReader<Law>(table).read(); }
  static constexpr std::array<Word<Reader>, sizeof...(Laws)> words{
      Word<Reader>{Laws::name, &read<Laws>}...};
};

/// Reads the key "law" and the keys of that law. False: there is no such law (complained).
template <class AnyLaw> bool read_law(TableReader& table, AnyLaw& into) {
  typename LawReaders<AnyLaw>::Reader reader = nullptr;
  const auto parse = [](const At& at) { return as_choice(at, LawReaders<AnyLaw>::words); };
  if (!table.required("law", reader, parse))
    return false;
  into = reader(table);
  return true;
}

} // namespace billet::io
