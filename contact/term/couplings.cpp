#include "contact/term/couplings.h"

#include <algorithm>
#include <cstddef>

namespace billet::contact {

using mechanics::Coupling;

void merge(std::vector<Coupling>& couplings) {
  std::sort(couplings.begin(), couplings.end(), [](const Coupling& a, const Coupling& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < couplings.size(); ++i)
    if (kept > 0 && couplings[kept - 1].row == couplings[i].row &&
        couplings[kept - 1].column == couplings[i].column)
      couplings[kept - 1].value += couplings[i].value;
    else
      couplings[kept++] = couplings[i];
  couplings.resize(kept);
}

} // namespace billet::contact
