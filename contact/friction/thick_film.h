// A film of lubricant that keeps tool and workpiece apart.

#pragma once

#include "contact/friction/friction_law.h"
#include "geometry/base/parameter.h"

#include <string_view>
#include <tuple>

namespace billet::contact {

/// tau_lim = viscosity |v_t| / film. (F.8): the paper's eq 9, which is printed without the speed.
struct ThickFilm {
  double viscosity; ///< [MPa s]
  double film;      ///< thickness e [mm]

  static constexpr std::string_view name = "thick-film";
  static constexpr bool creeps = true;
  static constexpr std::tuple parameters{
      Parameter{"viscosity", &ThickFilm::viscosity, quantity::viscosity, allowed::positive},
      Parameter{"film", &ThickFilm::film, quantity::length, allowed::positive},
  };

  bool operator==(const ThickFilm&) const = default;

  [[nodiscard]] SlipLimit slip_limit(const InterfacePoint& at) const noexcept {
    const double slope = viscosity / film;
    return {at.factor * slope * at.speed, 0.0, 0.0, at.factor * slope, slope * at.speed};
  }
};

} // namespace billet::contact
