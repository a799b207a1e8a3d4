// Loads that nothing answers: a force that pulls its tool off, a torque that nothing balances.

#include "geometry/base/error.h"
#include "process/tools/drives.h"
#include "tests/support/contact_scenes.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::process::drives_test {
namespace {

using Contact = DriveState::Contact;

TEST(Drives, AForcePressesPullsOffOrMeetsNothing) {
  std::vector<contact::PointHistory> history(3);
  EXPECT_EQ(contact_under(history, Vec3::UnitZ()), Contact::none);
  history[1].normal = Vec3::UnitZ();
  EXPECT_EQ(contact_under(history, Vec3::UnitZ()), Contact::presses);
  EXPECT_EQ(contact_under(history, Vec3::UnitX()), Contact::presses) << "along the part";
  EXPECT_EQ(contact_under(history, -Vec3::UnitZ()), Contact::pulls_off);
  history[2].normal = -Vec3::UnitZ(); // a tool that grips the part from both sides
  EXPECT_EQ(contact_under(history, -Vec3::UnitZ()), Contact::presses);
}

TEST(Drives, WhatIsWrongIsNamed) {
  EXPECT_EQ(complaint_about({0, false, 0.0, 0.0, Contact::pulls_off}, "die"), "");
  EXPECT_EQ(complaint_about({0, false, 100.0, 0.0, Contact::presses}, "die"), "");
  EXPECT_EQ(complaint_about({0, true, 100.0, 95.0, Contact::presses}, "die"), "");
  EXPECT_NE(complaint_about({0, false, 100.0, 0.0, Contact::pulls_off}, "die")
                .find("pulls tool 'die' off the workpiece"),
            std::string::npos);
  EXPECT_NE(complaint_about({0, false, 100.0, 0.0, Contact::none}, "die").find("has left"),
            std::string::npos);
  EXPECT_NE(complaint_about({0, true, 100.0, 3.0, Contact::presses}, "die")
                .find("nothing balances the torque of 100 on tool 'die': contact and friction "
                      "answer with 3"),
            std::string::npos);
}

/// A billet under a flat die with a force along y.
Scene under_force(const TimeFunction& force) {
  Scene scene = billet_scene(ElementKind::quad8, 3, 4, contact::Coulomb{0.1}, 0.1);
  scene.touch = {0};
  scene.tools[0].motion.velocity.reset();
  scene.tools[0].motion.force = geometry::Drive{Vec3::Zero(), Vec3(0, 1, 0), force};
  scene.stages[0].end = 1.0;
  return scene;
}

TEST(Drives, AForceThatPullsItsToolOffFromTheStartIsRefused) {
  try {
    const Process process(under_force(TimeFunction(1000.0)));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::case_file);
    EXPECT_NE(std::string(error.what()).find("pulls it off the workpiece"), std::string::npos)
        << error.what();
  }
  EXPECT_NO_THROW(Process(under_force(TimeFunction(-1000.0))));
}

TEST(Drives, AForceThatPullsItsToolOffLaterEndsTheRunWithThatReason) {
  const FinishedRun done =
      run(under_force(TimeFunction({{0.0, 0.0}, {0.5, -1000.0}, {1.0, 1000.0}})));
  ASSERT_EQ(done.status, RunStatus::not_converged);
  const PostMortem& post = done.recorder.failures[0];
  EXPECT_NE(post.reason.find("off the workpiece"), std::string::npos) << post.reason;
  ASSERT_EQ(post.drives.size(), 1u);
  EXPECT_EQ(post.drives[0].contact, Contact::pulls_off);
}

TEST(Drives, ATorqueThatNothingBalancesEndsTheRunWithThatReason) {
  Upsetting u = bar_upsetting(ElementKind::hex8);
  Scene scene = upsetting_scene(std::move(u));
  scene.tools[0].motion.torque =
      geometry::Drive{Vec3::Zero(), Vec3::UnitZ(), TimeFunction({{0.0, 0.0}, {1.5, 1e5}})};
  const FinishedRun done = run(std::move(scene));
  ASSERT_EQ(done.status, RunStatus::not_converged);
  const PostMortem& post = done.recorder.failures[0];
  EXPECT_NE(post.reason.find("nothing balances the torque"), std::string::npos) << post.reason;
}

} // namespace
} // namespace billet::process::drives_test
