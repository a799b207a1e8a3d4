// The columns of history.csv: those of every run, then those of tools, of supports with a name, of
// what is trapped and of measures.

#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

struct Case;

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

/// What the columns of a run are named after.
struct NamesOfHistory {
  std::vector<std::string> tools;
  std::vector<std::string> supports; ///< each once
  std::vector<std::string> measures;
  bool has_trapped;
};

/// All of them in their order.
[[nodiscard]] std::vector<std::string> history_columns(const NamesOfHistory& names);

/// Those that a run of a case will have.
[[nodiscard]] std::vector<std::string> history_columns(const Case& content);

} // namespace billet::io
