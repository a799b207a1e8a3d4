#include "geometry/base/error.h"
#include "io/scene/scene_builder.h"
#include "mechanics/linear/multigrid/multigrid.h"
#include "tests/io/case/case_text.h"
#include "tests/support/case_texts.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::io::multigrid_case_test {
namespace {

TEST(MultigridCase, without_the_component_is_refused_with_the_remedy) {
  if (mechanics::Multigrid::is_there())
    GTEST_SKIP() << "built with BILLET_MULTIGRID";
  const Case content = read(test::upsetting + "[solver]\nlinear = \"multigrid\"\n");
  try {
    static_cast<void>(build_scene(content, "case.toml"));
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::case_file);
    EXPECT_NE(std::string(error.what()).find("./dev build --multigrid"), std::string::npos);
  }
}

} // namespace
} // namespace billet::io::multigrid_case_test
