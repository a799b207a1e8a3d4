#include "tests/io/case/case_text.h"

#include <gtest/gtest.h>

namespace billet::io::overrides_test {
namespace {

std::string only_complaint(const std::string& override) {
  const std::vector<Complaint> complaints = complaints_of(plane_case, {override});
  EXPECT_EQ(complaints.size(), 1U) << override;
  return complaints.empty() ? "" : complaints.front().text();
}

TEST(Overrides, change_values_by_dotted_keys) {
  const Case content =
      read(plane_case, {"tool.punch.friction.m=0.2", "contact.penalty=1e4", "title=a new title",
                        "stage.press.tools=[\"punch\"]", "support.1.fix = [\"x\"]",
                        "load.0.pressure=5 MPa", "tool.\"roll\".friction.mu = 0.3 # more"});
  EXPECT_EQ(std::get<contact::Tresca>(content.tools[0].friction.law).m, 0.2);
  EXPECT_EQ(std::get<contact::Coulomb>(content.tools[1].friction.law).mu, 0.3);
  EXPECT_EQ(content.contact.penalty, 1e4);
  EXPECT_EQ(content.title, "a new title");
  EXPECT_EQ(content.stages[0].tools->size(), 1U);
  EXPECT_EQ(std::get<PressureLoad>(content.loads[0].kind).pressure(7.0), 5.0);
}

TEST(Overrides, make_tables_that_are_not_there) {
  EXPECT_EQ(*read(space_case, {"solver.threads=3"}).solver.threads, 3);
  EXPECT_EQ(read(space_case, {"material.lead={elastic={young=5,poisson=0}}"})
                .materials.at("lead")
                .elastic.young,
            5.0);
}

TEST(Overrides, reach_into_lists_by_index) {
  const Case content = read(plane_case, {"workpiece.mesh.cells.1=7", "tool.0.touch=false"});
  EXPECT_EQ(std::get<BoxMesh>(content.workpiece.mesh).cells[1], 7);
  EXPECT_FALSE(content.tools[0].touch);
}

TEST(Overrides, apply_in_order) {
  EXPECT_EQ(read(plane_case, {"contact.penalty=1", "contact.penalty=2"}).contact.penalty, 2.0);
}

TEST(Overrides, are_named_as_the_place_of_their_errors) {
  EXPECT_EQ(only_complaint("contact.penalty=-1"),
            "--set contact.penalty=-1: contact.penalty: found -1, allowed is a value > 0 "
            "[value-refused]");
  EXPECT_EQ(only_complaint("contact.penaltyy=1"),
            "--set contact.penaltyy=1: contact.penaltyy: unknown key (did you mean 'penalty'?) "
            "[key-unknown]");
  EXPECT_EQ(only_complaint("solvr.threads=1"),
            "--set solvr.threads=1: solvr: unknown key (did you mean 'solver'?) [key-unknown]");
  EXPECT_EQ(
      only_complaint("tool.pnuch.touch=true"),
      "--set tool.pnuch.touch=true: there is no tool.pnuch (did you mean 'punch'?) [key-unknown]");
  EXPECT_EQ(only_complaint("support.9.fix=[\"x\"]"),
            "--set support.9.fix=[\"x\"]: there is no support.9 (items are named by their index, 0 "
            "to 1) [key-unknown]");
  EXPECT_NE(only_complaint("workpiece.element.x=1").find("workpiece.element is \"quad8\""),
            std::string::npos);
}

TEST(Overrides, refuse_what_is_no_assignment) {
  for (const std::string text :
       {"", "a", "=1", "a.=1", ".a=1", "a..b=1", "\"a=1", "a b", "\"a\"b=1"})
    EXPECT_NE(only_complaint(text).find("KEY=VALUE"), std::string::npos) << text;
  std::string deep = "a";
  for (int i = 0; i < 30000; ++i)
    deep += ".a";
  EXPECT_NE(only_complaint(deep + "=1").find("KEY=VALUE"), std::string::npos);
}

TEST(Overrides, cannot_smuggle_in_other_keys) {
  EXPECT_NE(only_complaint("contact.penalty=1\nform=\"mixed\"").find("contact.penalty"),
            std::string::npos);
}

} // namespace
} // namespace billet::io::overrides_test
