// Checkpoints: a run as it is between two increments, in a file to go on from.
//
// RESULTS/checkpoints/00000123.checkpoint, numbered by increments; whole and on the disk before one
// has its name. A file is a header and sections, each with a checksum, so that no bit that is
// damaged goes unseen. What the bytes mean depends on the program: another version refuses them.
//
// Format  docs/guide/results.md

#pragma once

#include "process/scene/scene.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io {

/// A run as it is between two increments.
struct Checkpoint {
  std::string version;        ///< of billet that wrote it
  std::string title;          ///< of the case
  std::string reason;         ///< why it was written
  std::string written;        ///< date and time, UTC
  double time = 0.0;          ///< of the process [s]
  int increment = 0;          ///< accepted ones
  std::size_t stage = 0;      ///< of the case
  std::size_t n_unknowns = 0; ///< of the nodes
  std::string scene;          ///< fingerprint of mesh and tools at the start
  std::string content;        ///< the resolved case
  std::string run;            ///< of the run: process::stored
  std::string results;        ///< of what was written of it: RunRecord

  template <class Archive> void fields(Archive& archive) {
    archive(version, title, reason, written, time, increment, stage, n_unknowns, scene);
  }
};

/// Writes a checkpoint into the folder of a run's results, durably, and removes those before the
/// last two.
/// @throws Error (Fault::input_output)
void write_checkpoint(const std::filesystem::path& results, const Checkpoint& checkpoint);

/// Reads a checkpoint.
/// @throws Error (Fault::input_output) if it is not there, damaged, or of another version
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file);

/// Of the mesh, where it is held and loaded, and of the tools' surfaces: what a case file only
/// names by files.
[[nodiscard]] std::string scene_fingerprint(const process::Scene& scene);

/// Files of checkpoints in a folder of results, the latest first.
[[nodiscard]] std::vector<std::filesystem::path>
checkpoints_of(const std::filesystem::path& results);

/// Removes all of them that are later than an increment: their run has gone another way.
void remove_checkpoints_after(const std::filesystem::path& results, int increment);

/// A checkpoint and where it was found.
struct FoundCheckpoint {
  std::filesystem::path file;
  Checkpoint checkpoint;
  std::vector<std::string> notes; ///< about later ones that could not be read
};

/// The latest sound checkpoint of a folder of results.
///
/// @param time  the last one that is no later than that [s]; none: the last of all
/// @throws Error (Fault::input_output) if there is none, with what is wrong with those that are
/// there
[[nodiscard]] FoundCheckpoint latest_checkpoint(const std::filesystem::path& results,
                                                std::optional<double> time = std::nullopt);

/// What of a case may not change where a run goes on, and does: a line each, with key, what was
/// and what is. The end of the run, later stages, output and threads may.
///
/// @param before  resolved case of the run so far
/// @param now     resolved case of the run that goes on from it
/// @param stage   in which the run is
[[nodiscard]] std::vector<std::string>
changes_of_case(const std::string& before, const std::string& now, std::size_t stage);

} // namespace billet::io
