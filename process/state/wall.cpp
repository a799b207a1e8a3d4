#include "process/state/wall.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>

namespace billet::process {

std::string name_of_wall(const Wall& wall) {
  constexpr std::array<char, 3> letters{'x', 'y', 'z'};
  return wall.axis ? "the axis of revolution"
                   : fmt::format("the plane of symmetry {} = {:.6g}", letters[idx(wall.component)],
                                 wall.at);
}

} // namespace billet::process
