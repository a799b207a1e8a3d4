#include "io/deck/read_materials.h"

#include "geometry/base/error.h"
#include "io/deck/deck_names.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <array>

namespace billet::io {

bool DeckMaterials::take(const DeckKeyword& keyword) {
  struct Reader {
    const char* name;
    void (DeckMaterials::*read)(const DeckKeyword&);
  };
  static constexpr std::array readers{
      Reader{"MATERIAL", &DeckMaterials::material}, Reader{"ELASTIC", &DeckMaterials::elastic},
      Reader{"PLASTIC", &DeckMaterials::plastic},   Reader{"RATEDEPENDENT", &DeckMaterials::rate},
      Reader{"DENSITY", &DeckMaterials::density},
  };
  for (const Reader& reader : readers)
    if (keyword.name == reader.name) {
      if (current_ == nullptr && keyword.name != "MATERIAL")
        note(deck_, keyword, "before the first *MATERIAL, left out");
      else
        (this->*reader.read)(keyword);
      return true;
    }
  return false;
}

void DeckMaterials::material(const DeckKeyword& keyword) {
  current_ = &deck_.materials[in_capitals(keyword.value("NAME"))];
  current_->name = keyword.value("NAME");
}

void DeckMaterials::elastic(const DeckKeyword& keyword) {
  const std::string type = keyword.word("TYPE");
  if (!type.empty() && type != "ISO" && type != "ISOTROPIC")
    return note(deck_, keyword,
                fmt::format("TYPE={} is not available: elasticity is isotropic", type));
  const auto young = keyword.number(0, 0), poisson = keyword.number(0, 1);
  if (!young)
    return note(deck_, keyword, "without a modulus");
  current_->elastic = {*young, poisson.value_or(0.0)};
  if (keyword.data.size() > 1)
    note(deck_, keyword,
         fmt::format("the values of the first temperature are taken, {} more are left out",
                     keyword.data.size() - 1));
}

void DeckMaterials::plastic(const DeckKeyword& keyword) {
  const std::string hardening = keyword.word("HARDENING"), rate = keyword.value("RATE");
  if (current_->is_plastic())
    return note(deck_, keyword,
                rate.empty() ? "the material has one already, this one is left out"
                             : fmt::format("the first curve is taken for all rates, the one of "
                                           "RATE={} is left out",
                                           rate));
  if (hardening == "JOHNSONCOOK")
    return johnson_cook(keyword);
  const std::string data = keyword.word("DATATYPE");
  const bool is_curve = hardening == "KINEMATIC" ||
                        (hardening == "COMBINED" && (data.empty() || data == "HALFCYCLE"));
  if (is_curve)
    note(deck_, keyword, fmt::format("HARDENING={} is taken as isotropic", hardening));
  else if (!hardening.empty() && hardening != "ISOTROPIC")
    return note(deck_, keyword,
                fmt::format("HARDENING={}{} is not available: the plasticity is left out",
                            hardening, data.empty() ? "" : " with DATA TYPE=" + data));
  if (!rate.empty() && keyword.data.size() > 0)
    note(deck_, keyword, fmt::format("the curve of RATE={} is taken for all rates", rate));
  curve(keyword);
}

void DeckMaterials::curve(const DeckKeyword& keyword) {
  const double temperature = keyword.number(0, 2).value_or(0.0);
  std::size_t n_others = 0, n_falling = 0;
  for (std::size_t line = 0; line < keyword.data.size(); ++line) {
    const auto stress = keyword.number(line, 0), strain = keyword.number(line, 1);
    if (!stress)
      throw Error(Fault::geometry, keyword.places[line], "the row has no stress",
                  "rows of *PLASTIC are stress, plastic strain, temperature");
    if (keyword.number(line, 2).value_or(0.0) != temperature)
      ++n_others;
    else if (auto& points = current_->plastic;
             points.empty() || strain.value_or(0.0) > points.back().first)
      points.emplace_back(strain.value_or(0.0), *stress);
    else if (n_falling++ == 0)
      deck_.remarks.push_back(
          {keyword.places[line],
           fmt::format("*{}: the strain {:g} is not above the one before, {:g}: rows of strains "
                       "that do not rise are left out",
                       keyword.written, strain.value_or(0.0), points.back().first)});
  }
  if (keyword.data.empty())
    note(deck_, keyword, "without a curve");
  if (n_others > 0)
    note(deck_, keyword,
         fmt::format("the curve of temperature {} is taken, {} rows of others are left out",
                     keyword.field(0, 2).empty() ? "0" : keyword.field(0, 2), n_others));
}

void DeckMaterials::johnson_cook(const DeckKeyword& keyword) {
  std::array<double, 4> constants{};
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const auto number = keyword.number(0, i);
    if (!number)
      return note(deck_, keyword,
                  "HARDENING=JOHNSON COOK needs A, B, n, m: the plasticity is left out");
    constants[i] = *number;
  }
  const auto& [A, B, n, m] = constants;
  const auto melting = keyword.number(0, 4), transition = keyword.number(0, 5);
  DeckJohnsonCook law{A, B, n, m, {}, {}, keyword.place};
  if (melting && *melting > transition.value_or(0.0))
    law.temperatures = {transition.value_or(0.0), *melting};
  else
    note(deck_, keyword,
         "HARDENING=JOHNSON COOK without a melting temperature above the transition temperature: "
         "the stress does not depend on the temperature");
  current_->johnson_cook = law;
}

void DeckMaterials::rate(const DeckKeyword& keyword) {
  const std::string type = keyword.word("TYPE");
  const auto C = keyword.number(0, 0), reference = keyword.number(0, 1);
  if (type != "JOHNSONCOOK" || !current_->johnson_cook || !C || !reference)
    return note(deck_, keyword,
                fmt::format("{}left out: the stress does not depend on the rate. It is understood "
                            "with TYPE=JOHNSON COOK after *PLASTIC, HARDENING=JOHNSON COOK, as C, "
                            "rate",
                            type.empty() ? "" : "TYPE=" + type + " is "));
  current_->johnson_cook->rate = {*C, *reference};
}

void DeckMaterials::density(const DeckKeyword& keyword) {
  current_->density = keyword.number(0, 0);
}

} // namespace billet::io
