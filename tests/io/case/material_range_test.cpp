// Whether a case asks a flow law for more than its data cover.

#include "io/case/material_library.h"
#include "io/case/material_range.h"
#include "tests/io/case/case_text.h"
#include "tests/support/case_texts.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace billet::io::material_range_test {
namespace {

Material from_library(const std::string& name, const std::string& more = "") {
  return read("analysis = \"plane-strain\"\ntemperature = 20\n[workpiece]\nelement = \"quad4\"\n"
              "material = \"m\"\nmesh = { box = [[0, 0], [1, 1]], cells = [1, 1] }\n"
              "[material.m]\nlibrary = \"" +
              name + "\"\n" + more +
              "[[tool]]\nname = \"t\"\nsurface = { plane = { point = [0, 1], normal = [0, -1] } }\n"
              "motion = { velocity = [0, -0.1] }\n[time]\nend = 1\n")
      .materials.at("m");
}

TEST(MaterialRange, KnowsTheTemperaturesOfTheLibrary) {
  const Material hot = from_library("c45-hot");
  for (const double inside : {796.0, 800.0, 1000.0, 1200.0})
    EXPECT_FALSE(outside_range(hot, inside)) << inside;
  for (const double outside : {20.0, 790.0, 1500.0})
    EXPECT_TRUE(outside_range(hot, outside)) << outside;
  EXPECT_NE(outside_range(hot, 20.0)->find("'c45-hot' reach from 800 to 1200 degC"),
            std::string::npos);
  EXPECT_FALSE(outside_range(from_library("c15-cold"), 20.0));
  EXPECT_TRUE(outside_range(from_library("c15-cold"), 1300.0));
}

TEST(MaterialRange, IsNotThatOfALawOfOnesOwn) {
  const Material own =
      from_library("c45-hot", "flow = { law = \"swift\", K = 500, eps0 = 0.01, n = 0.2 }\n");
  EXPECT_FALSE(outside_range(own, 20.0));
  EXPECT_FALSE(outside_range({}, 20.0));
}

TEST(MaterialRange, OfEachMaterialHoldsTheTemperatureItsSourceNames) {
  for (const LibraryMaterial& material : material_library()) {
    EXPECT_GT(material.range.strain, 0.0) << material.name;
    EXPECT_LT(material.range.coldest, material.range.hottest) << material.name;
    const bool cold = material.source.find("20 degC") != std::string_view::npos;
    EXPECT_TRUE(!cold || material.range.coldest <= 20.0) << material.name;
  }
}

} // namespace
} // namespace billet::io::material_range_test
