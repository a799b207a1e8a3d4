// The words of the case file for the enumerators of Case, for reading and for writing.

#pragma once

#include "io/case/values.h"

#include <array>

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
    Word<ContactIntegrator>{"midpoint", ContactIntegrator::midpoint}};
inline constexpr std::array linear_solvers{
    Word<LinearSolverChoice>{"auto", LinearSolverChoice::automatic},
    Word<LinearSolverChoice>{"cholmod", LinearSolverChoice::cholmod},
    Word<LinearSolverChoice>{"mumps", LinearSolverChoice::mumps},
    Word<LinearSolverChoice>{"umfpack", LinearSolverChoice::umfpack}};
inline constexpr std::array accuracies{Word<Accuracy>{"draft", Accuracy::draft},
                                       Word<Accuracy>{"standard", Accuracy::standard},
                                       Word<Accuracy>{"fine", Accuracy::fine}};
inline constexpr std::array field_sets{Word<FieldSet>{"default", FieldSet::standard},
                                       Word<FieldSet>{"all", FieldSet::all}};

} // namespace billet::io
