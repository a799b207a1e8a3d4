#include "io/case/read_law.h"
#include "io/case/read_parts.h"
#include "io/case/setting_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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
      at.complain(fmt::format("found {} after {}, allowed are increasing numbers", (*axis)[i],
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
  if (at.node.as<List>() != nullptr) {
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
  table.finish();
  if (sizes.empty()) {
    at.complain("needs an axis: 'pressure', 'speed' or 'sliding'");
    return std::nullopt;
  }
  if (!values || !add_values(*values, sizes, result.values))
    return std::nullopt;
  return result;
}

/// 'real_contact', and 'f' where that asks for it.
void read_real_contact(TableReader& table, RealContact& real_contact, double& f) {
  table.optional("real_contact", real_contact,
                 [](const At& at) { return as_word(at, real_contacts); });
  if (real_contact == RealContact::wanheim_bay)
    table.required("f", f, as_number, fraction_number);
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

/// The largest coefficient of a table, or the one that stands in its place.
double most_coefficient(const Friction& friction, double alone) {
  const std::vector<double>& values = friction.table.values;
  return values.empty() ? alone : *std::max_element(values.begin(), values.end());
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

/// No modifier asks for more shear than the metal carries.
void refuse_beyond_strength(TableReader& table, const Friction& friction) {
  // A number for k may be that of a film: no more is known of it.
  const auto is_of_metal = [](const ShearStrength& k) {
    return !std::holds_alternative<double>(k);
  };
  double share = 0.0; // of k, at most
  if (const auto* const tresca = std::get_if<TrescaFriction>(&friction.law))
    share = is_of_metal(tresca->k) ? most_coefficient(friction, tresca->m) : 0.0;
  else if (const auto* const asperity = std::get_if<AsperityFriction>(&friction.law))
    share = is_of_metal(asperity->k) ? most_coefficient(friction, asperity->m_local) : 0.0;
  else if (const auto* const shaw = std::get_if<ShawFriction>(&friction.law))
    share = is_of_metal(shaw->k) ? 1.0 : 0.0;
  else if (const auto* const coulomb = std::get_if<CoulombFriction>(&friction.law))
    share = coulomb->cap && is_of_metal(*coulomb->cap) ? 1.0 : 0.0;
  constexpr double rounding = 1e-12;
  const bool is_capped = std::holds_alternative<CoulombFriction>(friction.law); // after the factor
  const double factor = is_capped ? 1.0 : most_factor(friction);
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
  const bool has_coefficient = std::holds_alternative<CoulombFriction>(law) ||
                               std::holds_alternative<TrescaFriction>(law) ||
                               std::holds_alternative<AsperityFriction>(law);
  if (!has_coefficient)
    refuse("table", "the law has no coefficient in whose place it could stand; 'mu', 'm' and "
                    "'m_local' are coefficients");
  if (table.find("table"))
    refuse("mu2", "does not go together with 'table', which holds the whole coefficient");
  if (std::holds_alternative<TrescaFriction>(law) || std::holds_alternative<AsperityFriction>(law))
    for (const double value : friction.table.values)
      if (value > 1.0) {
        refuse("table",
               fmt::format("found {}, but m and m_local are shares of k: at most 1", value));
        break;
      }
  if (std::holds_alternative<FrictionlessFriction>(law) ||
      std::holds_alternative<StickingFriction>(law))
    for (const std::string_view key : {"tensor", "direction", "evolution"})
      refuse(key, "the law has nothing that it could change");
}

} // namespace

void read_more(TableReader& table, CoulombFriction& law) {
  table.optional("cap", law.cap, as_shear_strength);
}

void read_more(TableReader& table, TrescaFriction& law) {
  table.optional("k", law.k, as_shear_strength);
}

void read_more(TableReader& table, ShawFriction& law) {
  table.required("k", law.k, as_shear_strength);
  read_real_contact(table, law.real_contact, law.f);
}

void read_more(TableReader& table, AsperityFriction& law) {
  table.required("k", law.k, as_shear_strength);
  read_real_contact(table, law.real_contact, law.f);
}

std::optional<Friction> as_friction(const At& at) {
  if (at.node.as<Table>() == nullptr) {
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
