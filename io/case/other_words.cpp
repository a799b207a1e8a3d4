#include "io/case/other_words.h"

#include "io/text/text.h"

#include <algorithm>
#include <array>

namespace billet::io {

namespace {

struct OtherWord {
  std::string_view theirs; ///< small letters, "-" for blanks and underscores
  std::string_view ours;
  std::string_view remark = {};
};

namespace remark {

constexpr std::string_view power_law = "With a small eps0, such as 1e-4, it is K eps^n";
constexpr std::string_view strain_points = "Its points are [[strain, stress], ...]";
constexpr std::string_view capped = "With cap = \"shear-yield\" the metal's strength limits it";
constexpr std::string_view tangent = "It is dsigma/deps over plastic strain, E Et / (E - Et)";
constexpr std::string_view half = "It is half of a diameter";
constexpr std::string_view in_friction = "Such as friction = { law = \"coulomb\", mu = 0.1 }";
constexpr std::string_view in_elastic = "Such as elastic = { young = \"210 GPa\", poisson = 0.3 }";
constexpr std::string_view in_flow = "Such as flow = { law = \"perfect\", yield = \"300 MPa\" }";
constexpr std::string_view linear_locks = "Linear triangles and tetrahedra are too stiff";
constexpr std::string_view or_round = "Or 'axisymmetric', of a round part";
constexpr std::string_view longest = "Such as increments = { max = 0.1 }, a time";
constexpr std::string_view count = "They are the numbers of elements in each direction";

} // namespace remark

constexpr std::array other_words{
    // flow laws
    OtherWord{"hollomon", "swift", remark::power_law},
    OtherWord{"holloman", "swift", remark::power_law},
    OtherWord{"power", "swift", remark::power_law},
    OtherWord{"power-law", "swift", remark::power_law},
    OtherWord{"krupkowski", "swift"},
    OtherWord{"perfectly-plastic", "perfect"},
    OtherWord{"elastic-perfectly-plastic", "perfect"},
    OtherWord{"ideal", "perfect"},
    OtherWord{"ideally-plastic", "perfect"},
    OtherWord{"rigid-plastic", "perfect"},
    OtherWord{"bilinear", "linear"},
    OtherWord{"isotropic", "linear"},
    OtherWord{"linear-hardening", "linear"},
    OtherWord{"multilinear", "table", remark::strain_points},
    OtherWord{"tabular", "table", remark::strain_points},
    OtherWord{"tabulated", "table", remark::strain_points},
    OtherWord{"curve", "table", remark::strain_points},
    OtherWord{"norton", "norton-hoff"},
    OtherWord{"hoff", "norton-hoff"},
    OtherWord{"cowper-symonds", "perzyna", "Its eta is 1/D, its m is 1/p"},
    OtherWord{"jc", "johnson-cook"},
    OtherWord{"spittel", "hansel-spittel"},
    // friction laws
    OtherWord{"shear", "tresca", "Its shear is m k"},
    OtherWord{"shear-friction", "tresca", "Its shear is m k"},
    OtherWord{"constant-shear", "tresca", "Its shear is m k"},
    OtherWord{"friction-factor", "tresca", "Its shear is m k"},
    OtherWord{"amontons", "coulomb"},
    OtherWord{"hybrid", "coulomb", remark::capped},
    OtherWord{"coulomb-tresca", "coulomb", remark::capped},
    OtherWord{"orowan", "coulomb", remark::capped},
    OtherWord{"wanheim-bay", "shaw"},
    OtherWord{"none", "frictionless"},
    OtherWord{"no-friction", "frictionless"},
    OtherWord{"smooth", "frictionless"},
    OtherWord{"slip", "frictionless"},
    OtherWord{"stick", "sticking"},
    OtherWord{"no-slip", "sticking"},
    OtherWord{"rough", "sticking"},
    OtherWord{"bonded", "sticking"},
    OtherWord{"tied", "sticking"},
    // analyses
    OtherWord{"2d", "plane-strain", remark::or_round},
    OtherWord{"plane", "plane-strain", remark::or_round},
    OtherWord{"planar", "plane-strain", remark::or_round},
    OtherWord{"axi", "axisymmetric"},
    OtherWord{"axisym", "axisymmetric"},
    OtherWord{"rotational", "axisymmetric"},
    OtherWord{"solid", "3d"},
    OtherWord{"space", "3d"},
    // elements
    OtherWord{"cpe4", "quad4"},
    OtherWord{"cpe4r", "quad4"},
    OtherWord{"cax4", "quad4"},
    OtherWord{"cax4r", "quad4"},
    OtherWord{"cpe8", "quad8"},
    OtherWord{"cpe8r", "quad8"},
    OtherWord{"cax8", "quad8"},
    OtherWord{"cax8r", "quad8"},
    OtherWord{"cpe6", "tri6"},
    OtherWord{"cax6", "tri6"},
    OtherWord{"tri3", "tri6", remark::linear_locks},
    OtherWord{"cpe3", "tri6", remark::linear_locks},
    OtherWord{"cax3", "tri6", remark::linear_locks},
    OtherWord{"c3d8", "hex8"},
    OtherWord{"c3d8r", "hex8"},
    OtherWord{"c3d8i", "hex8"},
    OtherWord{"brick", "hex8"},
    OtherWord{"c3d20", "hex20"},
    OtherWord{"c3d20r", "hex20"},
    OtherWord{"c3d10", "tet10"},
    OtherWord{"c3d10m", "tet10"},
    OtherWord{"tet4", "tet10", remark::linear_locks},
    OtherWord{"c3d4", "tet10", remark::linear_locks},
    // keys of materials
    OtherWord{"e", "young"},
    OtherWord{"e-modulus", "young"},
    OtherWord{"youngs-modulus", "young"},
    OtherWord{"young-modulus", "young"},
    OtherWord{"elastic-modulus", "young"},
    OtherWord{"modulus", "young"},
    OtherWord{"nu", "poisson"},
    OtherWord{"poissons-ratio", "poisson"},
    OtherWord{"poisson-ratio", "poisson"},
    OtherWord{"e", "elastic", remark::in_elastic},
    OtherWord{"young", "elastic", remark::in_elastic},
    OtherWord{"nu", "elastic", remark::in_elastic},
    OtherWord{"poisson", "elastic", remark::in_elastic},
    OtherWord{"sigma-y", "yield"},
    OtherWord{"sigma0", "yield"},
    OtherWord{"yield-stress", "yield"},
    OtherWord{"yield-strength", "yield"},
    OtherWord{"rp02", "yield"},
    OtherWord{"yield", "flow", remark::in_flow},
    OtherWord{"yield-stress", "flow", remark::in_flow},
    OtherWord{"plastic", "flow", remark::in_flow},
    OtherWord{"strength-coefficient", "K"},
    OtherWord{"hardening-exponent", "n"},
    OtherWord{"exponent", "n"},
    OtherWord{"h", "hardening"},
    OtherWord{"tangent-modulus", "hardening", remark::tangent},
    OtherWord{"hardening-modulus", "hardening"},
    OtherWord{"prestrain", "eps0"},
    OtherWord{"epsilon0", "eps0"},
    OtherWord{"rho", "density"},
    OtherWord{"cp", "heat_capacity"},
    // keys of friction
    OtherWord{"coefficient", "mu"},
    OtherWord{"coeff", "mu"},
    OtherWord{"friction-coefficient", "mu"},
    OtherWord{"factor", "m"},
    OtherWord{"friction-factor", "m"},
    OtherWord{"shear-factor", "m"},
    OtherWord{"mu", "friction", remark::in_friction},
    OtherWord{"m", "friction", remark::in_friction},
    // keys of surfaces and motions
    OtherWord{"origin", "point"},
    OtherWord{"position", "point"},
    OtherWord{"center", "centre"},
    OtherWord{"origin", "centre"},
    OtherWord{"plain", "plane"},
    OtherWord{"flat", "plane"},
    OtherWord{"r", "radius"},
    OtherWord{"d", "radius", remark::half},
    OtherWord{"diameter", "radius", remark::half},
    OtherWord{"direction", "normal"},
    OtherWord{"speed", "velocity"},
    OtherWord{"v", "velocity"},
    OtherWord{"omega", "rotation"},
    OtherWord{"omega", "speed"},
    OtherWord{"stroke", "displacement", "Its rows are [time, x, y] or [time, x, y, z]"},
    OtherWord{"travel", "displacement", "Its rows are [time, x, y] or [time, x, y, z]"},
    OtherWord{"velocity", "motion", "Such as motion = { velocity = [0, -1] }"},
    OtherWord{"speed", "motion", "Such as motion = { velocity = [0, -1] }"},
    // sections and times
    OtherWord{"part", "workpiece"},
    OtherWord{"body", "workpiece"},
    OtherWord{"billet", "workpiece"},
    OtherWord{"blank", "workpiece"},
    OtherWord{"boundary", "support"},
    OtherWord{"constraint", "support"},
    OtherWord{"bc", "support"},
    OtherWord{"symmetry", "support"},
    OtherWord{"die", "tool"},
    OtherWord{"punch", "tool"},
    OtherWord{"force", "load"},
    OtherWord{"pressure", "load"},
    OtherWord{"duration", "end"},
    OtherWord{"t-end", "end"},
    OtherWord{"tend", "end"},
    OtherWord{"end-time", "end"},
    OtherWord{"total-time", "end"},
    OtherWord{"dt", "increments", remark::longest},
    OtherWord{"step", "increments", remark::longest},
    OtherWord{"steps", "increments", remark::longest},
    OtherWord{"time-step", "increments", remark::longest},
    OtherWord{"elements", "cells", remark::count},
    OtherWord{"size", "cells", remark::count},
};

std::string plain(std::string_view text) {
  std::string result = in_small_letters(text);
  for (char& c : result)
    if (c == ' ' || c == '_')
      c = '-';
  return result;
}

} // namespace

std::optional<OurWord> our_word(std::string_view theirs, const std::vector<std::string>& known) {
  const std::string word = plain(theirs);
  for (const OtherWord& other : other_words)
    if (other.theirs == word && std::find(known.begin(), known.end(), other.ours) != known.end())
      return OurWord{other.ours, other.remark};
  return std::nullopt;
}

} // namespace billet::io
