// The words of the case file for the enumerators of Case, for reading and for writing.

#pragma once

#include "io/case/toml_text.h"
#include "io/case/values.h"

#include <algorithm>
#include <array>
#include <string>

namespace billet::io {

inline constexpr std::array analyses{Word<Analysis>{"plane-strain", Analysis::plane_strain},
                                     Word<Analysis>{"axisymmetric", Analysis::axisymmetric},
                                     Word<Analysis>{"3d", Analysis::solid}};
inline constexpr std::array contact_forms{Word<ContactForm>{"mixed", ContactForm::mixed},
                                          Word<ContactForm>{"compatible", ContactForm::compatible}};
inline constexpr std::array contact_methods{
    Word<ContactMethod>{"penalty", ContactMethod::penalty},
    Word<ContactMethod>{"augmented", ContactMethod::augmented}};
inline constexpr std::array contact_integrators{
    Word<ContactIntegrator>{"radial", ContactIntegrator::radial},
    Word<ContactIntegrator>{"midpoint", ContactIntegrator::midpoint},
    Word<ContactIntegrator>{"exact", ContactIntegrator::exact}};
inline constexpr std::array real_contacts{
    Word<contact::Flattening>{"wanheim-bay", contact::Flattening::wanheim_bay},
    Word<contact::Flattening>{"bowden-tabor", contact::Flattening::bowden_tabor}};
inline constexpr std::array linear_solvers{
    Word<mechanics::SolverChoice>{"auto", mechanics::SolverChoice::automatic},
    Word<mechanics::SolverChoice>{"cholmod", mechanics::SolverChoice::cholmod},
    Word<mechanics::SolverChoice>{"mumps", mechanics::SolverChoice::mumps},
    Word<mechanics::SolverChoice>{"umfpack", mechanics::SolverChoice::umfpack},
    Word<mechanics::SolverChoice>{"multigrid", mechanics::SolverChoice::multigrid},
    Word<mechanics::SolverChoice>{"superlu-dist", mechanics::SolverChoice::superlu_dist}};
inline constexpr std::array accuracies{Word<Accuracy>{"draft", Accuracy::draft},
                                       Word<Accuracy>{"standard", Accuracy::standard},
                                       Word<Accuracy>{"fine", Accuracy::fine}};
inline constexpr std::array measure_kinds{
    Word<process::Measure::Kind>{"equator-radius", process::Measure::Kind::equator_radius},
    Word<process::Measure::Kind>{"contact-radius", process::Measure::Kind::contact_radius},
    Word<process::Measure::Kind>{"barrelling", process::Measure::Kind::barrelling},
    Word<process::Measure::Kind>{"bore", process::Measure::Kind::bore},
    Word<process::Measure::Kind>{"height", process::Measure::Kind::height},
    Word<process::Measure::Kind>{"reach", process::Measure::Kind::reach},
    Word<process::Measure::Kind>{"filling", process::Measure::Kind::filling}};
inline constexpr std::array field_sets{Word<FieldSet>{"default", FieldSet::standard},
                                       Word<FieldSet>{"all", FieldSet::all}};

/// The word of an enumerator, in quotes.
template <class Value, std::size_t N>
std::string word_text(const Value& value, const std::array<Word<Value>, N>& words) {
  const auto* const found = std::find_if(words.begin(), words.end(),
                                         [&](const auto& word) { return word.value == value; });
  return toml_text(found->word);
}

} // namespace billet::io
