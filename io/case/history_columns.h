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

/// After those of the tools, where the case has `contact.trapped`: number of pockets, their volume,
/// and the highest pressure in them.
inline constexpr std::array<std::string_view, 3> trapped_columns{
    "trapped.pockets", "trapped.volume", "trapped.pressure"};

} // namespace billet::io
