// What a cold, slow, rigid model leaves out: heat, rate, inertia, dies that give way.

#include "io/advice/advice_parts.h"
#include "io/advice/metal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace billet::io {

namespace {

using process::Scene;

/// Numbers that all of this advice rests on, in SI units.
class NominalState {
public:
  NominalState(const Case& content, const Scene& scene, const NominalFlow& flow)
      : content_(content), scene_(scene), flow_(flow),
        length_(std::pow(10.0, content.units.length_power)) {}

  /// Flow stress at a strain and a rate, at the temperature of the workpiece [Pa].
  [[nodiscard]] double stress(double strain, double rate) const {
    return pascal(
        mechanics::yield_stress(scene_.material.flow, {strain, rate, scene_.material.temperature}));
  }
  /// The same at another temperature [Pa].
  [[nodiscard]] double stress_at(double temperature) const {
    return pascal(
        mechanics::yield_stress(scene_.material.flow, {flow_.strain, mean_rate(), temperature}));
  }
  /// Plastic work for the nominal strain [J/m^3].
  [[nodiscard]] double work() const {
    constexpr int steps = 200;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k)
      sum += stress((k + 0.5) / steps * flow_.strain, mean_rate());
    return sum * flow_.strain / steps;
  }
  [[nodiscard]] double mean_rate() const { return flow_.strain / flow_.duration; } ///< [1/s]
  [[nodiscard]] double temperature() const {
    constexpr double room = 20.0;
    return content_.temperature.value_or(room);
  }
  /// [m]
  [[nodiscard]] double metres(double length) const { return length * length_; }
  /// Fourier number of a time: how far heat comes into half of the thickness [-].
  [[nodiscard]] double fourier(double diffusivity, double time) const {
    const double half = 0.5 * metres(flow_.thickness);
    return diffusivity * time / (half * half);
  }

private:
  [[nodiscard]] double pascal(double stress_of_case) const {
    return stress_of_case / (length_ * length_);
  }

  const Case& content_;
  const Scene& scene_;
  const NominalFlow& flow_;
  double length_; ///< one of the case's [m]
};

/// Work heats the metal, and there is no time for the heat to leave.
std::optional<Advice>
heating_advice(const Case& content, const NominalFlow& flow, const NominalState& state) {
  constexpr double share = 0.9, least_rise = 50.0; // [-], [K]
  constexpr double most_fourier = 0.1; // below it not a tenth of the heat has left by the surface
  const Material& material = content.materials.at(content.workpiece.material);
  const std::optional<Metal> metal = metal_of(content);
  if (material.heating || !metal)
    return std::nullopt;
  const double rise = share * state.work() / (metal->density * metal->heat_capacity);
  const double fourier = state.fourier(metal->diffusivity(), flow.duration);
  if (rise < least_rise || fourier > most_fourier)
    return std::nullopt;
  const double softer =
      1.0 - state.stress_at(state.temperature() + rise) / state.stress_at(state.temperature());
  const bool knows_heat = std::abs(softer) > 1e-6;
  return Advice{
      Advice::Kind::heating,
      fmt::format("within the {:.3g} {} of forming, if these are those of the press, the work of "
                  "plastic strain ({:.2g}) heats the metal by about {:.0f} K, and hardly any of it "
                  "leaves (Fourier number a t / (h/2)^2 = {:.2g}, constants of {}): {}",
                  flow.duration, content.units.time, flow.strain, rise, fourier, metal->name,
                  knows_heat
                      ? fmt::format("heating = {} would lower the flow stress by up to {:.0f} %",
                                    share, 100.0 * softer)
                      : fmt::format("take a law that follows the temperature (johnson-cook, "
                                    "hansel-spittel) and heating = {}",
                                    share))};
}

/// Dies that are colder than the metal.
std::optional<Advice>
chill_advice(const Case& content, const NominalFlow& flow, const NominalState& state) {
  constexpr double hot = 400.0, least_fourier = 0.05; // [degC], [-]
  const std::optional<Metal> metal = metal_of(content);
  if (!metal || flow.pressing.empty() || state.temperature() < hot)
    return std::nullopt;
  const double fourier = state.fourier(metal->diffusivity(), flow.contact_time);
  if (fourier < least_fourier)
    return std::nullopt;
  const double layer =
      std::sqrt(metal->diffusivity() * flow.contact_time) / state.metres(1.0); // [mm]
  return Advice{
      Advice::Kind::chill,
      fmt::format("metal of {:.0f} {} touches the dies for {:.3g} {}, and billet conducts no heat: "
                  "colder dies chill a layer of about {:.2g} {} (Fourier number a t / (h/2)^2 = "
                  "{:.2g}, constants of {}), which is harder than it is here; force and filling "
                  "are those of dies as hot as the metal",
                  state.temperature(), content.units.temperature, flow.contact_time,
                  content.units.time, layer, content.units.length, fourier, metal->name)};
}

/// Inertia compared with the flow stress.
std::optional<Advice>
inertia_advice(const Case& content, const NominalFlow& flow, const NominalState& state) {
  constexpr double most = 0.01, density_of_steel = 7850.0; // [-], [kg/m^3]
  const std::optional<Metal> metal = metal_of(content);
  const double density = metal ? metal->density : density_of_steel;
  const double speed = state.metres(flow.speed);
  const double number = density * speed * speed / state.stress(flow.strain, flow.rate);
  if (number < most)
    return std::nullopt;
  return Advice{
      Advice::Kind::inertia,
      fmt::format("at {:.3g} m/s inertia is {:.2g} of the flow stress (rho v^2 / sigma): the part "
                  "is not in equilibrium as it is taken to be here; are speed and time those of "
                  "the process?",
                  speed, number)};
}

/// A flow law without the rate where metal follows it.
std::optional<Advice>
rate_advice(const Case& content, const NominalFlow& flow, const NominalState& state) {
  constexpr double hot_share = 0.4, zero = 273.15;  // of the melting point in K; [K]
  constexpr double hot_rate = 1.0, cold_rate = 1e2; // [1/s]
  constexpr double least_strain = 0.02;
  const double slow = state.stress(flow.strain, 0.01 * flow.rate);
  if (flow.strain < least_strain ||
      std::abs(state.stress(flow.strain, flow.rate) - slow) > 1e-6 * slow)
    return std::nullopt; // the law follows it
  const std::optional<Metal> metal = metal_of(content);
  const double share = metal ? (state.temperature() + zero) / (metal->melting + zero) : 0.0;
  const bool is_hot = share > hot_share;
  if (flow.rate < (is_hot ? hot_rate : cold_rate))
    return std::nullopt;
  // Exponents of the rate: Kalpakjian and Schmid, Manufacturing Engineering and Technology: up
  // to 0.05 cold, 0.05 to 0.4 hot; cold as in the library (c45: 6 % from 1 to 100 /s).
  const std::string state_of_metal =
      is_hot ? fmt::format("at {:.0f} {}, {:.2g} of the melting point in K, the flow stress of {} "
                           "grows by some 10 to 150 % for a tenfold rate",
                           state.temperature(), content.units.temperature, share, metal->name)
             : std::string("cold metal flows at a stress that is some 5 to 10 % larger than where "
                           "it is tested");
  return Advice{
      Advice::Kind::rate,
      fmt::format("the strain rate is about {:.2g} /s and the flow law knows no rate: {}; "
                  "take norton-hoff, perzyna, johnson-cook or hansel-spittel, or curves "
                  "measured at that rate",
                  flow.rate, state_of_metal)};
}

/// What dies of steel bear.
std::optional<Advice>
die_advice(const Case& content, const NominalFlow& flow, const NominalState& state) {
  // Compressive yield stress of 1.2379 (AISI D2): 1650 MPa at 50 HRC, 1900 at 55, 2150 at 60, 2200
  // at 62 (data sheet of AISI D2). Designs stay below.
  constexpr double most = 1500e6, young = 210e9, poisson = 0.3; // [Pa]
  if (flow.pressing.empty() || !flow.compresses)
    return std::nullopt;
  const double pressure = state.stress(flow.strain, flow.rate);
  if (pressure < most)
    return std::nullopt;
  std::string gives_way = "gives way";
  if (std::isfinite(flow.width)) {
    // In the middle of a circle of that width under even pressure on a half space (Timoshenko and
    // Goodier, Theory of Elasticity).
    const double sinks = 2.0 * (1.0 - poisson * poisson) * pressure * 0.5 * flow.width / young;
    gives_way = fmt::format("sinks in by about {:.2g} {} under a part {:.3g} {} wide", sinks,
                            content.units.length, flow.width, content.units.length);
  }
  return Advice{
      Advice::Kind::die_pressure,
      fmt::format("contact pressure of about {:.0f} MPa or more, the flow stress at a "
                  "strain of {:.2g}: a die of steel (210 GPa) {}, and hardened tool steel "
                  "yields at 1650 to 2200 MPa; dies are rigid here",
                  pressure * 1e-6, flow.strain, gives_way)};
}

} // namespace

std::vector<Advice>
physics_advice(const Case& content, const Scene& scene, const NominalFlow& flow) {
  std::vector<Advice> all;
  const Material& material = content.materials.at(content.workpiece.material);
  if (!material.flow || flow.duration == 0.0)
    return all;
  const NominalState state(content, scene, flow);
  for (const auto theme : {die_advice, heating_advice, chill_advice, inertia_advice, rate_advice})
    if (const std::optional<Advice> found = theme(content, flow, state))
      all.push_back(*found);
  return all;
}

} // namespace billet::io
