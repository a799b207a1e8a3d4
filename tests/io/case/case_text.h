// Case texts that are valid, to be read as they are or broken in one place.

#pragma once

#include "geometry/base/error.h"
#include "io/case/read_case.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace billet::io {

/// Every key of the format that is available in the plane.
inline const std::string plane_case = R"(title = "upsetting"
units = "mm-N-s-MPa-degC"
analysis = "axisymmetric"
temperature = 20

[workpiece]
element = "quad8"
material = "steel"
mesh = { box = [[0, 0], [5, 7.5]], cells = [12, 18], grading = [1, 2] }
place = { translate = [0, 1], rotate = { point = [0, 0], degrees = 90 } }

[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }
density = "7850 kg/m^3"

[material.spring]
elastic = { young = 210000, poisson = 0.3 }

[[support]]
where = "x = 0"
fix = ["x"]

[[support]]
where = "set:bottom"
fix = ["x"]
move = { y = [[0, 0], [1, -0.5]] }

[[load]]
where = "y = 7.5 mm"
pressure = [[0, 0], [1, "10 MPa"]]

[[load]]
where = "set:side"
traction = [1, 2]
amplitude = [[0, 0], [1, 1]]

[[load]]
where = "all"
body_force = [0, -1e-4]

[[tool]]
name = "punch"
surface = { plane = { point = [0, 7.5], normal = [0, -1] } }
motion = { velocity = [0, "-60 mm/min"] }
touch = true
friction = { law = "tresca", m = 0.08, k = "100 MPa" }
active = [0, 2]

[[tool]]
name = "roll"
surface = { circle = { centre = [8, 0], radius = 2 }, inside = false }
motion = { displacement = [[0, 0, 0], [1, 0.5, 0]], rotation = { point = [8, 0], speed = "30 rpm" } }
friction = { law = "coulomb", mu = 0.1, threshold = 1, cap = "shear-yield" }

[[tool]]
name = "die"
surface = { points = [[0, 0], [4, 0], [5, -1]], closed = false }
place = { translate = [1, 0] }
friction = { law = "sticking" }

[contact]
form = "compatible"
method = "penalty"
penalty = 1000
penalty_tangent = 20
integrator = "radial"
surface = "set:skin"

[time]
end = 3
increments = { first = 0.1, min = 1e-6, max = 0.5 }

[[stage]]
name = "press"
end = 2
tools = ["punch", "die"]

[[stage]]
name = "release"
end = 3
unload = true

[solver]
linear = "mumps"
tolerance = 1e-7
threads = 2
accuracy = "standard"

[output]
every = 0.5
at = [0.25, 1.75]
fields = ["displacement", "stress"]
)";

/// The kinds of tools and meshes of 3d scenes.
inline const std::string space_case = R"(analysis = "3d"

[workpiece]
material = "lead"
mesh = { cylinder = { radius = 10, height = 30 }, cells = [4, 10], sector = 90 }

[material.lead]
elastic = { young = 16000, poisson = 0.44 }
flow = { law = "table", points = [[0, 10], [0.1, 20]] }

[[support]]
where = "z = 0"
fix = ["z"]

[[tool]]
name = "a"
surface = { cylinder = { point = [0, 0, 40], axis = [1, 0, 0], radius = 5 } }
motion = { rotation = { point = [0, 0, 40], axis = [1, 0, 0], speed = [[0, 0], [1, 3]] } }

[[tool]]
name = "b"
surface = { sphere = { centre = [0, 0, 40], radius = 5 }, inside = true }

[[tool]]
name = "c"
surface = { cone = { apex = [0, 0, 40], axis = [0, 0, 1], half_angle = 30 } }

[[tool]]
name = "d"
surface = { torus = { centre = [0, 0, 0], axis = [0, 0, 1], major = 20, minor = 5, inside = true } }
place = { rotate = { axis = [0, 1, 0], degrees = "0.5 rad" } }

[[tool]]
name = "e"
surface = { revolution = { point = [0, 0, 40], axis = [0, 1, 0], points = [[9, 5], [0, "4 mm"], [-9, 5]] } }

[time]
end = 1
)";

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline Case read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_case_text(text, "case.toml", ".", overrides);
}

/// What is wrong with a text; empty when it is read.
inline std::vector<Complaint> complaints_of(const std::string& text,
                                            const std::vector<std::string>& overrides = {}) {
  try {
    (void)read(text, overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::case_file);
    return error.complaints();
  }
  return {};
}

/// `text` with the first `from` replaced, which must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

} // namespace billet::io
