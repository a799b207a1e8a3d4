// Presses: a crank, a hammer, a screw.

#include "io/case/read_parts.h"
#include "io/case/values.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>

namespace billet::io {

namespace {

constexpr Number positive_mass{quantity::mass, positive};
constexpr Number positive_energy{quantity::energy, positive};

CrankMotion read_crank(TableReader& table) {
  CrankMotion crank;
  table.required("direction", crank.direction, as_direction);
  refuse_radial(table, crank.direction);
  table.required("radius", crank.radius, as_number, positive_length);
  if (table.required("rod", crank.rod, as_number, positive_length) && crank.rod <= crank.radius)
    table.find("rod")->complain_found("more than the radius of the crank");
  table.required("speed", crank.speed, as_time_function,
                 Number{quantity::angular_speed, not_negative});
  table.optional("start", crank.start, as_number, Number{quantity::angle, any_value});
  return crank;
}

StrikingPress read_striking(TableReader& table) {
  StrikingPress press;
  table.required("direction", press.direction, as_direction);
  refuse_radial(table, press.direction);
  table.optional("efficiency", press.efficiency, as_number,
                 Number{quantity::number, {0.0, 1.0, true, false}});
  table.optional("force", press.force, as_time_function, Number{quantity::force, not_negative});
  return press;
}

/// Complains unless as many of the keys are there as it takes.
void expect_keys(TableReader& table,
                 std::initializer_list<std::string_view> keys,
                 int wanted,
                 const std::string& allowed) {
  int found = 0;
  for (const std::string_view key : keys)
    found += table.find(key) ? 1 : 0;
  if (found != wanted)
    table.at().refuse("allowed is " + allowed);
}

HammerMotion read_hammer(TableReader& table) {
  HammerMotion hammer{.press = read_striking(table)};
  double energy = 0.0;
  table.optional("energy", energy, as_number, positive_energy);
  table.optional("mass", hammer.mass, as_number, positive_mass);
  table.optional("velocity", hammer.velocity, as_number, Number{quantity::speed, positive});
  expect_keys(table, {"energy", "mass", "velocity"}, 2, "two of energy, mass and velocity");
  if (hammer.mass == 0.0 && hammer.velocity > 0.0)
    hammer.mass = 2.0 * energy / (hammer.velocity * hammer.velocity);
  else if (hammer.velocity == 0.0 && hammer.mass > 0.0)
    hammer.velocity = std::sqrt(2.0 * energy / hammer.mass);
  return hammer;
}

/// All that moves has the energy I w^2 / 2 of its flywheel at the speed w, with the moment of
/// inertia I of the flywheel and of the ram, which goes at w pitch / 2 pi. (P.10)
ScrewMotion read_screw(TableReader& table) {
  ScrewMotion screw{.press = read_striking(table)};
  double energy = 0.0;
  table.required("inertia", screw.inertia, as_number, Number{quantity::inertia, positive});
  table.required("pitch", screw.pitch, as_number, positive_length);
  table.optional("mass", screw.mass, as_number, Number{quantity::mass, not_negative});
  table.optional("energy", energy, as_number, positive_energy);
  table.optional("speed", screw.speed, as_number, Number{quantity::angular_speed, positive});
  expect_keys(table, {"energy", "speed"}, 1, "either energy or speed");
  const double arm = screw.pitch / (2.0 * std::numbers::pi);
  if (energy > 0.0 && screw.inertia > 0.0)
    screw.speed = std::sqrt(2.0 * energy / (screw.inertia + screw.mass * arm * arm));
  return screw;
}

} // namespace

std::optional<PressMotion> as_press(const At& at) {
  enum class Kind { crank, hammer, screw };
  constexpr std::array kinds{Word<Kind>{"crank", Kind::crank}, Word<Kind>{"hammer", Kind::hammer},
                             Word<Kind>{"screw", Kind::screw}};
  TableReader table(at);
  std::optional<Kind> kind;
  table.required("kind", kind, [&](const At& word) { return as_choice(word, kinds); });
  if (!kind)
    return std::nullopt; // what the other keys mean is not known
  PressMotion motion;
  if (*kind == Kind::crank)
    motion = read_crank(table);
  else if (*kind == Kind::hammer)
    motion = read_hammer(table);
  else
    motion = read_screw(table);
  table.finish();
  return motion;
}

} // namespace billet::io
