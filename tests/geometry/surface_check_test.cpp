#include "geometry/base/error.h"
#include "geometry/surface_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace billet::geometry::surface_check_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(SurfaceCheck, TheComplaintNamesWhatWasFoundAndWhatIsAllowed) {
  try {
    require_between(2.0, 0.0, 1.5, "half angle");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::geometry);
    EXPECT_EQ(std::string(error.what()),
              "half angle is 2; it must be between 0 and 1.5 [geometry]");
  }
}

TEST(SurfaceCheck, SoundValuesPass) {
  EXPECT_NO_THROW(require_between(1e300, 0.0, infinity, "radius"));
  EXPECT_NO_THROW(require_point({1, -2, 0}, "point"));
  EXPECT_NO_THROW(require_direction({0, 0, -1e-300}, "axis"));
  EXPECT_THROW(require_between(infinity, 0.0, infinity, "radius"), Error);
  EXPECT_THROW(require_point({1, infinity, 0}, "point"), Error);
  EXPECT_THROW(require_direction({0, 0, 0}, "axis"), Error);
}

} // namespace
} // namespace billet::geometry::surface_check_test
