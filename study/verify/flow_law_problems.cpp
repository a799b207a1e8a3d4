// Flow laws under uniaxial stress, and the heat of plastic work.
//
// A bar of one element is pulled to a logarithmic strain e. Its Kirchhoff stress tau satisfies
// tau = flow stress at the plastic strain e - tau / E, and the force per initial area is
// tau exp(-e), whatever the lateral strain (Hencky elasticity). The laws are written out once more
// here, from their papers.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "study/verify/problems.h"
#include "study/verify/readings.h"

namespace billet::study {

namespace {

constexpr double bar_young = 200e3;
/// Flow stress over plastic strain [MPa].
using FlowCurve = std::function<double(double)>;

/// A law as a case names it, and as its paper prints it.
struct NamedCurve {
  std::string name;
  std::string toml; ///< of `flow`
  FlowCurve stress;
  std::string source;
};

/// tau at a logarithmic strain [MPa]: the plastic strain is e - tau / E.
double stress_of_bar(const FlowCurve& stress, double strain) {
  double low = 0.0, high = bar_young * strain;
  for (int i = 0; i < 200; ++i) {
    const double tau = 0.5 * (low + high);
    (tau > stress(std::max(0.0, strain - tau / bar_young)) ? high : low) = tau;
  }
  return 0.5 * (low + high);
}

/// How a bar is pulled.
struct Pull {
  double strain;     ///< logarithmic, at the end [-]
  double rate;       ///< constant true rate [1/s]
  int increments;    ///< of equal logarithmic strain
  std::string extra; ///< lines of [material.bar] and of the head of the case
};

std::string bar_case_text(const std::string& flow, const Pull& pull, const std::string& head = "") {
  const double duration = pull.strain / pull.rate;
  std::string table;
  for (int i = 0; i <= pull.increments; ++i) {
    const double share = static_cast<double>(i) / pull.increments;
    table += fmt::format("{}[{}, {}]", i == 0 ? "" : ", ", duration * share,
                         std::exp(pull.strain * share) - 1.0);
  }
  const double step = duration / pull.increments * (1.0 + 1e-6); // none is split for rounding
  return fmt::format(R"(title = "Bar of one element"
analysis = "axisymmetric"
{5}
[workpiece]
element = "quad8"
material = "bar"
mesh = {{ box = [[0, 0], [1, 1]], cells = [1, 1] }}
[material.bar]
elastic = {{ young = {0}, poisson = 0.3 }}
flow = {1}
{2}
[[support]]
where = "x = 0"
fix = ["x"]
[[support]]
where = "y = 0"
fix = ["y"]
[[support]]
where = "y = 1"
move = {{ y = [{3}] }}
[time]
end = {6}
increments = {{ first = {4}, min = {4}, max = {4} }}
[solver]
tolerance = 1e-9
)",
                     bar_young, flow, pull.extra, table, step, head, duration);
}

/// Force on the moved end per initial area [MPa].
double nominal_stress_of_bar(const process::Run& run) {
  return reaction(run, "y-max", 1) / std::numbers::pi;
}

constexpr double johnson_cook_A = 792.0, johnson_cook_B = 510.0, johnson_cook_n = 0.26,
                 johnson_cook_C = 0.014, johnson_cook_m = 1.03, johnson_cook_room = 20.0,
                 johnson_cook_melt = 1520.0;
constexpr const char* johnson_cook_toml =
    R"({ law = "johnson-cook", A = 792, B = 510, n = 0.26, C = 0.014, rate0 = 1, m = 1.03, T_room = 20, T_melt = 1520 })";

/// Johnson and Cook's flow stress of steel 4340 [MPa]; rates above 1/s.
double johnson_cook(double strain, double rate, double temperature) {
  const double T = (temperature - johnson_cook_room) / (johnson_cook_melt - johnson_cook_room);
  return (johnson_cook_A + johnson_cook_B * std::pow(strain, johnson_cook_n)) *
         (1.0 + johnson_cook_C * std::log(rate)) * (1.0 - std::pow(T, johnson_cook_m));
}

std::vector<NamedCurve> static_curves() {
  return {
      {"perfect", R"({ law = "perfect", yield = 300 })", [](double) { return 300.0; }, ""},
      {"linear", R"({ law = "linear", yield = 700, hardening = 300 })",
       [](double e) { return 700.0 + 300.0 * e; }, ""},
      {"swift", R"({ law = "swift", K = 740, eps0 = 0.01, n = 0.2 })",
       [](double e) { return 740.0 * std::pow(0.01 + e, 0.2); }, "Swift 1952"},
      {"ludwik", R"({ law = "ludwik", yield = 200, K = 500, n = 0.4 })",
       [](double e) { return 200.0 + 500.0 * std::pow(e, 0.4); }, "Ludwik 1909"},
      {"voce", R"({ law = "voce", yield = 150, saturation = 400, rate = 8 })",
       [](double e) { return 400.0 - 250.0 * std::exp(-8.0 * e); }, "Voce 1948"},
      {"hockett-sherby",
       R"({ law = "hockett-sherby", yield = 150, saturation = 400, N = 5, p = 0.7 })",
       [](double e) { return 400.0 - 250.0 * std::exp(-5.0 * std::pow(e, 0.7)); },
       "Hockett and Sherby 1975"},
      {"table", R"({ law = "table", points = [[0, 200], [0.2, 350], [1, 400]] })",
       [](double e) { return e < 0.2 ? 200.0 + 750.0 * e : 350.0 + 62.5 * (e - 0.2); },
       "straight lines between points"},
  };
}

/// A law that follows the rate, at one rate and temperature.
struct RateCurve {
  std::string name;
  std::string toml;
  double rate;                                  ///< [1/s]
  double temperature;                           ///< [degC]
  std::function<double(double, double)> stress; ///< of plastic strain and its rate [MPa]
  std::string source;
};

std::vector<RateCurve> rate_curves() {
  const auto hoff = [](double, double rate) {
    return std::numbers::sqrt3 * 50.0 * std::pow(std::numbers::sqrt3 * rate, 0.2);
  };
  const auto perzyna = [](double, double rate) {
    return 200.0 * (1.0 + std::pow(rate / 40.0, 0.2));
  };
  const auto hot = [](double strain, double rate) {
    constexpr double T = 1000.0;
    return 1500.0 * std::exp(-0.0025 * T) * std::pow(strain, 0.1) * std::exp(-0.03 / strain) *
           std::pow(rate, 0.12);
  };
  const std::string norton = R"({ law = "norton-hoff", K = 50, m = 0.2 })";
  const std::string over =
      R"({ law = "perzyna", eta = 0.025, m = 0.2, base = { law = "perfect", yield = 200 } })";
  const std::string spittel =
      R"({ law = "hansel-spittel", A = 1500, m1 = -0.0025, m2 = 0.1, m3 = 0.12, m4 = -0.03 })";
  return {
      {"norton-hoff at 0.01 /s", norton, 0.01, 20.0, hoff, "Norton 1929, Hoff 1954"},
      {"norton-hoff at 100 /s", norton, 100.0, 20.0, hoff, "Norton 1929, Hoff 1954"},
      {"perzyna at 0.01 /s", over, 0.01, 20.0, perzyna, "Perzyna 1966"},
      {"perzyna at 100 /s", over, 100.0, 20.0, perzyna, "Perzyna 1966"},
      {"johnson-cook at 100 /s and 500 degC", johnson_cook_toml, 100.0, 500.0,
       [](double strain, double rate) { return johnson_cook(strain, rate, 500.0); },
       "Johnson and Cook 1983"},
      {"hansel-spittel at 10 /s and 1000 degC", spittel, 10.0, 1000.0, hot,
       "Hensel and Spittel 1978"},
  };
}

/// tau of a bar at a constant true rate: the plastic rate is less by what goes into the elastic
/// strain of a hardening metal, rate / (1 + h / E) with the slope h.
double stress_at_rate(const RateCurve& law, double strain) {
  double plastic_rate = law.rate;
  double tau = 0.0;
  for (int i = 0; i < 20; ++i) {
    const FlowCurve curve = [&](double e) { return law.stress(std::max(e, 1e-12), plastic_rate); };
    tau = stress_of_bar(curve, strain);
    const double plastic = strain - tau / bar_young, d = 1e-5 * plastic;
    const double slope = (curve(plastic + d) - curve(plastic - d)) / (2.0 * d);
    plastic_rate = law.rate / (1.0 + slope / bar_young);
  }
  return tau;
}

/// dT = share of the plastic work, by the classical Runge-Kutta rule: T at a plastic strain [degC].
double adiabatic_temperature(double per_work, double rate, double strain) {
  constexpr int steps = 20000;
  const double h = strain / steps;
  const auto slope = [&](double e, double T) { return per_work * johnson_cook(e, rate, T); };
  double T = 20.0;
  for (int i = 0; i < steps; ++i) {
    const double e = i * h;
    const double k1 = slope(e, T), k2 = slope(e + 0.5 * h, T + 0.5 * h * k1);
    const double k3 = slope(e + 0.5 * h, T + 0.5 * h * k2), k4 = slope(e + h, T + h * k3);
    T += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return T;
}

} // namespace

std::vector<Figure> static_flow_laws(const CaseBench& bench) {
  constexpr double strain = 0.4;
  constexpr double exact = 1e-7; // radial return along a straight path has no error of increments
  std::vector<Figure> figures;
  for (const NamedCurve& law : static_curves()) {
    const auto process =
        bench.run("flow-" + law.name, bar_case_text(law.toml, {strain, 1.0, 40, ""}));
    const double reference = stress_of_bar(law.stress, strain) * std::exp(-strain);
    figures.push_back(relative(law.name + ": force per initial area at a strain of 0.4", "MPa",
                               nominal_stress_of_bar(process->view()), reference, exact));
    figures.back().source = law.source;
  }
  return figures;
}

std::vector<Figure> rate_flow_laws(const CaseBench& bench) {
  constexpr double strain = 0.2;
  // The rate of an increment is that of its middle; the slope of the law changes over it.
  constexpr double of_increments = 1e-5;
  std::vector<Figure> figures;
  int number = 0;
  for (const RateCurve& law : rate_curves()) {
    const std::string head = fmt::format("temperature = {}", law.temperature);
    const auto process = bench.run(fmt::format("rate-law-{}", ++number),
                                   bar_case_text(law.toml, {strain, law.rate, 20, ""}, head));
    const double reference = stress_at_rate(law, strain) * std::exp(-strain);
    figures.push_back(relative(law.name + ": force per initial area at a strain of 0.2", "MPa",
                               nominal_stress_of_bar(process->view()), reference, of_increments));
    figures.back().source = law.source;
  }
  return figures;
}

std::vector<Figure> adiabatic_heating(const CaseBench& bench) {
  const std::string heat = "density = 7.83e-9\nheat_capacity = 477e6\nheating = 0.9";
  constexpr double per_work = 0.9 / (7.83e-9 * 477e6); // [K/MPa]
  std::vector<Figure> figures;

  const FlowCurve linear = [](double e) { return 700.0 + 300.0 * e; };
  const auto warm = bench.run("heating-linear",
                              bar_case_text(R"({ law = "linear", yield = 700, hardening = 300 })",
                                            {0.5, 1.0, 10, heat}, "temperature = 20"));
  const double plastic = 0.5 - stress_of_bar(linear, 0.5) / bar_young;
  figures.push_back(relative("linear hardening: rise of temperature at a strain of 0.5", "K",
                             warm->view().model.bulk->temperature(0) - 20.0,
                             per_work * (700.0 * plastic + 150.0 * plastic * plastic), 1e-8));

  constexpr double rate = 1000.0;
  constexpr int increments = 80;
  const auto hot = bench.run(
      "heating-johnson-cook",
      bar_case_text(johnson_cook_toml, {0.5, rate, increments, heat}, "temperature = 20"));
  const double strain = hot->view().model.bulk->states()[0].plastic_strain;
  const double T = adiabatic_temperature(per_work, rate, strain);
  // Temperatures are those of the start of an increment: first order in their number.
  figures.push_back(relative("johnson-cook at 1000 /s: rise of temperature at a strain of 0.5", "K",
                             hot->view().model.bulk->temperature(0) - 20.0, T - 20.0, 2e-3));
  const double tau = nominal_stress_of_bar(hot->view()) * std::exp(0.5);
  figures.push_back(relative("johnson-cook at 1000 /s: flow stress when as hot as that", "MPa", tau,
                             johnson_cook(strain, rate, T), 2e-3));
  return figures;
}

} // namespace billet::study
