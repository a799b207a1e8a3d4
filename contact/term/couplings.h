// Parts of the tangent that couple nodes of different faces.

#pragma once

#include "mechanics/linear/sparse_matrix.h"

#include <vector>

namespace billet::contact {

/// Sums parts of the same entry, in the order of rows and columns.
void merge(std::vector<mechanics::Coupling>& couplings);

} // namespace billet::contact
