#include "io/case/read_law.h"

#include "io/case/setting_words.h"

#include <fmt/format.h>

namespace billet::io {

namespace {

template <class Value, class Into> bool assign(const std::optional<Value>& value, Into& into) {
  if (value)
    into = *value;
  return value.has_value();
}

} // namespace

std::string with_number(std::string_view words, double number) {
  return fmt::format("{} {}", words, number);
}

bool read_value(const At& at, const Number& kind, double& into) {
  return assign(as_number(at, kind), into);
}

bool read_value(const At& at, const Number& kind, std::vector<std::pair<double, double>>& into) {
  return assign(as_pairs(at, not_negative_number, kind), into);
}

bool read_value(const At& at, const Number& /*kind*/, mechanics::AnyStaticLaw& into) {
  TableReader table(at);
  const bool is_law = table.is_table() && read_law(table, into);
  if (is_law)
    table.finish();
  return is_law;
}

bool read_value(const At& at, const Number& kind, contact::ShearYieldStress& into) {
  return assign(as_shear_strength(at, kind), into);
}

bool read_value(const At& at, const Number& kind, std::optional<contact::ShearYieldStress>& into) {
  return assign(as_shear_strength(at, kind), into);
}

bool read_value(const At& at, const Number& /*kind*/, contact::Flattening& into) {
  return assign(as_choice(at, real_contacts), into);
}

} // namespace billet::io
