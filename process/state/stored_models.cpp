#include "process/state/stored_models.h"

#include "geometry/base/error.h"
#include "process/state/attempt.h"
#include "process/state/model.h"
#include "process/state/state.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace billet::process {

namespace {

/// The states of those of the models that a run has.
template <class Archive, class... Model> void archive_present(Archive& archive, Model&... models) {
  ((models ? archive(*models) : void()), ...);
}

template <class T> bool has(const Owned<T>& model) { return static_cast<bool>(model); }

} // namespace

void another_scene(const std::string& what) {
  throw Error(Fault::input_output, "", "the stored run has other " + what + " than this case",
              "resume it with the case that it was run with");
}

void store_models(const Run& run, ArchiveWriter& archive) {
  archive(static_cast<std::uint64_t>(run.model.tools.size()));
  for (const contact::Tool& tool : run.model.tools)
    archive(tool.motion.offset, tool.motion.rests_from);
  archive(*run.model.bulk, static_cast<std::uint64_t>(run.model.loads.size()));
  for (const auto& load : run.model.loads)
    archive(*load);
  for (const auto& load : run.model.decaying)
    archive(*load);
  archive(has(run.model.stabilization), has(run.model.contact), has(run.model.self_contact),
          has(run.model.trapped), has(run.model.blows), has(run.model.wear));
  archive_present(archive, run.model.stabilization, run.model.contact, run.model.self_contact,
                  run.model.trapped, run.model.blows, run.model.wear);
}

void restore_models(Run& run, ArchiveReader& archive) {
  std::uint64_t n_tools = 0;
  archive(n_tools);
  if (n_tools != run.tools().size())
    another_scene("tools");
  for (contact::Tool& tool : run.model.tools)
    archive(tool.motion.offset, tool.motion.rests_from);
  std::uint64_t n_loads = 0;
  archive(*run.model.bulk, n_loads);
  if (n_loads != run.model.loads.size())
    another_scene("loads");
  for (const auto& load : run.model.loads)
    archive(*load);
  for (const auto& load : run.model.decaying)
    archive(*load);
  bool grounded = false, touches = false, touches_itself = false, traps = false, strikes = false,
       wears = false;
  archive(grounded, touches, touches_itself, traps, strikes, wears);
  if (grounded != has(run.model.stabilization) || touches != has(run.model.contact) ||
      touches_itself != has(run.model.self_contact) || traps != has(run.model.trapped) ||
      strikes != has(run.model.blows) || wears != has(run.model.wear))
    another_scene("supports, tools, presses or laws of wear");
  archive_present(archive, run.model.stabilization, run.model.contact, run.model.self_contact,
                  run.model.trapped, run.model.blows, run.model.wear);
}

std::string present(const Run& run) {
  ArchiveWriter archive;
  archive(run.state, run.attempt);
  store_models(run, archive);
  return archive.take();
}

void put_back(Run& run, std::string_view present) {
  ArchiveReader archive(present);
  State state(run.tools().size());
  Attempt attempt;
  archive(state, attempt);
  state.part = run.state.part;
  run.state = std::move(state);
  run.attempt = std::move(attempt);
  restore_models(run, archive);
}

} // namespace billet::process
