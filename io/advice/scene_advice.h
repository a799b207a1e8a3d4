// Advice: what a scene could do without, and what it leaves out that matters.
//
// A whole billet where a half would do, a blow so fast that its heat stays in the metal, a pressure
// that a die does not bear: the case is right as it stands, and another model of it is cheaper or
// nearer to the truth. Each piece says the number that it rests on. Unlike slips, which are hardly
// ever meant, advice is for the one who sets a case up: `check` prints it, `run` does not.
//
// Numbers are estimates from the part as it lies at the start and from prescribed motions. What
// nobody can know before (loads that drive tools, rolls) is not guessed, and nothing is said of it.
// Guide: docs/guide/case-file.md, "Advice".

#pragma once

#include "io/case/case.h"
#include "process/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// One piece of advice.
struct Advice {
  enum class Kind {
    symmetry,     ///< a half of the scene would do
    plane_strain, ///< ... a section of a solid of equal sections
    axisymmetric, ///< ... a meridian of a solid of revolution
    idle_tool,    ///< a tool that never acts or is never reached
    die_pressure, ///< near what a die of steel bears
    heating,      ///< work of the metal that heats it
    chill,        ///< dies that cool it
    inertia,      ///< too fast to be in equilibrium
    rate,         ///< a flow law that lacks the rate
    buckling,     ///< too slender to be upset
  };
  Kind kind;
  std::string text; ///< one sentence or two, with the number, without "advice: "
};

/// The code of `billet explain`: "plane-strain".
[[nodiscard]] std::string_view code_of(Advice::Kind kind);

/// All that is to be said of a scene, savings first; empty: nothing.
///
/// @param scene  of that case, with its tools where they start
/// @pre content.tools and scene.tools are the same tools in the same order
[[nodiscard]] std::vector<Advice> scene_advice(const Case& content, const process::Scene& scene);

} // namespace billet::io
