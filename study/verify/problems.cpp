#include "study/verify/problems.h"

#include <array>

#include "study/verify/problem.h"

namespace billet::study {

namespace {

constexpr std::array known_problems{
    Problem{"patch-plane", "elements in plane strain represent a constant stress",
            "MacNeal and Harder 1985; Hencky's elasticity", &patch_in_the_plane},
    Problem{"patch-axisymmetric", "elements of revolution represent a constant stress",
            "MacNeal and Harder 1985; Hencky's elasticity", &patch_of_revolution},
    Problem{"patch-3d", "solid elements represent a constant stress",
            "MacNeal and Harder 1985; Hencky's elasticity", &patch_in_space},
    Problem{"flow-laws", "flow laws that know no rate, at finite strain",
            "uniaxial stress in closed form", &static_flow_laws},
    Problem{"rate-laws", "flow laws that follow rate and temperature",
            "uniaxial stress at a constant true rate", &rate_flow_laws},
    Problem{"adiabatic-heating", "plastic work heats the metal",
            "Taylor and Quinney 1934; rho c dT = 0.9 sigma de", &adiabatic_heating},
    Problem{"tube", "elastic-plastic tube in plane strain; locking",
            "Hill 1950, ch. V: p = 2 k ln(b/a)", &tube_under_pressure},
    Problem{"sphere", "elastic-plastic sphere; locking", "Hill 1950, ch. V: p = 2 Y ln(b/a)",
            &sphere_under_pressure},
    Problem{"contact-patch", "contact passes a uniform pressure on", "Taylor and Papadopoulos 1991",
            &contact_patch},
    Problem{"mixed-element", "the paper's mixed contact element", "Cescotto et al., eqs 15 and 16",
            &mixed_contact_element},
    Problem{"hertz-line", "curved contact in plane strain", "Hertz 1882; Johnson 1985, ch. 4",
            &hertz_line},
    Problem{"hertz-point", "curved contact of revolution", "Hertz 1882; Johnson 1985, ch. 4",
            &hertz_point},
    Problem{"block-frictionless", "no shear without friction", "0", &frictionless_block},
    Problem{"block-sticking", "sticking: shear over elastic slip", "penalty, 10 E / h",
            &sticking_block},
    Problem{"block-coulomb", "Coulomb's law", "Cescotto et al., eq 3", &coulomb_block},
    Problem{"block-coulomb-capped", "Coulomb with threshold, second order and cap",
            "Cescotto et al., eqs 4 and 5", &capped_coulomb_block},
    Problem{"block-tresca", "constant shear", "Cescotto et al., eq 7", &tresca_block},
    Problem{"block-tresca-von-mises", "shear by the metal's own stress",
            "Cescotto et al., eq 7, generalised", &von_mises_block},
    Problem{"block-levanov", "from Coulomb to constant shear", "Levanov et al. 1976",
            &levanov_block},
    Problem{"block-shaw", "shear of the real area of contact",
            "Cescotto et al., eq 6; Bay 1987; eqs 1 and 2", &shaw_block},
    Problem{"block-asperity", "shear of the tops of asperities", "Cescotto et al., eq 8; Bay 1987",
            &asperity_block},
    Problem{"block-thick-film", "shear of a film of lubricant", "Cescotto et al., eq 9, with v / e",
            &thick_film_block},
    Problem{"block-viscoplastic", "shear by a power of the speed", "Cescotto et al., eq 10",
            &viscoplastic_block},
    Problem{"block-anisotropic", "friction by a tensor", "Cescotto et al., after eq 10",
            &anisotropic_block},
    Problem{"block-table", "friction by a table of pressure and speed", "bilinear between points",
            &table_block},
    Problem{"block-evolution", "friction that grows with the sliding distance",
            "linear between points", &evolution_block},
    Problem{"wear", "wear of a tool", "Archard 1953: V = K F s / H", &worn_floor},
    Problem{"upsetting-homogeneous", "large compression without friction",
            "uniaxial stress in closed form", &homogeneous_upsetting},
    Problem{"upsetting-slab", "a flat disk pressed with friction",
            "slab method (Siebel 1923; Hill 1950)", &slab_upsetting},
    Problem{"ring-frictionless", "a ring pressed without friction",
            "uniaxial stress: all radii grow alike", &frictionless_ring},
    Problem{"ring", "a ring pressed with friction", "Avitzur 1968, upper bound by parallel flow",
            &ring_with_friction},
    Problem{"springback-upsetting", "dies leave, the part springs back",
            "Hooke: tau / E and - nu tau / E", &springback_of_upsetting},
    Problem{"springback-bending", "a bent strip springs back",
            "Hill 1950, ch. IV; M = k t^2 / 2 (1 - (re / r)^2 / 3)", &springback_of_bending},
    Problem{"restart", "a run that was stored goes on with the same bits", "the run that went on",
            &resumed_run},
    Problem{"invariance", "place, mirror image, units and numbering change nothing",
            "the block as it is", &invariance},
};

} // namespace

std::span<const Problem> all_problems() { return known_problems; }

} // namespace billet::study
