#include "io/case/read_case.h"
#include "tests/io/case/case_text.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billet::io::read_case_test {
namespace {

TEST(ReadCase, reads_the_whole_of_a_case_in_the_plane) {
  const Case content = read(plane_case);
  EXPECT_EQ(content.title, "upsetting");
  EXPECT_EQ(content.analysis, Analysis::axisymmetric);
  EXPECT_EQ(content.dimension(), 2);
  const auto& box = std::get<BoxMesh>(content.workpiece.mesh);
  EXPECT_EQ(box.high, Vec3(5, 7.5, 0));
  EXPECT_EQ(box.cells, (std::array{12, 18, 1}));
  EXPECT_EQ(box.grading, (std::array{1.0, 2.0, 1.0}));
  EXPECT_EQ(content.workpiece.place.rotate->axis, Vec3::UnitZ());
  const Material& steel = content.materials.at("steel");
  EXPECT_EQ(steel.elastic.young, 210000.0);
  EXPECT_EQ(*steel.density, 7.85e-9);
  EXPECT_DOUBLE_EQ(*steel.hardness, 3 * 740 * std::pow(0.01, 0.2));
  EXPECT_FALSE(content.materials.at("spring").flow);
  EXPECT_FALSE(content.materials.at("spring").hardness);
  EXPECT_EQ(std::get<InSet>(content.supports[1].where.kind).name, "bottom");
  EXPECT_EQ((*content.supports[1].move[1])(0.5), -0.25);
  EXPECT_EQ(std::get<PressureLoad>(content.loads[0].kind).pressure(1.0), 10.0);
  EXPECT_EQ(std::get<OnPlane>(content.loads[0].where.kind).value, 7.5);
  EXPECT_EQ(std::get<TractionLoad>(content.loads[1].kind).traction, Vec3(1, 2, 0));
}

TEST(ReadCase, reads_tools_and_settings) {
  const Case content = read(plane_case);
  const Tool& punch = content.tools.at(0);
  EXPECT_EQ(std::get<VelocityMotion>(*punch.motion.translation).velocity, Vec3(0, -1, 0));
  EXPECT_TRUE(punch.touch);
  EXPECT_EQ(std::get<double>(std::get<contact::Tresca>(punch.friction.law).k), 100.0);
  EXPECT_EQ(*punch.active, (std::array{0.0, 2.0}));
  const Tool& roll = content.tools.at(1);
  EXPECT_DOUBLE_EQ(std::get<RotationMotion>(*roll.motion.rotation).speed(0.0), std::numbers::pi);
  EXPECT_EQ(std::get<DisplacementMotion>(*roll.motion.translation).displacement[0](1.0), 0.5);
  const auto& coulomb = std::get<contact::Coulomb>(roll.friction.law);
  EXPECT_EQ(std::get<contact::FollowedStress>(*coulomb.cap), contact::FollowedStress::yield);
  EXPECT_EQ(content.contact.form, ContactForm::compatible);
  EXPECT_EQ(std::get<InSet>(content.contact.surface->kind).name, "skin");
  EXPECT_EQ(content.time.end, 3.0);
  EXPECT_EQ(*content.time.increments.first, 0.1);
  EXPECT_EQ(*content.stages[0].tools, (std::vector<std::string>{"punch", "die"}));
  EXPECT_TRUE(content.stages[1].unload);
  EXPECT_EQ(content.solver.linear, mechanics::SolverChoice::mumps);
  EXPECT_EQ(*content.solver.threads, 2);
  EXPECT_EQ(content.output.at, (std::vector{0.25, 1.75}));
}

TEST(ReadCase, reads_the_shapes_of_space) {
  const Case content = read(space_case);
  EXPECT_EQ(content.workpiece.element, "hex20");
  EXPECT_EQ(std::get<CylinderMesh>(content.workpiece.mesh).sector, 90);
  EXPECT_EQ(*content.materials.at("lead").hardness, 30.0);
  EXPECT_TRUE(std::get<SphereSurface>(content.tools[1].surface).inside);
  EXPECT_EQ(std::get<ConeSurface>(content.tools[2].surface).half_angle, 30.0);
  EXPECT_TRUE(std::get<TorusSurface>(content.tools[3].surface).inside);
  EXPECT_NEAR(content.tools[3].place.rotate->degrees, 90 / std::numbers::pi, 1e-13);
  const auto& turned = std::get<RevolutionSurface>(content.tools[4].surface);
  EXPECT_EQ(turned.point, Vec3(0, 0, 40));
  EXPECT_EQ(turned.axis, Vec3(0, 1, 0));
  EXPECT_EQ(turned.points.at(1), Vec2(0, 4));
  EXPECT_FALSE(turned.closed || turned.profile);
  EXPECT_TRUE(std::holds_alternative<contact::Frictionless>(content.tools[0].friction.law));
}

TEST(ReadCase, fills_in_the_defaults_of_the_format) {
  const Case content = read(space_case);
  EXPECT_EQ(content.units.name, "mm-N-s-MPa-degC");
  EXPECT_FALSE(content.temperature);
  ContactSettings contact;
  contact.form = ContactForm::mixed;
  EXPECT_EQ(content.contact, contact);
  EXPECT_EQ(content.contact.penalty, 100.0);
  EXPECT_EQ(content.contact.penalty_tangent, 10.0);
  EXPECT_EQ(content.solver.tolerance, 1e-6);
  EXPECT_FALSE(content.remesh);
}

TEST(ReadCase, converts_to_the_other_unit_system) {
  const Case content = read("units = \"m-N-s-Pa-degC\"\n" + space_case,
                            {"material.lead.elastic.young=16 GPa", "tool.a.touch=false",
                             "workpiece.mesh.cylinder.radius=10 mm"});
  EXPECT_EQ(content.materials.at("lead").elastic.young, 16e9);
  EXPECT_EQ(std::get<CylinderMesh>(content.workpiece.mesh).radius, 0.01);
  EXPECT_EQ(content.units.stress, "Pa");
}

TEST(ReadCase, reads_every_available_flow_law) {
  const std::string flow = R"(law = "table", points = [[0, 10], [0.1, 20]])";
  const auto law = [&](const std::string& keys) {
    return *read(replaced(space_case, flow, keys)).materials.at("lead").flow;
  };
  EXPECT_EQ(law(R"(law = "perfect", yield = 5)"), FlowLaw(mechanics::Perfect{5}));
  EXPECT_EQ(law(R"(law = "linear", yield = 5, hardening = 0)"), FlowLaw(mechanics::Linear{5, 0}));
  EXPECT_EQ(law(R"(law = "ludwik", yield = 5, K = 7, n = 0.5)"),
            FlowLaw(mechanics::Ludwik{5, 7, 0.5}));
  EXPECT_EQ(law(R"(law = "voce", yield = 5, saturation = 9, rate = 3)"),
            FlowLaw(mechanics::Voce{5, 9, 3}));
  EXPECT_EQ(law(R"(law = "norton-hoff", K = "5 MPa", m = 0.1)"),
            FlowLaw(mechanics::NortonHoff{5, 0.1, 0, 0, 0}));
  EXPECT_EQ(law(R"(law = "perzyna", base = { law = "perfect", yield = 5 }, eta = "1 ms", m = 0.2)"),
            FlowLaw(mechanics::Perzyna{mechanics::Perfect{5}, 1e-3, 0.2}));
  EXPECT_EQ(law(R"(law = "hansel-spittel", A = "1 GPa", m3 = 0.1)"),
            FlowLaw(mechanics::HanselSpittel{1000, 0, 0, 0.1}));
}

TEST(ReadCase, takes_the_temperature_that_a_law_asks_for_in_any_unit) {
  const std::string text = replaced(
      space_case, R"(law = "table", points = [[0, 10], [0.1, 20]])",
      R"(law = "johnson-cook", A = "90 MPa", B = 292, n = 0.31, C = 0.025, rate0 = "60 1/min", )"
      R"(m = 1.09, T_room = "293.15 K", T_melt = "1356 K")");
  const Case content = read("temperature = \"373.15 K\"\n" + text);
  EXPECT_NEAR(*content.temperature, 100.0, 1e-12);
  const auto law = std::get<mechanics::JohnsonCook>(*content.materials.at("lead").flow);
  EXPECT_NEAR(law.rate0, 1.0, 1e-15);
  EXPECT_NEAR(law.T_room, 20.0, 1e-12);
  EXPECT_NEAR(law.T_melt, 1082.85, 1e-12);
  // The default is three times the yield stress at that temperature.
  const double share = std::pow(80.0 / (1082.85 - 20.0), 1.09);
  EXPECT_NEAR(*content.materials.at("lead").hardness, 3.0 * 90.0 * (1.0 - share), 1e-9);
  EXPECT_FALSE(read("temperature = 1200\n" + text).materials.at("lead").hardness) << "molten";
}

TEST(ReadCase, takes_heating_with_density_and_heat_capacity) {
  const std::string flow = R"(flow = { law = "table", points = [[0, 10], [0.1, 20]] })";
  const auto lead = [&](const std::string& head) {
    return read(head + "temperature = 20\n" +
                replaced(space_case, flow,
                         flow + "\ndensity = \"7850 kg/m^3\"\nheat_capacity = \"460 J/kg/K\"\n"
                                "heating = 0.9"))
        .materials.at("lead");
  };
  const Material in_mm = lead("");
  EXPECT_NEAR(*in_mm.heat_capacity, 4.6e8, 1e-6);
  EXPECT_NEAR(*in_mm.density * *in_mm.heat_capacity, 3.611, 1e-12); // MPa/K
  EXPECT_EQ(*in_mm.heating, 0.9);
  const Material in_m = lead("units = \"m-N-s-Pa-degC\"\n");
  EXPECT_NEAR(*in_m.density * *in_m.heat_capacity, 3.611e6, 1e-6); // Pa/K
}

TEST(ReadCase, finds_files_beside_the_case) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  write_text(folder / "die.stl", "solid");
  write_text(folder / "part.msh", "");
  write_text(folder / "case.toml",
             replaced(replaced(space_case,
                               "cylinder = { radius = 10, height = 30 }, cells = [4, 10], "
                               "sector = 90",
                               "file = \"part.msh\""),
                      "sphere = { centre = [0, 0, 40], radius = 5 }, inside = true",
                      "stl = \"die.stl\", unit = \"in\", flip = true"));
  const Case content = read_case(folder / "case.toml");
  const auto& stl = std::get<StlSurface>(content.tools[1].surface);
  EXPECT_EQ(stl.file.given, "die.stl");
  EXPECT_TRUE(std::filesystem::equivalent(stl.file.path, folder / "die.stl"));
  EXPECT_EQ(stl.unit_factor, 25.4);
  EXPECT_EQ(stl.feature_angle, 30.0);
  EXPECT_FALSE(stl.smooth);
}

TEST(ReadCase, takes_a_step_file_without_a_unit) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  write_text(folder / "die.step", "");
  const auto surface = [&](const std::string& units, const std::string& keys) {
    write_text(folder / "case.toml",
               units + replaced(space_case,
                                "sphere = { centre = [0, 0, 40], radius = 5 }, inside = true",
                                "step = \"die.step\"" + keys));
    const Case content = read_case(folder / "case.toml");
    return std::get<StepSurface>(content.tools[1].surface);
  };
  const StepSurface plain = surface("", "");
  EXPECT_EQ(plain.file.given, "die.step");
  EXPECT_EQ(plain.unit_factor, 1.0);
  EXPECT_TRUE(plain.smooth);
  EXPECT_FALSE(plain.chord_error);
  const StepSurface full = surface("units = \"m-N-s-Pa-degC\"\n",
                                   ", chord_error = \"10 um\", smooth = false, flip = true");
  EXPECT_DOUBLE_EQ(full.unit_factor, 1e-3);
  EXPECT_DOUBLE_EQ(*full.chord_error, 1e-5);
  EXPECT_FALSE(full.smooth);
  EXPECT_TRUE(full.flip);
  EXPECT_THROW((void)surface("", ", unit = \"mm\""), Error) << "it knows its unit";
  EXPECT_THROW((void)surface("", ", chord_error = 0"), Error);
}

TEST(ReadCase, finds_the_profile_of_a_turned_tool) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  write_text(folder / "roll.toml", "points = [[9, 5], [0, 4], [-9, 5]]");
  write_text(folder / "case.toml", replaced(space_case, "points = [[9, 5], [0, \"4 mm\"], [-9, 5]]",
                                            "profile = \"roll.toml\""));
  const Case content = read_case(folder / "case.toml");
  const auto& turned = std::get<RevolutionSurface>(content.tools[4].surface);
  EXPECT_EQ(turned.profile->given, "roll.toml");
  EXPECT_TRUE(turned.points.empty());
  write_text(folder / "again.toml", resolved_toml(content));
  EXPECT_EQ(read_case(folder / "again.toml"), content);
}

TEST(ReadCase, leaves_the_folder_of_the_case_only_when_asked) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::filesystem::create_directory(folder / "inner");
  write_text(folder / "part.msh", "");
  const std::string text =
      replaced(space_case, "cylinder = { radius = 10, height = 30 }, cells = [4, 10], sector = 90",
               "file = \"../part.msh\"");
  write_text(folder / "inner" / "case.toml", text);
  std::filesystem::create_symlink(folder / "part.msh", folder / "inner" / "link.msh");
  const auto file = folder / "inner" / "case.toml";
  EXPECT_THROW((void)read_case(file), Error);
  EXPECT_THROW((void)read_case(file, {"workpiece.mesh.file=link.msh"}), Error);
  EXPECT_THROW((void)read_case(file, {"workpiece.mesh.file=" + (folder / "part.msh").string()}),
               Error);
  EXPECT_NO_THROW((void)read_case(file, {}, {.allow_outside = true}));
}

TEST(ReadCase, takes_the_compatible_form_for_remeshing_in_the_plane_alone) {
  const std::string bare = R"(
    analysis = "%"
    workpiece = { element = "quad8", material = "m", mesh = { box = [[0, 0], [1, 1]], cells = [1, 1] } }
    material.m = { elastic = { young = 1, poisson = 0 } }
    time = { end = 1 }
  )";
  const auto form = [&](const std::string& analysis, const std::string& more) {
    std::string text = bare;
    text.replace(text.find('%'), 1, analysis);
    return *read(text + more).contact.form;
  };
  EXPECT_EQ(form("axisymmetric", ""), ContactForm::mixed);
  EXPECT_EQ(form("axisymmetric", "[remesh]\n"), ContactForm::compatible);
  EXPECT_EQ(form("axisymmetric", "[remesh]\n[contact]\nform = \"mixed\"\n"), ContactForm::mixed);
}

TEST(ReadCase, reads_remeshing) {
  EXPECT_EQ(read(plane_case + "[remesh]\n").remesh, Remesh{}) << "nothing has to be given";
  const Case content = read(plane_case + R"([remesh]
when = { quality = 0.15, strain = 0.5, interval = "20 ms", penetration = "5 um" }
size = { default = 1, min = 0.2, max = 2, contact = "0.5 mm" }
element = "tri6"
keep = ["set:rim", "set:gauge mark"]
)");
  ASSERT_TRUE(content.remesh);
  EXPECT_EQ(content.remesh->quality, 0.15);
  EXPECT_EQ(content.remesh->strain, 0.5);
  EXPECT_DOUBLE_EQ(content.remesh->interval.value(), 0.02);
  EXPECT_DOUBLE_EQ(content.remesh->penetration.value(), 0.005);
  EXPECT_EQ(content.remesh->size_default, 1.0);
  EXPECT_EQ(content.remesh->size_min, 0.2);
  EXPECT_EQ(content.remesh->size_max, 2.0);
  EXPECT_EQ(content.remesh->size_contact, 0.5);
  EXPECT_EQ(content.remesh->element, "tri6");
  EXPECT_EQ(content.remesh->keep, (std::vector<std::string>{"rim", "gauge mark"}));
}

TEST(ReadCase, names_a_case_file_that_is_missing_or_a_folder) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  for (const auto& file : {folder / "none.toml", folder}) {
    try {
      (void)read_case(file);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::case_file);
      EXPECT_EQ(error.complaints().at(0).place, file.string());
    }
  }
}

TEST(ReadCase, takes_a_byte_order_mark_and_dos_line_ends) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : plane_case)
    text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(text), read(plane_case));
}

} // namespace
} // namespace billet::io::read_case_test
