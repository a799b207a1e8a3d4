#include "app/make_process.h"

#include "app/explanations.h"
#include "geometry/base/error.h"
#include "io/results/frames.h"
#include "io/scene/scene_builder.h"
#include "io/slips/slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace billet::app {

namespace {

/// A warning as it is written among errors: with its code at the end.
Complaint as_complaint(const std::string& file, const std::string& warning) {
  for (const Explanation& one : explanations()) {
    const std::string begin = fmt::format("warning: [{}] ", one.code);
    if (warning.starts_with(begin))
      return {file, "warning: " + warning.substr(begin.size()), "", one.code};
  }
  return {file, warning, ""};
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
    for (std::string& slip : io::meeting_slips(process->view().scene, content.units))
      notes.push_back(std::move(slip));
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
        complaints.push_back(as_complaint(file, note));
    throw Error(error.fault(), std::move(complaints));
  }
}

} // namespace billet::app
