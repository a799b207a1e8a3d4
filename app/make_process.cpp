#include "app/make_process.h"

#include "geometry/base/error.h"
#include "io/results/frames.h"
#include "io/scene/scene_builder.h"
#include "io/slips/slips.h"
#include "process/setup/tool_meetings.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace billet::app {

namespace {

/// Tools that go through each other: legal, for they do not feel it, and hardly ever meant.
void note_meetings(const process::Scene& scene,
                   const io::UnitSystem& units,
                   std::vector<std::string>& notes) {
  for (const process::ToolMeeting& m : process::tool_meetings(scene)) {
    const std::string pair = fmt::format("warning: [tools-meet] tools '{}' and '{}'",
                                         scene.tools[m.first].name, scene.tools[m.second].name);
    const std::string place = fmt::format("({:.6g}, {:.6g}, {:.6g}) {}", m.place[0], m.place[1],
                                          m.place[2], units.length);
    notes.push_back(
        m.from_start ? fmt::format("{} overlap by {:.3g} {} from t = {:.6g} {} on, deepest at {}",
                                   pair, m.depth, units.length, m.time, units.time, place)
                     : fmt::format("{} meet at t = {:.6g} {} at {} and go through each other", pair,
                                   m.time, units.time, place));
  }
}

} // namespace

ReadyProcess make_process(const io::Case& content, const std::string& file, const io::Say& say) {
  std::vector<std::string> notes;
  try {
    io::require_known_fields(content.output, file);
    notes = io::number_slips(content);
    io::BuiltScene built = io::build_scene(content, file, say);
    std::move(built.notes.begin(), built.notes.end(), std::back_inserter(notes));
    auto process = std::make_unique<process::Process>(std::move(built.scene));
    note_meetings(process->view().scene, content.units, notes);
    for (std::string& slip : io::scene_slips(content, process->view()))
      notes.push_back(std::move(slip));
    std::optional<CostEstimate> cost;
    if (std::ssize(process->view().positions()) > many_unknowns) {
      cost = cost_estimate(process->view().scene);
      if (const std::optional<std::string> warning = memory_warning(*cost))
        notes.push_back(*warning);
    }
    return {std::move(process), std::move(notes), cost};
  } catch (const Error& error) {
    std::vector<Complaint> complaints = error.complaints();
    for (Complaint& complaint : complaints)
      if (complaint.place.empty())
        complaint.place = file;
    // A die in the wrong unit is warned of, then missed by the workpiece: the warning explains it.
    for (const std::string& note : notes)
      if (note.starts_with("warning: "))
        complaints.push_back({file, note, ""});
    throw Error(error.fault(), std::move(complaints));
  }
}

} // namespace billet::app
