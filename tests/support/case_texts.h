// Small case files for tests that start the program, and ways to spoil them.

#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billet::test {

/// Upsetting with six elements; a run takes some hundredths of a second.
inline const std::string upsetting = R"(title    = "Tiny upsetting"
analysis = "axisymmetric"

[workpiece]
element  = "quad8"
material = "steel"
mesh     = { box = [[0, 0], [5, 7.5]], cells = [2, 3] }

[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }

[[support]]
where = "x = 0"
fix   = ["x"]

[[support]]
where = "y = 0"
fix   = ["y"]

[[tool]]
name     = "punch"
surface  = { plane = { point = [0, 7.5], normal = [0, -1] } }
motion   = { velocity = [0, -1] }
friction = { law = "tresca", m = 0.08 }

[time]
end = 0.1
increments = { first = 0.02, max = 0.02 }
)";

/// A quarter of a cylinder between STL dies.
inline const std::string upsetting_3d = R"(title    = "Tiny upsetting in space"
analysis = "3d"

[workpiece]
element  = "hex8"
material = "steel"
mesh     = { cylinder = { radius = 5, height = 15 }, cells = [2, 3], sector = 90 }

[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow    = { law = "linear", yield = 300, hardening = 500 }

[[support]]
where = "x = 0"
fix   = ["x"]

[[support]]
where = "y = 0"
fix   = ["y"]

[[tool]]
name     = "punch"
surface  = { stl = "punch.stl", unit = "mm" }
motion   = { velocity = [0, 0, -1] }
touch    = true
friction = { law = "coulomb", mu = 0.1 }

[[tool]]
name     = "die"
surface  = { stl = "die.stl", unit = "mm" }

[time]
end = 0.1
increments = { first = 0.05, max = 0.05 }
)";

using Edits = std::vector<std::pair<std::string, std::string>>;

/// The text with the first place of each `first` replaced by `second`.
inline std::string edited(std::string text, const Edits& edits) {
  for (const auto& [from, to] : edits) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "the case has no '" << from << "'";
    if (at != std::string::npos)
      text.replace(at, from.size(), to);
  }
  return text;
}

/// Number of the line on which `what` stands.
inline int line_of(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << "the case has no '" << what << "'";
  int line = 1;
  for (const char c : std::string_view(text).substr(0, at))
    line += c == '\n' ? 1 : 0;
  return line;
}

/// An ASCII STL of a square of side 2 `half` at height z, facing up or down.
inline std::string square_stl(double half, double z, bool up) {
  const auto corner = [&](double sx, double sy) {
    return "   vertex " + std::to_string(sx * half) + " " + std::to_string(sy * half) + " " +
           std::to_string(z) + "\n";
  };
  const auto facet = [&](const std::string& a, const std::string& b, const std::string& c) {
    return std::string(" facet normal 0 0 ") + (up ? "1" : "-1") + "\n  outer loop\n" + a +
           (up ? b + c : c + b) + "  endloop\n endfacet\n";
  };
  return "solid square\n" + facet(corner(-1, -1), corner(1, -1), corner(1, 1)) +
         facet(corner(-1, -1), corner(1, 1), corner(-1, 1)) + "endsolid square\n";
}

/// A binary STL of `facets` equal triangles at height z; the header promises `promised` of them.
inline std::string binary_stl(unsigned facets, unsigned promised, float z) {
  std::string bytes(80, ' ');
  const auto add = [&](const auto& value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  };
  add(promised);
  for (unsigned i = 0; i < facets; ++i) {
    const auto shift = static_cast<float>(20 * i);
    for (const float v :
         {0.0F, 0.0F, 1.0F, shift, 0.0F, z, shift + 10.0F, 0.0F, z, shift, 10.0F, z})
      add(v);
    bytes.append(2, '\0');
  }
  return bytes;
}

} // namespace billet::test
