// The keys of every law of a case file: name, unit, bounds, member.
//
// Reading, range checks and writing back all go by these lists. A law that is added needs a struct
// in case_workpiece.h or case_tool.h, its place in the variant there, and its list here. What is
// no number (tables, a law within a law, shear strengths) is read and written by the functions
// `read_more` and `write_more` for that law.

#pragma once

#include "io/case/values.h"

#include <array>
#include <string_view>

namespace billet::io {

/// One number of a law.
template <class Law> struct NumberKey {
  std::string_view key;
  double Law::*member;
  Number kind;
  bool is_required = true;     ///< false: the member's initial value is the default
  bool is_coefficient = false; ///< of friction: a 'table' may stand in its place
};

/// `name` of the law in the case file and its list `keys`.
template <class Law> struct LawKeys;

inline constexpr Number positive_number{quantity::number, positive};
inline constexpr Number not_negative_number{quantity::number, not_negative};
inline constexpr Number fraction_number{quantity::number, fraction};
inline constexpr Number positive_stress{quantity::stress, positive};
inline constexpr Number not_negative_stress{quantity::stress, not_negative};
inline constexpr Number any_length{quantity::length, any_value};
inline constexpr Number positive_length{quantity::length, positive};
inline constexpr Number positive_time{quantity::duration, positive};
inline constexpr Number not_negative_time{quantity::duration, not_negative};

template <> struct LawKeys<PerfectFlow> {
  using Key = NumberKey<PerfectFlow>;
  static constexpr std::string_view name = "perfect";
  static constexpr std::array keys{Key{"yield", &PerfectFlow::yield, positive_stress}};
};

template <> struct LawKeys<LinearFlow> {
  using Key = NumberKey<LinearFlow>;
  static constexpr std::string_view name = "linear";
  static constexpr std::array keys{
      Key{"yield", &LinearFlow::yield, positive_stress},
      Key{"hardening", &LinearFlow::hardening, not_negative_stress},
  };
};

template <> struct LawKeys<SwiftFlow> {
  using Key = NumberKey<SwiftFlow>;
  static constexpr std::string_view name = "swift";
  static constexpr std::array keys{
      Key{"K", &SwiftFlow::K, positive_stress},
      Key{"eps0", &SwiftFlow::eps0, positive_number},
      Key{"n", &SwiftFlow::n, not_negative_number},
  };
};

template <> struct LawKeys<LudwikFlow> {
  using Key = NumberKey<LudwikFlow>;
  static constexpr std::string_view name = "ludwik";
  static constexpr std::array keys{
      Key{"yield", &LudwikFlow::yield, positive_stress},
      Key{"K", &LudwikFlow::K, not_negative_stress},
      Key{"n", &LudwikFlow::n, positive_number},
  };
};

template <> struct LawKeys<VoceFlow> {
  using Key = NumberKey<VoceFlow>;
  static constexpr std::string_view name = "voce";
  static constexpr std::array keys{
      Key{"yield", &VoceFlow::yield, positive_stress},
      Key{"saturation", &VoceFlow::saturation, positive_stress},
      Key{"rate", &VoceFlow::rate, not_negative_number},
  };
};

template <> struct LawKeys<TableFlow> {
  using Key = NumberKey<TableFlow>;
  static constexpr std::string_view name = "table";
  static constexpr std::array<Key, 0> keys{};
};

template <> struct LawKeys<NortonHoffFlow> {
  using Key = NumberKey<NortonHoffFlow>;
  static constexpr std::string_view name = "norton-hoff";
  static constexpr std::array keys{
      Key{"K", &NortonHoffFlow::K, positive_stress},
      Key{"m", &NortonHoffFlow::m, {quantity::number, {0.0, 1.0, true, false}}},
      Key{"n", &NortonHoffFlow::n, not_negative_number, false},
      Key{"eps0", &NortonHoffFlow::eps0, not_negative_number, false},
      Key{"yield", &NortonHoffFlow::yield, not_negative_stress, false},
  };
};

template <> struct LawKeys<PerzynaFlow> {
  using Key = NumberKey<PerzynaFlow>;
  static constexpr std::string_view name = "perzyna";
  static constexpr std::array keys{
      Key{"eta", &PerzynaFlow::eta, positive_time},
      Key{"m", &PerzynaFlow::m, positive_number},
  };
};

template <> struct LawKeys<JohnsonCookFlow> {
  using Key = NumberKey<JohnsonCookFlow>;
  static constexpr std::string_view name = "johnson-cook";
  static constexpr Number warm{quantity::temperature, above_absolute_zero};
  static constexpr std::array keys{
      Key{"A", &JohnsonCookFlow::A, positive_stress},
      Key{"B", &JohnsonCookFlow::B, not_negative_stress},
      Key{"n", &JohnsonCookFlow::n, not_negative_number},
      Key{"C", &JohnsonCookFlow::C, not_negative_number},
      Key{"rate0", &JohnsonCookFlow::rate0, {quantity::rate, positive}},
      Key{"m", &JohnsonCookFlow::m, positive_number},
      Key{"T_room", &JohnsonCookFlow::T_room, warm},
      Key{"T_melt", &JohnsonCookFlow::T_melt, warm},
  };
};

template <> struct LawKeys<HanselSpittelFlow> {
  using Law = HanselSpittelFlow;
  using Key = NumberKey<Law>;
  static constexpr std::string_view name = "hansel-spittel";
  static constexpr Number exponent{};
  static constexpr std::array keys{
      Key{"A", &Law::A, positive_stress},
      Key{"m1", &Law::m1, exponent, false},
      Key{"m2", &Law::m2, exponent, false},
      Key{"m3", &Law::m3, exponent, false},
      Key{"m4", &Law::m4, exponent, false},
      Key{"m5", &Law::m5, exponent, false},
      Key{"m6", &Law::m6, {{}, {0., 0.}}, false},
      Key{"m7", &Law::m7, exponent, false},
      Key{"m8", &Law::m8, exponent, false},
      Key{"m9", &Law::m9, exponent, false},
      Key{"eps_min", &Law::eps_min, positive_number, false},
      Key{"eps_max", &Law::eps_max, positive_number, false},
  };
};

template <> struct LawKeys<FrictionlessFriction> {
  static constexpr std::string_view name = "frictionless";
  static constexpr std::array<NumberKey<FrictionlessFriction>, 0> keys{};
};

template <> struct LawKeys<StickingFriction> {
  static constexpr std::string_view name = "sticking";
  static constexpr std::array<NumberKey<StickingFriction>, 0> keys{};
};

template <> struct LawKeys<CoulombFriction> {
  using Key = NumberKey<CoulombFriction>;
  static constexpr std::string_view name = "coulomb";
  static constexpr std::array keys{
      Key{"mu", &CoulombFriction::mu, not_negative_number, true, true},
      Key{"threshold", &CoulombFriction::threshold, not_negative_stress, false},
      Key{"mu2", &CoulombFriction::mu2, {quantity::inverse_stress, not_negative}, false},
  };
};

template <> struct LawKeys<TrescaFriction> {
  using Key = NumberKey<TrescaFriction>;
  static constexpr std::string_view name = "tresca";
  static constexpr std::array keys{Key{"m", &TrescaFriction::m, fraction_number, true, true}};
};

template <> struct LawKeys<ShawFriction> {
  using Key = NumberKey<ShawFriction>;
  static constexpr std::string_view name = "shaw";
  static constexpr std::array<Key, 0> keys{};
};

template <> struct LawKeys<AsperityFriction> {
  using Key = NumberKey<AsperityFriction>;
  static constexpr std::string_view name = "asperity";
  static constexpr std::array keys{
      Key{"m_local", &AsperityFriction::m_local, fraction_number, true, true},
  };
};

template <> struct LawKeys<ThickFilmFriction> {
  using Key = NumberKey<ThickFilmFriction>;
  static constexpr std::string_view name = "thick-film";
  static constexpr std::array keys{
      Key{"viscosity", &ThickFilmFriction::viscosity, {quantity::viscosity, positive}},
      Key{"film", &ThickFilmFriction::film, positive_length},
  };
};

template <> struct LawKeys<ViscoplasticFriction> {
  using Key = NumberKey<ViscoplasticFriction>;
  static constexpr std::string_view name = "viscoplastic";
  static constexpr std::array keys{
      Key{"beta", &ViscoplasticFriction::beta, not_negative_stress},
      Key{"v0", &ViscoplasticFriction::v0, {quantity::speed, positive}},
      Key{"mv", &ViscoplasticFriction::mv, {quantity::number, {0.0, 1.0, true, false}}},
  };
};

} // namespace billet::io
