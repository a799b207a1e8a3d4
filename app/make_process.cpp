#include "app/make_process.h"

#include "geometry/base/error.h"
#include "io/results/frames.h"
#include "io/scene_builder.h"

#include <utility>

namespace billet::app {

ReadyProcess make_process(const io::Case& content, const std::string& file) {
  try {
    io::require_known_fields(content.output, file);
    io::BuiltScene built = io::build_scene(content, file);
    return {std::make_unique<process::Process>(std::move(built.scene)), std::move(built.notes)};
  } catch (const Error& error) {
    std::vector<Complaint> complaints = error.complaints();
    for (Complaint& complaint : complaints)
      if (complaint.place.empty())
        complaint.place = file;
    throw Error(error.fault(), std::move(complaints));
  }
}

} // namespace billet::app
