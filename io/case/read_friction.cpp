#include "io/case/read_law.h"
#include "io/case/read_parts.h"
#include "io/case/setting_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

namespace billet::io {

namespace {

using Tensor = std::array<std::array<double, 2>, 2>;

/// Sliding against the shear must cost work in every direction.
bool dissipates(const Tensor& q) {
  const double off = 0.5 * (q[0][1] + q[1][0]);
  return q[0][0] > 0.0 && q[0][0] * q[1][1] > off * off;
}

std::optional<Tensor> as_tensor(const At& at) {
  const List* const rows = as_list(at, 2, "2 rows [[q11, q12], [q21, q22]]");
  if (rows == nullptr)
    return std::nullopt;
  Tensor tensor{};
  for (std::size_t i = 0; i < 2; ++i) {
    const At row_at = at.item((*rows)[i], i);
    const List* const row = as_list(row_at, 2, "2 numbers");
    if (row == nullptr)
      return std::nullopt;
    for (std::size_t j = 0; j < 2; ++j) {
      const std::optional<double> entry = as_number(row_at.item((*row)[j], j), {});
      if (!entry)
        return std::nullopt;
      tensor[i][j] = *entry;
    }
  }
  if (!dissipates(tensor)) {
    at.complain("friction would drive the slide in some direction: the symmetric part of the "
                "tensor must be positive definite");
    return std::nullopt;
  }
  return tensor;
}

/// Increasing numbers, at least two.
std::optional<std::vector<double>> as_grid_axis(const At& at, const Number& kind) {
  std::optional<std::vector<double>> axis = as_numbers(at, kind);
  if (!axis)
    return std::nullopt;
  if (axis->size() < 2) {
    at.complain_found("at least 2 numbers (leave the axis out where it does not matter)");
    return std::nullopt;
  }
  for (std::size_t i = 1; i < axis->size(); ++i)
    if (!((*axis)[i] > (*axis)[i - 1])) {
      at.refuse(fmt::format("found {} after {}, allowed are increasing numbers", (*axis)[i],
                            (*axis)[i - 1]));
      return std::nullopt;
    }
  return axis;
}

/// Values of a grid: lists within lists, one level for each axis.
bool add_values(const At& at, std::span<const std::size_t> sizes, std::vector<double>& values) {
  if (sizes.empty()) {
    const std::optional<double> value = as_number(at, not_negative_number);
    if (value)
      values.push_back(*value);
    return value.has_value();
  }
  const List* const list = as_list(
      at, sizes.front(), fmt::format("{} entries, one for each point of its axis", sizes.front()));
  if (list == nullptr)
    return false;
  for (std::size_t i = 0; i < list->size(); ++i)
    if (!add_values(at.item((*list)[i], i), sizes.subspan(1), values))
      return false;
  return true;
}

/// [[pressure, coefficient], ...], or a grid over pressure, speed and sliding distance.
std::optional<FrictionTable> as_friction_table(const At& at) {
  FrictionTable result;
  if (at.is_a<List>()) {
    const auto pairs = as_pairs(at, not_negative_stress, not_negative_number);
    if (!pairs)
      return std::nullopt;
    for (const auto& [pressure, value] : *pairs) {
      result.pressure.push_back(pressure);
      result.values.push_back(value);
    }
    return result;
  }
  TableReader table(at);
  if (!table.is_table())
    return std::nullopt;
  table.optional("pressure", result.pressure, as_grid_axis, not_negative_stress);
  table.optional("speed", result.speed, as_grid_axis, Number{quantity::speed, not_negative});
  table.optional("sliding", result.sliding, as_grid_axis, Number{quantity::length, not_negative});
  std::vector<std::size_t> sizes;
  for (const std::vector<double>* axis : {&result.pressure, &result.speed, &result.sliding})
    if (!axis->empty())
      sizes.push_back(axis->size());
  const std::optional<At> values = table.require("values");
  if (values && values->expect(AnyShape{"numbers in lists within lists, one level for each axis"}))
    return result;
  table.finish();
  if (sizes.empty()) {
    at.complain("needs an axis: 'pressure', 'speed' or 'sliding'");
    return std::nullopt;
  }
  if (!values || !add_values(*values, sizes, result.values))
    return std::nullopt;
  return result;
}

/// A coefficient of a law: what a table may stand in place of.
struct Coefficient {
  std::string_view key;
  double most; ///< that is allowed
};

/// A coefficient that has a largest value is a share of the metal's k.
bool is_share(const Coefficient& coefficient) { return std::isfinite(coefficient.most); }

template <class Parameter>
void add_coefficient(const Parameter& parameter, std::optional<Coefficient>& into) {
  if constexpr (requires { parameter.is_coefficient; })
    if (parameter.is_coefficient)
      into = Coefficient{parameter.key, parameter.bounds.high};
}

template <contact::FrictionLaw Law> std::optional<Coefficient> coefficient_of(const Law& /*law*/) {
  std::optional<Coefficient> found;
  std::apply([&](const auto&... parameters) { (add_coefficient(parameters, found), ...); },
             Law::parameters);
  return found;
}

std::optional<Coefficient> coefficient_of(const FrictionLaw& any) {
  return std::visit([](const auto& law) { return coefficient_of(law); }, any);
}

std::size_t n_parameters(const FrictionLaw& any) {
  return std::visit(
      []<class Law>(const Law&) { return std::tuple_size_v<decltype(Law::parameters)>; }, any);
}

template <class... Laws>
std::vector<std::optional<Coefficient>> coefficients(const std::variant<Laws...>* /*any*/) {
  return {coefficient_of(Laws{})...};
}

/// The keys of those coefficients that do, once each: "'mu', 'm' and 'm_local'".
template <class Does> std::string keys_of_coefficients(std::string_view quote, const Does& does) {
  std::vector<std::string> keys;
  for (const std::optional<Coefficient>& one :
       coefficients(static_cast<const FrictionLaw*>(nullptr))) {
    if (!one || !does(*one))
      continue;
    const std::string key = fmt::format("{0}{1}{0}", quote, one->key);
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      keys.push_back(key);
  }
  const std::string last = keys.back();
  keys.pop_back();
  return fmt::format("{} and {}", fmt::join(keys, ", "), last);
}

/// The largest factor by which an evolution multiplies a law's shear.
double most_factor(const Friction& friction) {
  if (friction.evolution.empty())
    return 1.0;
  double most = 0.0;
  for (const auto& [sliding, factor] : friction.evolution)
    most = std::max(most, factor);
  return most;
}

/// The largest coefficient of a table, or the factor 1 on that of the law.
double most_of_table(const Friction& friction) {
  const std::vector<double>& values = friction.table.values;
  return values.empty() ? 1.0 : *std::max_element(values.begin(), values.end());
}

/// The largest share of the law's shear that slides of any direction meet.
double most_of_tensor(const Friction& friction) {
  if (!friction.tensor)
    return 1.0;
  const auto& Q = *friction.tensor;
  // The larger singular value of a matrix of two by two.
  const double sum = Q[0][0] * Q[0][0] + Q[0][1] * Q[0][1] + Q[1][0] * Q[1][0] + Q[1][1] * Q[1][1];
  const double det = Q[0][0] * Q[1][1] - Q[0][1] * Q[1][0];
  return std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * det * det))));
}

/// The largest share of the metal's k that a law carries, its coefficient times a factor; 0 where
/// it knows another strength, or none: a number for k may be that of a film, no more is known of
/// it.
double most_share(const FrictionLaw& law, double factor) {
  constexpr double k = 1.0, enormous = 1e100; // of k
  return follows_material(law) ? slip_limit(law, {enormous, k, 0.0, factor}).shear : 0.0;
}

/// No modifier asks for more shear than the metal carries.
void refuse_beyond_strength(TableReader& table, const Friction& friction) {
  const double share = most_share(friction.law, most_of_table(friction));
  if (!(share > 0.0))
    return;
  constexpr double rounding = 1e-12;
  // A cap holds after the factor.
  const double factor =
      most_share(friction.law, most_of_table(friction) * most_factor(friction)) / share;
  const double most = share * factor * most_of_tensor(friction);
  if (!(most > 1.0 + rounding))
    return;
  const std::optional<At> evolution = table.find("evolution"), tensor = table.find("tensor");
  if (evolution && factor > 1.0)
    evolution->complain(fmt::format("its largest factor takes the shear to {:.4g} k, more than "
                                    "the metal carries",
                                    most),
                        fmt::format("give factors of {:.4g} at most", factor / most));
  else if (tensor)
    tensor->complain(fmt::format("it takes the shear to {:.4g} k in one direction, more than the "
                                 "metal carries",
                                 most),
                     fmt::format("divide it by {:.4g}; the coefficient times that gives the same "
                                 "below the metal's strength",
                                 most));
}

/// Modifiers that a law has no use for would silently do nothing; shares of k end at 1.
void refuse_unfit(TableReader& table, const Friction& friction) {
  const FrictionLaw& law = friction.law;
  const auto refuse = [&](std::string_view key, std::string_view why) {
    if (const std::optional<At> at = table.find(key))
      at->complain(std::string(why));
  };
  const std::optional<Coefficient> coefficient = coefficient_of(law);
  if (!coefficient)
    refuse("table",
           fmt::format("the law has no coefficient in whose place it could stand; {} are "
                       "coefficients",
                       keys_of_coefficients("'", [](const Coefficient&) { return true; })));
  if (table.find("table"))
    refuse("mu2", "does not go together with 'table', which holds the whole coefficient");
  if (coefficient && is_share(*coefficient))
    for (const double value : friction.table.values)
      if (value > coefficient->most) {
        refuse("table", fmt::format("found {}, but {} are shares of k: at most {}", value,
                                    keys_of_coefficients("", is_share), coefficient->most));
        break;
      }
  if (n_parameters(law) == 0)
    for (const std::string_view key : {"tensor", "direction", "evolution"})
      refuse(key, "the law has nothing that it could change");
}

} // namespace

std::optional<Friction> as_friction(const At& at) {
  if (!at.is_table()) {
    at.complain_found("a table such as { law = \"coulomb\", mu = 0.1 }");
    return std::nullopt;
  }
  TableReader table(at);
  Friction friction;
  const bool has_law = read_law(table, friction.law);
  table.optional("tensor", friction.tensor, as_tensor);
  table.optional("direction", friction.direction, as_direction);
  table.optional("evolution", friction.evolution, as_pairs, Number{quantity::length, not_negative},
                 not_negative_number);
  table.optional("table", friction.table, as_friction_table);
  const std::optional<At> tensor = table.find("tensor");
  const std::optional<At> direction = table.find("direction");
  if (tensor && !direction)
    tensor->complain("needs 'direction', the first axis of the tensor");
  if (direction && !tensor)
    direction->complain("is the first axis of a 'tensor', which is missing");
  if (has_law) {
    refuse_unfit(table, friction);
    refuse_beyond_strength(table, friction);
    table.finish();
  }
  return friction;
}

} // namespace billet::io
