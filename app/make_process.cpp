#include "app/make_process.h"

#include "geometry/base/error.h"
#include "io/results/frames.h"
#include "io/scene_builder.h"

#include <string>
#include <utility>
#include <vector>

namespace billet::app {

ReadyProcess make_process(const io::Case& content, const std::string& file) {
  std::vector<std::string> notes;
  try {
    io::require_known_fields(content.output, file);
    io::BuiltScene built = io::build_scene(content, file);
    notes = std::move(built.notes);
    auto process = std::make_unique<process::Process>(std::move(built.scene));
    return {std::move(process), std::move(notes)};
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
