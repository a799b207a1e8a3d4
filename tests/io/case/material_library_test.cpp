// The library of materials: read with every unit system, overridden, and what its flow stresses
// are.

#include "io/case/material_library.h"
#include "tests/io/case/case_text.h"
#include "tests/support/figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billet::io::material_library_test {
namespace {

Material material(const std::string& keys, const std::string& units = "mm-N-s-MPa-degC") {
  const std::string text = R"(analysis = "axisymmetric"
temperature = 950
[workpiece]
material = "billet"
mesh = { box = [[0, 0], [1, 1]], cells = [1, 1] }
[time]
end = 1
[material.billet]
)" + keys;
  return read("units = \"" + units + "\"\n" + text).materials.at("billet");
}

std::string named(std::string_view name) { return fmt::format("library = \"{}\"\n", name); }

TEST(MaterialLibrary, every_material_is_read_in_every_unit_system) {
  for (const LibraryMaterial& known : material_library()) {
    const Material mm = material(named(known.name));
    EXPECT_EQ(mm.library, known.name);
    EXPECT_GT(mm.elastic.young, 6e4) << known.name;
    EXPECT_LT(mm.elastic.young, 3e5) << known.name;
    ASSERT_TRUE(mm.flow && mm.density && mm.heat_capacity) << known.name;
    EXPECT_FALSE(mm.heating) << "a library does not turn heating on: " << known.name;
    EXPECT_GT(*mm.density * *mm.heat_capacity, 2.0) << known.name; // MPa/K
    EXPECT_LT(*mm.density * *mm.heat_capacity, 6.0) << known.name;
    EXPECT_FALSE(known.source.empty());
    const Material m = material(named(known.name), "m-N-s-Pa-degC");
    EXPECT_NEAR(m.elastic.young, 1e6 * mm.elastic.young, 1e-9 * m.elastic.young);
    EXPECT_NEAR(*m.density, 1e12 * *mm.density, 1e-9 * *m.density);
    EXPECT_NEAR(*m.heat_capacity, 1e-6 * *mm.heat_capacity, 1e-9 * *m.heat_capacity);
  }
}

TEST(MaterialLibrary, converts_the_stresses_of_each_law) {
  const auto ratio = [](const char* name, auto stress_of) {
    return stress_of(*material(named(name), "m-N-s-Pa-degC").flow) /
           stress_of(*material(named(name)).flow);
  };
  EXPECT_NEAR(ratio("c15-cold", [](const FlowLaw& f) { return std::get<mechanics::Swift>(f).K; }),
              1e6, 1.);
  EXPECT_NEAR(ratio("4340", [](const FlowLaw& f) { return std::get<mechanics::JohnsonCook>(f).B; }),
              1e6, 1.);
  EXPECT_NEAR(ratio("rail-steel-hot",
                    [](const FlowLaw& f) { return std::get<mechanics::HanselSpittel>(f).A; }),
              1e6, 1.);
}

TEST(MaterialLibrary, own_keys_stand_also_within_elastic_and_flow) {
  const Material changed =
      material(named("ofhc-copper") + "elastic = { young = \"130 GPa\" }\n"
                                      "flow = { A = 100, C = 0 }\nheating = 0.9\n");
  EXPECT_EQ(changed.elastic.young, 130e3);
  EXPECT_EQ(changed.elastic.poisson, 0.34);
  const auto law = std::get<mechanics::JohnsonCook>(*changed.flow);
  EXPECT_EQ(law.A, 100.0);
  EXPECT_EQ(law.B, 292.0);
  EXPECT_EQ(law.C, 0.0);
  EXPECT_EQ(changed.heating, 0.9);
  const Material other =
      material(named("ofhc-copper") + "flow = { law = \"perfect\", yield = 300 }\n");
  EXPECT_EQ(*other.flow, FlowLaw(mechanics::Perfect{300}));
}

TEST(MaterialLibrary, says_where_the_case_names_it_when_its_keys_do_not_fit) {
  const std::string text = R"(analysis = "axisymmetric"
[workpiece]
material = "billet"
mesh = { box = [[0, 0], [1, 1]], cells = [1, 1] }
[time]
end = 1
[material.billet]
library = "ofhc-copper"
flow = { law = "swift", K = 1 }
)";
  const auto complaints = complaints_of(text);
  ASSERT_FALSE(complaints.empty());
  for (const Complaint& complaint : complaints)
    EXPECT_NE(complaint.message.find("material.billet.flow"), std::string::npos)
        << complaint.text();
  const auto cold = complaints_of(replaced(text, "flow = { law = \"swift\", K = 1 }\n", ""));
  ASSERT_EQ(cold.size(), 1U);
  EXPECT_NE(cold[0].message.find("needs the temperature"), std::string::npos);
}

// Shida (1969), S. Shida, Empirical formula of flow stress of carbon steels, J. JSTP 10, 610-617.
double shida(double carbon, double strain, double rate, double celsius) {
  const double t = (celsius + 273.0) / 1000.0;
  const double n = 0.41 - 0.07 * carbon;
  const double m = (-0.019 * carbon + 0.126) * t + 0.075 * carbon - 0.05;
  constexpr double kgf = 9.80665; // per mm^2, in MPa
  return kgf * 0.28 * std::exp(5.0 / t - 0.01 / (carbon + 0.05)) *
         (1.3 * std::pow(strain / 0.2, n) - 0.3 * strain / 0.2) * std::pow(rate / 10.0, m);
}

TEST(MaterialLibrary, hot_steels_end_where_their_data_do) {
  for (const auto& [name, strain] : {std::pair("c45-hot", 1.0), std::pair("rail-steel-hot", 0.7)}) {
    const auto law = std::get<mechanics::HanselSpittel>(*material(named(name)).flow);
    EXPECT_EQ(law.eps_max, strain) << name;
  }
}

TEST(MaterialLibrary, hot_rail_steel_is_shidas_formula_within_the_stated_range) {
  const auto law = std::get<mechanics::HanselSpittel>(*material(named("rail-steel-hot")).flow);
  double worst = 0.0;
  for (const double strain : {0.05, 0.1, 0.2, 0.3, 0.5, 0.7})
    for (const double rate : {0.1, 1.0, 10.0, 100.0})
      for (double T = 850.0; T < 1151.0; T += 50.0) {
        const double fit = law.A * std::exp(law.m1 * T) * std::pow(strain, law.m2) *
                           std::exp(law.m7 * strain) * std::pow(rate, law.m3 + law.m8 * T);
        worst = std::max(worst, std::abs(fit / shida(0.75, strain, rate, T) - 1.0));
      }
  support::show_error("library", "rail-steel-hot against Shida", worst, 0.035);
  EXPECT_LE(worst, 0.035);
}

} // namespace
} // namespace billet::io::material_library_test
