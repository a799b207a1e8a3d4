// The problems that `billet verify` knows, by theme. A new one is declared here and gets its line
// in problems.cpp.

#pragma once

#include <vector>

#include "study/verify/case_bench.h"
#include "study/verify/figure.h"

namespace billet::study {

// element_problems.cpp
std::vector<Figure> patch_in_the_plane(const CaseBench& bench);
std::vector<Figure> patch_of_revolution(const CaseBench& bench);
std::vector<Figure> patch_in_space(const CaseBench& bench);

// flow_law_problems.cpp
std::vector<Figure> static_flow_laws(const CaseBench& bench);
std::vector<Figure> rate_flow_laws(const CaseBench& bench);
std::vector<Figure> adiabatic_heating(const CaseBench& bench);

// limit_problems.cpp
std::vector<Figure> tube_under_pressure(const CaseBench& bench);
std::vector<Figure> sphere_under_pressure(const CaseBench& bench);

// contact_problems.cpp
std::vector<Figure> contact_patch(const CaseBench& bench);
std::vector<Figure> mixed_contact_element(const CaseBench& bench);
std::vector<Figure> hertz_line(const CaseBench& bench);
std::vector<Figure> hertz_point(const CaseBench& bench);

// friction_problems.cpp
std::vector<Figure> frictionless_block(const CaseBench& bench);
std::vector<Figure> sticking_block(const CaseBench& bench);
std::vector<Figure> coulomb_block(const CaseBench& bench);
std::vector<Figure> capped_coulomb_block(const CaseBench& bench);
std::vector<Figure> tresca_block(const CaseBench& bench);
std::vector<Figure> von_mises_block(const CaseBench& bench);
std::vector<Figure> levanov_block(const CaseBench& bench);
std::vector<Figure> shaw_block(const CaseBench& bench);
std::vector<Figure> asperity_block(const CaseBench& bench);
std::vector<Figure> thick_film_block(const CaseBench& bench);
std::vector<Figure> viscoplastic_block(const CaseBench& bench);
std::vector<Figure> anisotropic_block(const CaseBench& bench);
std::vector<Figure> table_block(const CaseBench& bench);
std::vector<Figure> evolution_block(const CaseBench& bench);
std::vector<Figure> worn_floor(const CaseBench& bench);

// forming_problems.cpp
std::vector<Figure> homogeneous_upsetting(const CaseBench& bench);
std::vector<Figure> slab_upsetting(const CaseBench& bench);
std::vector<Figure> frictionless_ring(const CaseBench& bench);
std::vector<Figure> ring_with_friction(const CaseBench& bench);

// springback_problems.cpp
std::vector<Figure> springback_of_upsetting(const CaseBench& bench);
std::vector<Figure> springback_of_bending(const CaseBench& bench);

// run_problems.cpp
std::vector<Figure> resumed_run(const CaseBench& bench);
std::vector<Figure> invariance(const CaseBench& bench);

} // namespace billet::study
