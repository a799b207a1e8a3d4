// The columns that history.csv has in every run, before those of tools and measures.

#pragma once

#include <array>
#include <string_view>

namespace billet::io {

inline constexpr std::array<std::string_view, 17> fixed_columns{"increment",
                                                                "time",
                                                                "dt",
                                                                "iterations",
                                                                "residual",
                                                                "cutbacks",
                                                                "volume",
                                                                "max_penetration",
                                                                "contact_area",
                                                                "plastic_work",
                                                                "external_work",
                                                                "friction_work",
                                                                "elastic_energy",
                                                                "max_plastic_strain",
                                                                "min_quality",
                                                                "remeshings",
                                                                "wall_time"};

} // namespace billet::io
