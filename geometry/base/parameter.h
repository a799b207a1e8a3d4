// What a law asks for, said once.
//
// A law (flow stress, friction) is a small value type. Its tuple `parameters` gives of each member
// the key in case files, what it measures, what is allowed, and whether it may be left out, as in
//
//   static constexpr std::tuple parameters{
//       Parameter{"yield", &Voce::yield, quantity::stress, allowed::positive},
//       Parameter{"saturation", &Voce::saturation, quantity::stress,
//       allowed::positive}.no_less_than(
//           &Voce::yield, "no less than the yield stress"),
//       ...
//
// Reading, checks, the echo in case.resolved.toml and the test of the user's guide go by it
// (io/case/read_law.h, write_law.h). The order is that of the echo. The initial value of a member
// is its default.

#pragma once

#include "geometry/base/limits.h"
#include "geometry/base/quantity.h"

#include <string_view>

namespace billet {

/// Admissible values: low <= v <= high, without the ends where these are open.
struct Bounds {
  double low = -infinity;
  double high = infinity;
  bool low_open = false;
  bool high_open = false;

  [[nodiscard]] constexpr bool admit(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
};

/// The bounds that occur often.
namespace allowed {

inline constexpr Bounds any_value{};
inline constexpr Bounds positive{0.0, infinity, true, false};
inline constexpr Bounds not_negative{0.0};
inline constexpr Bounds fraction{0.0, 1.0};
inline constexpr Bounds positive_fraction{0.0, 1.0, true, false};
inline constexpr Bounds above_absolute_zero{-273.15};

} // namespace allowed

/// Whether a parameter must be given.
enum class Presence {
  required,
  optional, ///< it has a default like any other value
  absent,   ///< with its default what it stands for is not there at all: it is not echoed then
};

/// A member of a law that another one limits from below.
template <class Law> struct LowerLimit {
  double Law::*member = nullptr; ///< null: there is none
  bool is_open = false;          ///< the value itself is not allowed
  std::string_view words;        ///< what is allowed: "more than T_room ="
};

/// One parameter of a law.
template <class Law, class Value = double> struct Parameter {
  std::string_view key;
  Value Law::*member;
  Quantity measured = quantity::number; ///< of a curve [[x, y], ...]: y; x is a number >= 0
  Bounds bounds = allowed::any_value;
  Presence presence = Presence::required;
  LowerLimit<Law> above = {};
  bool is_coefficient = false; ///< of friction: a 'table' may stand in its place

  [[nodiscard]] constexpr Parameter optional() const {
    Parameter changed = *this;
    changed.presence = Presence::optional;
    return changed;
  }

  [[nodiscard]] constexpr Parameter or_absent() const {
    Parameter changed = *this;
    changed.presence = Presence::absent;
    return changed;
  }

  [[nodiscard]] constexpr Parameter coefficient() const {
    Parameter changed = *this;
    changed.is_coefficient = true;
    return changed;
  }

  /// `words` begin the list of what is allowed, before the number: "no less than the yield stress".
  [[nodiscard]] constexpr Parameter no_less_than(double Law::*other, std::string_view words) const {
    Parameter changed = *this;
    changed.above = {other, false, words};
    return changed;
  }

  /// `words` as above: "more than T_room =".
  [[nodiscard]] constexpr Parameter more_than(double Law::*other, std::string_view words) const {
    Parameter changed = *this;
    changed.above = {other, true, words};
    return changed;
  }
};

template <class Law, class Value, class... Rest>
Parameter(std::string_view, Value Law::*, Rest...) -> Parameter<Law, Value>;

/// A parameter that only counts where another member has a certain value.
template <class Law, class Value, class Choice> struct ConditionalParameter {
  Parameter<Law, Value> parameter;
  Choice Law::*member;
  Choice value;

  [[nodiscard]] constexpr bool counts(const Law& law) const { return law.*member == value; }
};

template <class Law, class Value, class Choice>
[[nodiscard]] constexpr ConditionalParameter<Law, Value, Choice>
only_with(Choice Law::*member, Choice value, const Parameter<Law, Value>& parameter) {
  return {parameter, member, value};
}

} // namespace billet
