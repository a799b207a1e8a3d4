#include "io/slips/slips.h"
#include "process/setup/tool_meetings.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace billet::io {

std::vector<std::string> meeting_slips(const process::Scene& scene, const UnitSystem& units) {
  std::vector<std::string> slips;
  for (const process::ToolMeeting& m : process::tool_meetings(scene)) {
    const std::string pair = fmt::format("warning: [tools-meet] tools '{}' and '{}'",
                                         scene.tools[m.first].name, scene.tools[m.second].name);
    const std::string place = fmt::format("({:.6g}, {:.6g}, {:.6g}) {}", m.place[0], m.place[1],
                                          m.place[2], units.length);
    slips.push_back(
        m.from_start ? fmt::format("{} overlap by {:.3g} {} from t = {:.6g} {} on, deepest at {}",
                                   pair, m.depth, units.length, m.time, units.time, place)
                     : fmt::format("{} meet at t = {:.6g} {} at {} and go through each other", pair,
                                   m.time, units.time, place));
  }
  return slips;
}

} // namespace billet::io
