#include "contact/friction/thick_film.h"
#include "tests/support/contact_laws.h"

#include <gtest/gtest.h>

#include <array>

namespace billet::contact::thick_film_test {
namespace {

TEST(ThickFilm, IsTheShearOfANewtonianFilm) {
  // VALIDATION fri02b: eta v / e with eta = .05 MPa s, e = .002 mm.
  const ThickFilm film{0.05, 0.002};
  for (const auto& [v, shear] : {std::array{0.0, 0.0}, std::array{0.001, 0.025},
                                 std::array{1.0, 25.0}, std::array{100.0, 2500.0}})
    EXPECT_NEAR(film.slip_limit({100.0, 300.0, v}).shear, shear, 1e-12 * 2500.0) << v;
  expect_exact_slope(film, std::array{1.0, 100.0}, 300.0);
}

} // namespace
} // namespace billet::contact::thick_film_test
