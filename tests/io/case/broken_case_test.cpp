// Every kind of mistake in a case file: where it is found and what is said about it.

#include "tests/io/case/case_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace billet::io::broken_case_test {
namespace {

/// One mistake: `from` in a valid case becomes `to`.
struct Mistake {
  const std::string& text;
  std::string from;
  std::string to;
  std::string fragment; ///< of the complaint
  int lines_below = 0;  ///< the complaint's line below that of `to`; -1: somewhere above
};

/// A motion by a press that goes down.
std::string press(const std::string& keys) {
  const std::string down = keys.starts_with("direction") ? "" : ", direction = [0, -1]";
  return "{ press = { " + keys + down + " } }";
}

const std::vector<Mistake>& mistakes() {
  static const std::string& plane = plane_case;
  static const std::string& space = space_case;
  static const std::string freezing = replaced(plane, "temperature = 20\n", "temperature = 0\n");
  static const std::string untempered = replaced(plane, "temperature = 20\n", "");
  static const std::string punch = R"({ plane = { point = [0, 7.5], normal = [0, -1] } })";
  static const std::string box = "{ box = [[0, 0], [5, 7.5]], cells = [12, 18], grading = [1, 2] }";
  static const std::string swift = R"({ law = "swift", K = 740, eps0 = 0.01, n = 0.2 })";
  static const std::string tresca = R"({ law = "tresca", m = 0.08, k = "100 MPa" })";
  static const std::string velocity = R"({ velocity = [0, "-60 mm/min"] })";
  static const std::string sphere =
      "{ sphere = { centre = [0, 0, 40], radius = 5 }, inside = true }";
  static const std::vector<Mistake> all{
      // the root
      {plane, "title = \"upsetting\"", "title = 7", "title: found 7, allowed is a text"},
      {plane, "title =", "titel =", "titel: unknown key (did you mean 'title'?)"},
      {plane, "mm-N-s-MPa-degC", "mm-N-s-GPa-degC", "did you mean 'mm-N-s-MPa-degC'?"},
      {plane, "analysis = \"axisymmetric\"", "", "analysis: missing, it must be given", -1},
      {plane, "\"axisymmetric\"", "\"axisymetric\"", "did you mean 'axisymmetric'?"},
      {plane, "\"axisymmetric\"", "3", "analysis: found 3, allowed is \"plane-strain\""},
      {plane, "temperature = 20", "temperature = -300",
       "found -300, allowed is a value >= -273.15"},
      {plane, "temperature = 20", "temperature = \"20 MPa\"", "does not measure a temperature"},
      {plane, "temperature = 20", "temperature = 2024-01-01", "found a date or time"},
      {plane, "title = \"upsetting\"", "title = \"a", "not valid TOML"},
      {plane, "temperature = 20", "title = \"again\"", "not valid TOML"},
      {plane, "title = \"upsetting\"", "[=]", "'[' without a key"},
      // the workpiece
      {plane, "[workpiece]", "[workpiec]", "workpiec: unknown key (did you mean 'workpiece'?)"},
      {plane, "\"quad8\"", "\"quad9\"", "workpiece.element: found \"quad9\", allowed is \"quad8\""},
      {plane, "\"quad8\"", "\"hex20\"", "workpiece.element: found \"hex20\", allowed is \"quad8\""},
      {space, "material = \"lead\"", "material = \"lead\"\nelement = \"quad8\"",
       "found \"quad8\", allowed is \"hex20\"", 1},
      {plane, "material = \"steel\"", "material = \"stell\"", "did you mean 'steel'?"},
      {plane, "material = \"steel\"", "", "workpiece.material: missing", -1},
      {plane, box, "{}", "allowed is exactly one of the keys box, cylinder, file"},
      {plane, box, "7", "workpiece.mesh: found 7, allowed is a table"},
      {plane, "[5, 7.5]]", "[5, 7.5, 1]]",
       "workpiece.mesh.box.1: found a list of 3, allowed is a "
       "list of 2 numbers (the scene is in the plane)"},
      {plane, "[[0, 0], [5, 7.5]]", "[[5, 0], [0, 7.5]]", "the second corner must be above"},
      {plane, "[[0, 0], [5, 7.5]]", "[[-1, 0], [5, 7.5]]", "x is the radius"},
      {plane, "[12, 18]", "[12, 0]", "workpiece.mesh.cells.1: found 0, allowed is a whole number"},
      {plane, "[12, 18]", "[12, 1.5]", "found 1.5, allowed is a whole number"},
      {plane, "[12, 18]", "[12, 18, 3]", "found a list of 3, allowed is a list of 2"},
      {plane, "grading = [1, 2]", "grading = [1, -2]",
       "grading.1: found -2, allowed is a value > 0"},
      {plane, "grading =", "gradng =", "did you mean 'grading'?"},
      {plane, box, "{ cylinder = { radius = 1, height = 1 }, cells = [1, 1] }",
       "only for 3d scenes"},
      {plane, box, "{ file = \"none.msh\" }", "there is no such file"},
      {plane, box, "{ file = \"/etc/passwd\" }", "outside the folder of the case"},
      {plane, box, "{ file = \"\" }", "allowed is the name of a file"},
      {plane, box, "{ file = \".\" }", "which is not a file"},
      {plane, box, "{ file = \"none.msh\", outline = \"b\" }", "there is 'file' already"},
      {space, "sector = 90", "sector = 91", "found 91, allowed is 90, 180 or 360"},
      {plane, "{ point = [0, 0], degrees = 90 }", "{ axis = [1, 0, 0], degrees = 90 }",
       "the scene is in the plane"},
      // materials
      {plane, "\"210 GPa\"", "\"210 GPA\"", "there is no unit 'GPA'"},
      {plane, "\"210 GPa\"", "\"210 mm\"", "'mm' does not measure a stress"},
      {plane, "\"210 GPa\"", "0", "material.steel.elastic.young: found 0, allowed is a value > 0"},
      {plane, "\"210 GPa\"", "true", "found true, allowed is a number or a stress"},
      {plane, "poisson = 0.3", "poisson = 0.5", "found 0.5, allowed is -1 < value < 0.5"},
      {plane, "young = \"210 GPa\", ", "", "material.steel.elastic.young: missing"},
      {plane, "elastic = { young = \"210 GPa\", poisson = 0.3 }", "", "elastic: missing", -1},
      {plane, "\"swift\"", "\"swfit\"", "did you mean 'swift'?"},
      {plane, "law = \"swift\", ", "", "material.steel.flow.law: missing"},
      {plane, "n = 0.2", "n = 0.2, m = 1", "material.steel.flow.m: unknown key"},
      {plane, swift, R"({ law = "table", points = [] })", "found an empty list"},
      {plane, swift, R"({ law = "table", points = [[0, 1], [0, 2]] })",
       "found 0, allowed is more than the 0 of the row before"},
      {plane, swift, R"({ law = "table", points = [[0, 1, 2]] })",
       "allowed is a list of 2 numbers"},
      {plane, swift, R"({ law = "voce", yield = 3, saturation = 2, rate = 1 })",
       "found 2, allowed is no less than the yield stress 3"},
      {plane, swift, R"({ law = "norton-hoff", K = 1, m = 1.5 })",
       "material.steel.flow.m: found 1.5, allowed is 0 < value <= 1"},
      {plane, swift, R"({ law = "norton-hoff", K = "1 mm", m = 0.5 })",
       "'mm' does not measure a stress"},
      {plane, swift, R"({ law = "perzyna", base = { law = "perfect" }, eta = 1, m = 1 })",
       "material.steel.flow.base.yield: missing"},
      {plane, swift,
       R"({ law = "perzyna", base = { law = "norton-hoff", K = 1, m = 1 }, eta = 1, m = 1 })",
       "material.steel.flow.base.law: found \"norton-hoff\""},
      {plane, swift,
       "{ law = \"johnson-cook\", A = 1, B = 1, n = 1, C = 1, rate0 = 1, m = 1, T_room = 20, "
       "T_melt = 10 }",
       "found 10, allowed is more than T_room = 20"},
      {plane, swift, R"({ law = "hansel-spittel", A = 1, eps_min = 0 })",
       "eps_min: found 0, allowed is a value > 0"},
      {plane, swift, R"({ law = "hansel-spittel", A = 1, eps_max = 0 })",
       "eps_max: found 0, allowed is a value > 0"},
      {plane, swift, R"({ law = "hansel-spittel", A = 1, eps_min = 0.5, eps_max = 0.2 })",
       "eps_max: found 0.2, allowed is more than eps_min = 0.5"},
      {plane, swift, R"({ law = "hansel-spittel", A = 1, m6 = 1 })", "m6: found 1"},
      {plane, swift, R"({ law = "hansel-spittel", A = 1, m3 = 0.1, m8 = -0.01 })",
       "the flow stress falls with the rate at 20 degC"},
      {freezing, swift, R"({ law = "hansel-spittel", A = 1, m9 = 1 })",
       "needs a temperature above 0 degC"},
      {untempered, swift,
       "{ law = \"johnson-cook\", A = 1, B = 1, n = 1, C = 1, rate0 = 1, m = 1, T_room = 20, "
       "T_melt = 100 }",
       "material.steel.flow: this law needs the temperature of the workpiece"},
      {untempered, swift, R"({ law = "hansel-spittel", A = 1, m1 = -0.002 })",
       "material.steel.flow: this law needs the temperature of the workpiece"},
      {untempered, "density = \"7850 kg/m^3\"",
       "density = 7.85e-9\nheat_capacity = \"460 J/kg/K\"\nheating = 0.9",
       "material.steel.heating: heating needs the temperature", 2},
      {plane, "density = \"7850 kg/m^3\"", "heat_capacity = 4.6e8\nheating = 0.9",
       "material.steel.heating: heating needs the density of the metal", 1},
      {plane, "density = \"7850 kg/m^3\"", "density = 7.85e-9\nheating = 0.9",
       "material.steel.heating: heating needs the heat_capacity of the metal", 1},
      {plane, "density = \"7850 kg/m^3\"", "heating = 1.2",
       "heating: found 1.2, allowed is 0 < value"},
      {plane, "density = \"7850 kg/m^3\"", "heat_capacity = \"460 J/kg\"",
       "'J/kg' does not measure a heat capacity"},
      {plane, "density = \"7850 kg/m^3\"", "library = \"ofhc-coper\"",
       "did you mean 'ofhc-copper'?"},
      {plane, "\"7850 kg/m^3\"", "\"7850 kg\"", "'kg' does not measure a density"},
      // supports and loads
      {plane, "where = \"x = 0\"", "where = \"z = 0\"", "a plane of x or y"},
      {plane, "where = \"x = 0\"", "where = \"x : 0\"", "allowed is \"x = VALUE\""},
      {plane, "where = \"x = 0\"", "where = \"x = 1 s\"", "'s' does not measure a length"},
      {plane, "where = \"x = 0\"", "", "support.0.where: missing", -1},
      {plane, "fix = [\"x\"]", "fix = [\"z\"]", "support.0.fix.0: found \"z\", allowed is \"x\""},
      {plane, "fix = [\"x\"]", "fix = []", "found an empty list"},
      {plane, "fix = [\"x\"]", "", "at least one of the keys fix and move", -1},
      {plane, "move = { y =", "move = { x =", "the component is fixed already"},
      {plane, "[[0, 0], [1, -0.5]]", "[[1, 0], [0, -0.5]]", "more than the 1 of the row before"},
      {plane, "[[0, 0], [1, -0.5]]", "[]", "found an empty list"},
      {plane, "[[load]]", "[load]", "not valid TOML", -2},
      {plane, "pressure = ", "presure = ", "exactly one of the keys pressure", -1},
      {plane, "body_force = [0, -1e-4]", "body_force = [0, -1e-4]\npressure = 1",
       "the load has another kind already", -1},
      {plane, "where = \"all\"", "where = \"x = 0\"", "allowed is \"all\" for a body force"},
      // tools
      {plane, "name = \"punch\"", "", "tool.0.name: missing", -1},
      {plane, "name = \"roll\"", "name = \"punch\"", "there is a tool \"punch\" already"},
      {plane, "name = \"punch\"", "name = \"a/b\"", "allowed is a name of 1 to 64 letters"},
      {plane, punch, "{ plain = 1 }", "allowed is exactly one of the keys plane, circle"},
      {plane, punch, "{ plane = { point = [0, 7.5], normal = [0, 0] } }", "found a zero vector"},
      {plane, punch, "{ plane = { point = [0, 7.5, 0], normal = [0, 1] } }",
       "tool.punch.surface.plane.point: found a list of 3"},
      {plane, punch, "{ sphere = { centre = [0, 0], radius = 1 } }", "only for 3d scenes"},
      {plane, punch, "{ plane = { point = [0, 0], normal = [0, 1] }, circle = {} }",
       "there is 'plane' already"},
      {space, sphere, "{ circle = { centre = [0, 0, 0], radius = 1 } }",
       "only for scenes in the plane"},
      {space, sphere, "{ stl = \"none.stl\" }", "tool.b.surface.unit: missing"},
      {space, sphere, "{ stl = \"none.stl\", unit = \"kg\" }", "allowed is a unit of length"},
      {space, sphere, "{ stl = \"none.stl\", unit = \"mm\", smooth = \"yes\" }",
       "tool.b.surface.smooth: found"},
      {space, "half_angle = 30", "half_angle = 90", "found 90, allowed is 0 < value < 90"},
      {space, "minor = 5", "minor = 20", "found 20, allowed is less than major = 20"},
      {space, "minor = 5, inside = true }", "minor = 5, inside = true }, inside = true",
       "given twice"},
      {space, "points = [[9, 5], [0, \"4 mm\"], [-9, 5]]", "points = [[9, 5]]",
       "tool.e.surface.revolution.points: found a list of 1"},
      {space, "[0, \"4 mm\"]", "[0, -4]", "points.1.1: found -4, allowed is a value >= 0"},
      {space, "[0, \"4 mm\"]", "[0, 4, 0]",
       "a list of 2 numbers, height along the axis and radius"},
      {space, ", points = [[9, 5], [0, \"4 mm\"], [-9, 5]]", "",
       "tool.e.surface.revolution: allowed is exactly one of the keys profile, points"},
      {space, ", points = [[9, 5]", ", profile = \"roll.toml\", points = [[9, 5]",
       "there is 'profile' already, allowed is one of them"},
      {space, ", points = [[9, 5]", ", radius = 3, points = [[9, 5]",
       "revolution.radius: unknown key"},
      {plane, punch,
       "{ revolution = { point = [0, 0], axis = [0, 1], points = [[0, 1], [1, 1]] } }",
       "only for 3d scenes"},
      {space, "axis = [0, 1, 0], degrees", "degrees", "tool.d.place.rotate.axis: missing"},
      {plane, "radius = 2", "radius = -2", "tool.roll.surface.circle.radius: found -2"},
      {plane, "[[0, 0], [4, 0], [5, -1]]", "[[0, 0]]", "at least two points"},
      {plane, "[[0, 0], [4, 0], [5, -1]]", "[[0, 0], [0, 0]]", "the same point"},
      {plane, "[[0, 0], [4, 0], [5, -1]]", "[[0, 0], [0, \"a\"]]", "tool.die.surface.points.1.1"},
      {plane, velocity, "{ velocity = [0, \"60 mm\"] }", "'mm' does not measure a speed"},
      {plane, velocity, "{ velocity = [0, -1, 0] }", "allowed is a list of 2 numbers"},
      {plane, velocity, "{ velocity = [0, -1], displacement = [[0, 0, 0]] }", "given already"},
      {plane, velocity, "{}", "allowed is velocity, displacement"},
      {plane, "motion = " + velocity, "", "no velocity, displacement, force or press to follow", 1},
      {plane, velocity, "{ force = { direction = [1, -1], value = 1 } }",
       "found a radial part, allowed is [0, 1] or [0, -1]"},
      {plane, "rotation = {", "torque = { value = 1, point = [0, 0] }, rotation = {",
       "cannot turn by itself, allowed is force"},
      {plane, "[[0, 0, 0], [1, 0.5, 0]]", "[[0, 0], [1, 0.5]]", "allowed is a list of 3 numbers"},
      {plane, "\"30 rpm\"", "\"30 mm/s\"", "does not measure an angular speed"},
      {plane, velocity, press(R"(kind = "crnk")"), "did you mean 'crank'?"},
      {plane, velocity, press(R"(direction = [0, -1])"), "press.kind: missing"},
      {plane, velocity, press(R"(kind = "crank", radius = 2, rod = 2, speed = 1)"),
       "rod: found 2, allowed is more than the radius"},
      {plane, velocity, press(R"(kind = "crank", radius = 2, rod = 3, speed = -1)"),
       "found -1, allowed is a value >= 0"},
      {plane, velocity, press(R"(kind = "crank", radius = 2, rod = 3, speed = "1 mm/s")"),
       "does not measure an angular speed"},
      {plane, velocity, press(R"(kind = "hammer", energy = 1)"),
       "press: allowed is two of energy, mass and velocity"},
      {plane, velocity, press(R"(kind = "hammer", energy = 1, mass = 1, velocity = 1)"),
       "press: allowed is two of energy, mass and velocity"},
      {plane, velocity, press(R"(kind = "hammer", energy = "1 kg", mass = 1)"),
       "'kg' does not measure an energy"},
      {plane, velocity, press(R"(kind = "hammer", energy = 1, mass = 1, efficiency = 0)"),
       "found 0, allowed is 0 < value <= 1"},
      {plane, velocity, press(R"(kind = "hammer", energy = 1, mass = 1)"),
       "tool.punch.active: a press that strikes acts by stages", 3},
      {plane, velocity,
       R"({ press = { kind = "hammer", direction = [1, 0], mass = 1, velocity = 1 } })",
       "found a radial part, allowed is [0, 1] or [0, -1]"},
      {plane, velocity, press(R"(kind = "screw", inertia = 1, pitch = 2)"),
       "press: allowed is either energy or speed"},
      {plane, velocity, press(R"(kind = "screw", inertia = "1 kg", pitch = 2, speed = 1)"),
       "'kg' does not measure a moment of inertia"},
      {plane, velocity, press(R"(kind = "screw", inertia = 1, pitch = 2, speed = 1, rod = 2)"),
       "press.rod: unknown key"},
      {plane, "active = [0, 2]", "active = [2, 0]", "allowed is from < to"},
      {plane, "active = [0, 2]", "wear = { law = \"archard\", K = -1, hardness = 1 }",
       "tool.punch.wear.K: found -1, allowed is a value >= 0"},
      {plane, "active = [0, 2]", "wear = { law = \"archard\", K = 1 }",
       "tool.punch.wear.hardness: missing"},
      {plane, "active = [0, 2]", "wear = { law = \"archard\", K = 1, hardness = 0 }",
       "tool.punch.wear.hardness: found 0, allowed is a value > 0"},
      {plane, "active = [0, 2]",
       "wear = { law = \"archard\", K = 1, hardness = 1, K_workpiece = -1 }",
       "tool.punch.wear.K_workpiece: found -1"},
      {plane, "active = [0, 2]", "wear = { law = \"archard\", K = 1, hardness = 1, strokes = 0.5 }",
       "tool.punch.wear.strokes: found 0.5, allowed is a value >= 1"},
      {plane, "active = [0, 2]", "wear = { law = \"archard\", K = 1, hardness = 1, stroke = 5 }",
       "did you mean 'strokes'?"},
      {plane, "active = [0, 2]", "wear = { law = \"archer\", K = 1, hardness = 1 }",
       "allowed is \"archard\""},
      {plane, "touch = true", "touch = \"yes\"", "allowed is true or false"},
      {plane, tresca, R"({ law = "tresca", m = 1.5 })", "found 1.5, allowed is 0 <= value <= 1"},
      {plane, tresca, R"({ law = "tresca", m = 1, k = "shearyield" })",
       "a stress such as \"10 MPa\", \"shear-yield\" or \"von-mises\""},
      {plane, tresca, R"({ law = "tresca", m = 1, mu = 0.1 })", "tool.punch.friction.mu: unknown"},
      {plane, tresca, R"({ law = "coulomb", mu = -0.1 })", "found -0.1, allowed is a value >= 0"},
      {plane, tresca, R"({ law = "coulomb", mu = 0.1, mu2 = -1 })",
       "found -1, allowed is a value >= 0"},
      {plane, tresca, R"({ law = "thick-film", viscosity = "1 Pa", film = 1 })",
       "does not measure a viscosity"},
      {plane, tresca, R"({ law = "shaw", k = 1 })", "tool.punch.friction.f: missing"},
      {plane, tresca, R"({ law = "shaw", k = 1, real_contact = "bowden-tabor", f = 1 })",
       "friction.f: unknown key"},
      {plane, tresca, R"({ law = "asperity", m_local = 1, k = 1, f = 2 })", "friction.f: found 2"},
      {plane, tresca, R"({ law = "viscoplastic", beta = 1, v0 = 1, mv = 2 })", "mv: found 2"},
      {plane, tresca, R"({ law = "coulomb", mu = 0.1, table = [[0, 0.1], [9, 0.2]] })",
       "friction.mu: 'table' stands in its place"},
      {plane, tresca, R"({ law = "coulomb", mu2 = 0.1, table = [[0, 0.1], [9, 0.2]] })",
       "friction.mu2: does not go together"},
      {plane, tresca, R"({ law = "coulomb", table = { values = [0.1] } })",
       "friction.table: needs an axis"},
      {plane, tresca, R"({ law = "coulomb", table = { speed = [0, 1], values = [0.1] } })",
       "table.values: found a list"},
      {plane, tresca, R"({ law = "coulomb", table = { speed = [1, 0], values = [1, 2] } })",
       "increasing numbers"},
      {plane, tresca, R"({ law = "thick-film", viscosity = 1, film = 1, table = [[0, 1]] })",
       "no coefficient in whose place"},
      {plane, tresca, R"({ law = "tresca", table = [[0, 0.5], [9, 1.2]] })",
       "friction.table: found 1.2, but m and m_local are shares of k"},
      {plane, tresca, R"({ law = "asperity", k = 1, f = 1, table = [[0, 2], [9, 1]] })",
       "friction.table: found 2, but m and m_local are shares of k"},
      {plane, tresca, R"({ law = "coulomb", mu = 1, tensor = [[1, 0], [0, 1]] })",
       "needs 'direction'"},
      {plane, tresca, R"({ law = "coulomb", mu = 1, direction = [1, 0] })", "first axis of a"},
      {plane, tresca,
       R"({ law = "coulomb", mu = 1, direction = [1, 0], tensor = [[1, 3], [0, 1]] })",
       "positive definite"},
      {plane, tresca, R"({ law = "sticking", tensor = [[1, 0], [0, 1]] })", "needs 'direction'"},
      {plane, tresca, R"({ law = "sticking", evolution = [[0, 1], [1, 2]] })",
       "tool.punch.friction.evolution: the law has nothing"},
      {plane, tresca, R"({ law = "tresca", m = 0.8, evolution = [[0, 1], [5, 3]] })",
       "friction.evolution: its largest factor takes the shear to 2.4 k"},
      {plane, tresca,
       R"({ law = "asperity", m_local = 0.5, k = "shear-yield", f = 1, evolution = [[0, 1], [5, 3]] })",
       "give factors of 2 at most"},
      {plane, tresca, R"({ law = "tresca", m = 1, direction = [1, 0], tensor = [[2, 0], [0, 1]] })",
       "friction.tensor: it takes the shear to 2 k"},
      {plane, tresca,
       R"({ law = "coulomb", mu = 1, cap = "shear-yield", direction = [1, 0], tensor = [[1, 0], [0, 1.5]] })",
       "friction.tensor: it takes the shear to 1.5 k"},
      // contact
      {plane, "form = \"compatible\"", "form = \"compat\"", "allowed is \"mixed\", \"compatible\""},
      {plane, "method = \"penalty\"", "method = \"augment\"", "did you mean 'augmented'?"},
      {plane, "\"radial\"", "\"radiall\"", "did you mean"},
      {plane, "penalty = 1000", "penalty = 0", "contact.penalty: found 0, allowed is a value > 0"},
      {plane, "penalty = 1000", "max_penetration = 0", "found 0, allowed is a value > 0"},
      {plane, "penalty = 1000", "substeps = 3", "contact.substeps: only integrator"},
      {plane, "surface = \"set:skin\"", "surface = \"set:\"", "\"set:NAME\" or \"all\""},
      // time
      {plane, "end = 3\nincrements", "end = 4\nincrements", "allowed is the end 3 of the last"},
      {plane, "first = 0.1", "first = 0.6", "found 0.6, allowed is no more than max = 0.5"},
      {plane, "first = 0.1", "first = 0", "time.increments.first: found 0, allowed is a value > 0"},
      {plane, "end = 2", "end = 0", "stage.press.end: found 0, allowed is a value > 0"},
      {plane, "end = 2", "end = 3.5", "found 3, allowed is more than the end 3.5 of the stage", 5},
      {plane, "end = 2", "end = \"2 mm\"", "'mm' does not measure a time"},
      {plane, "\"punch\", \"die\"", "\"punch\", \"dye\"", "did you mean 'die'?"},
      {plane, "tools = [\"punch\", \"die\"]", "tools = []", "found an empty list"},
      {plane, "unload = true", "unload = true\ntools = [\"die\"]", "all of them leave", 1},
      {plane, "name = \"release\"", "name = \"press\"", "there is a stage \"press\" already"},
      {space, "[time]\nend = 1\n", "", "time.end: missing, it must be given", -1},
      {space, "end = 1\n", "", "time.end: missing, it must be given", -1},
      // solver, output, remesh
      {plane, "\"mumps\"", "\"mump\"", "did you mean 'mumps'?"},
      {plane, "tolerance = 1e-7", "tolerance = 1", "found 1, allowed is 0 < value < 1"},
      {plane, "threads = 2", "threads = 0", "solver.threads: found 0, allowed is a whole number"},
      {plane, "\"standard\"", "\"finest\"", "did you mean 'fine'?"},
      {plane, "threads = 2", "reproducible = true", "for any number of threads, always"},
      // measures
      {plane, "[output]", "[[measure]]\nname = \"r\"\nkind = \"barrelling\"\n[output]",
       "measure.r.tool: missing", 0},
      {plane, "[output]", "[[measure]]\nname = \"time\"\nkind = \"height\"\n[output]",
       "a column of history.csv already", 1},
      {plane, "[output]", "[[measure]]\nname = \"h\"\nkind = \"hight\"\n[output]",
       "did you mean 'height'?", 2},
      {plane, "[output]", "[[measure]]\nname = \"f\"\nkind = \"filling\"\n[output]",
       "measure.f.within: missing", 0},
      {plane, "[output]",
       "[[measure]]\nname = \"f\"\nkind = \"filling\"\nwithin = [[0, 0], [0, 1]]\n[output]",
       "the second corner must be above the first in x", 3},
      {plane, "every = 0.5", "every = -1", "output.every: found -1, allowed is a value > 0"},
      {plane, "every = 0.5", "checkpoint_every = 0", "found 0, allowed is a value > 0"},
      {plane, "every = 0.5", "checkpoint_every = \"ten min\"", "such as \"10 min\" (s, min, h)"},
      {plane, "every = 0.5", "checkpoint_every = \"10 mm\"", "or \"never\""},
      {plane, "[0.25, 1.75]", "[1.75, 0.25]", "allowed are increasing times"},
      {plane, "\"displacement\"", "\"displacment\"", "did you mean 'displacement'?"},
      {plane, "[\"displacement\", \"stress\"]", "\"every\"", "allowed is \"default\", \"all\""},
      {plane, "[output]", "[remesh]\nsize = { default = 1, max = 0.5 }\n[output]",
       "remesh.size.default: found 1, allowed is no more than max = 0.5", 1},
      {plane, "[output]", "[remesh]\nsize = { min = 2, contact = 1 }\n[output]",
       "remesh.size.min: found 2, allowed is no more than contact = 1", 1},
      {plane, "[output]", "[remesh]\nwhen = { strain = 0 }\n[output]", "remesh.when.strain", 1},
      {plane, "[output]", "[remesh]\nkeep = [\"rim\"]\n[output]", "allowed is \"set:NAME\"", 1},
      {plane, "[output]", "[remesh]\nwhen = { quality = 2 }\n[output]", "remesh.when.quality", 1},
  };
  return all;
}

int line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

int line_of(const Complaint& complaint) {
  const std::string prefix = "case.toml:";
  return complaint.place.starts_with(prefix) ? std::stoi(complaint.place.substr(prefix.size())) : 0;
}

TEST(BrokenCase, is_complained_about_where_it_is_broken) {
  EXPECT_GE(mistakes().size(), 60U);
  for (const Mistake& mistake : mistakes()) {
    SCOPED_TRACE(mistake.from + "  ->  " + mistake.to);
    const std::size_t at = mistake.text.find(mistake.from);
    const std::vector<Complaint> complaints =
        complaints_of(replaced(mistake.text, mistake.from, mistake.to));
    const auto found = std::find_if(complaints.begin(), complaints.end(), [&](const Complaint& c) {
      return c.text().find(mistake.fragment) != std::string::npos;
    });
    if (found == complaints.end()) {
      std::string all;
      for (const Complaint& complaint : complaints)
        all += complaint.text() + "\n";
      ADD_FAILURE() << "expected: " << mistake.fragment << "\nfound:\n" << all;
    } else if (mistake.lines_below >= 0) {
      EXPECT_EQ(line_of(*found), line_of(mistake.text, at) + mistake.lines_below) << found->text();
    } else if (mistake.lines_below == -1) {
      EXPECT_LE(line_of(*found), line_of(mistake.text, at)) << found->text();
    }
  }
}

TEST(BrokenCase, is_complained_about_once_for_one_mistake) {
  std::size_t more = 0;
  for (const Mistake& mistake : mistakes()) {
    const auto complaints = complaints_of(replaced(mistake.text, mistake.from, mistake.to));
    more += complaints.size() > 1 ? 1U : 0U;
    EXPECT_LE(complaints.size(), 3U) << mistake.from << "  ->  " << mistake.to;
  }
  EXPECT_LE(more, mistakes().size() / 5);
}

/// One mistake of a beginner, and all that is to be said of it.
struct BeginnersMistake {
  std::string from;
  std::string to;
  std::string complaint;
};

TEST(BrokenCase, of_a_beginner_gets_one_message_with_the_remedy) {
  const std::string tresca = R"({ law = "tresca", m = 0.08, k = "100 MPa" })";
  const std::string swift = R"({ law = "swift", K = 740, eps0 = 0.01, n = 0.2 })";
  const std::string elastic = R"(elastic = { young = "210 GPa", poisson = 0.3 })";
  const std::vector<BeginnersMistake> all{
      {tresca, R"({ law = "shear", m = 0.1 })", "did you mean 'tresca'? Its shear is m k"},
      {tresca, R"({ law = "coulomb-tresca", mu = 0.1 })", "did you mean 'coulomb'? With cap ="},
      {swift, R"({ law = "hollomon", K = 740, n = 0.2 })",
       "did you mean 'swift'? With a small eps0, such as 1e-4, it is K eps^n"},
      {swift, R"({ law = "Power Law", K = 740, n = 0.2 })", "did you mean 'swift'?"},
      {tresca, "0.1", "found 0.1, allowed is a table such as { law = \"coulomb\", mu = 0.1 }"},
      {tresca, "\"coulomb\"", "allowed is a table such as { law = \"coulomb\", mu = 0.1 }"},
      {swift, "300", "found 300, allowed is a table such as { law = \"perfect\", yield ="},
      {tresca, R"({ law = "coulomb", mu = "10 %" })",
       "found \"10 %\", allowed is a number without a unit (write 0.1)"},
      {tresca, R"({ law = "coulomb", mu = "0.1" })", "(write 0.1, without quotes)"},
      {tresca, R"({ law = "coulomb", coefficient = 0.1 })",
       "friction.coefficient: unknown key (did you mean 'mu'?)"},
      {tresca, R"({ law = "tresca", mu = 0.1 })", "friction.mu: unknown key (did you mean 'm'?)"},
      {tresca, R"({ law = "tresca", share = 0.1 })", "unknown key ('m' is missing; known are law"},
      {elastic, "elastic = { youngs_modulus = 210e3, poisson = 0.3 }",
       "elastic.youngs_modulus: unknown key (did you mean 'young'?)"},
      {elastic, R"(elastic = { young = "210 GPa", poison = 0.3 })",
       "elastic.poison: unknown key (did you mean 'poisson'?)"},
      {"\"axisymmetric\"", "\"axisym\"", "did you mean 'axisymmetric'?"},
      {"\"axisymmetric\"", "\"2D\"", "did you mean 'plane-strain'? Or 'axisymmetric'"},
      {"\"quad8\"", "\"CAX8\"", "did you mean 'quad8'?"},
      {"[workpiece]", "[part]", "part: unknown key (did you mean 'workpiece'?)"},
      {R"({ velocity = [0, "-60 mm/min"] })", "{ speed = [0, -1] }",
       "motion: found the key 'speed', allowed is velocity"},
      {"{ plane = { point = [0, 7.5], normal = [0, -1] } }",
       "{ plane = { origin = [0, 7.5], normal = [0, -1] } }",
       "plane.origin: unknown key (did you mean 'point'?)"},
      {"{ plane = { point = [0, 7.5], normal = [0, -1] } }",
       "{ plain = { point = [0, 7.5], normal = [0, -1] } }", "(did you mean 'plane'?)"},
      {"cells = [12, 18]", "elements = [12, 18]",
       "mesh.elements: unknown key (did you mean 'cells'? They are the numbers of elements"},
  };
  for (const BeginnersMistake& mistake : all) {
    SCOPED_TRACE(mistake.from + "  ->  " + mistake.to);
    const auto complaints = complaints_of(replaced(plane_case, mistake.from, mistake.to));
    ASSERT_GE(complaints.size(), 1U);
    EXPECT_EQ(complaints.size(), 1U) << complaints.back().text();
    EXPECT_NE(complaints.front().text().find(mistake.complaint), std::string::npos)
        << complaints.front().text();
  }
  const auto complaints = complaints_of(replaced(space_case, "end = 1", "t_end = 1"));
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_NE(complaints.front().text().find("time.t_end: unknown key (did you mean 'end'?)"),
            std::string::npos)
      << complaints.front().text();
}

TEST(BrokenCase, gives_all_its_errors_in_one_go_in_the_order_of_the_file) {
  std::string text = plane_case;
  text = replaced(text, "poisson = 0.3", "poisson = 0.7");
  text = replaced(text, "element = \"quad8\"", "elment = \"quad8\"");
  text = replaced(text, "penalty = 1000", "penalty = \"high\"");
  text = replaced(text, "\"mumps\"", "\"pardiso\"");
  text = replaced(text, "\"punch\", \"die\"", "\"punch\", \"anvil\"");
  const std::vector<Complaint> complaints = complaints_of(text, {"output.every=0"});
  std::vector<int> lines;
  for (const Complaint& complaint : complaints)
    lines.push_back(line_of(complaint));
  ASSERT_EQ(complaints.size(), 6U);
  EXPECT_EQ(complaints[0].place, "case.toml:7:1");
  EXPECT_TRUE(std::is_sorted(lines.begin(), lines.begin() + 5));
  EXPECT_EQ(complaints[5].place, "--set output.every=0");
}

TEST(BrokenCase, needs_everything_that_has_no_default) {
  std::string all;
  for (const Complaint& complaint : complaints_of(""))
    all += complaint.text() + "\n";
  EXPECT_EQ(all, "case.toml: analysis: missing, it must be given [key-missing]\n"
                 "case.toml: workpiece: missing, it must be given [key-missing]\n"
                 "case.toml: material: missing, it must be given [key-missing]\n"
                 "case.toml: time.end: missing, it must be given [key-missing]\n");
}

TEST(BrokenCase, shows_no_control_characters_and_no_endless_text) {
  std::string element = "\"\\u001b[31m";
  element.append(9999, 'x').append(1, '"');
  const auto complaints = complaints_of(replaced(plane_case, "\"quad8\"", element));
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_EQ(complaints[0].message.find('\x1b'), std::string::npos);
  EXPECT_LT(complaints[0].message.size(), 200U);
}

} // namespace
} // namespace billet::io::broken_case_test
