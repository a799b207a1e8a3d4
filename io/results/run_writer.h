// Writes the results of a run as it goes: frames for ParaView, tables, the summary.
//
// DIR/<case>.pvd, DIR/frames/, DIR/history.csv, DIR/iterations.csv, DIR/summary.json,
// DIR/case.resolved.toml; DIR/remesh.csv with one row per remeshing; DIR/failure/ when an increment
// cannot be solved. Every file is written under a temporary name and renamed, the tables grow by
// whole rows. The folder is locked as long as the writer lives. What the summary describes is on
// the disk before the summary is.

#pragma once

#include "io/case/case.h"
#include "io/results/checkpoint.h"
#include "io/results/csv_writer.h"
#include "io/results/folder_lock.h"
#include "io/results/frames.h"
#include "io/results/pvd.h"
#include "io/results/run_record.h"
#include "io/results/summary.h"
#include "process/loop/process.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace billet::io {

/// Where a run begins.
struct RunBeginning {
  /// What it goes on from; null: the start of its case.
  const Checkpoint* checkpoint = nullptr;
  bool same_folder = true; ///< it goes on with the tables and frames that are there
};

class RunWriter final : public process::Observer {
public:
  /// Makes the folder and writes the resolved case.
  /// @throws Error (Fault::input_output), also if another run writes there
  RunWriter(std::filesystem::path folder,
            std::string name,
            const Case& content,
            RunFacts facts,
            const RunBeginning& beginning = {});
  /// Lists the frames of a run that broke off.
  ~RunWriter() override;
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;

  void started(const process::Run& run) override;
  void resumed(const process::Run& run) override;
  [[nodiscard]] bool wants_checkpoint(const process::Run& run,
                                      process::CheckpointReason reason) override;
  void checkpoint(const process::Run& run, const std::string& stored) override;
  void incremented(const process::Run& run, const process::IncrementReport& report) override;
  void failed(const process::Run& run, const process::PostMortem& post) override;
  void remeshing(const process::Run& run) override;
  void remeshed(const process::Run& run, const process::RemeshReport& report) override;
  void finished(const process::Run& run) override;

  /// Writes summary.json; last of all.
  ///
  /// @param warnings  of the run, see `warnings`
  void write_summary(const process::Run& run, const RunEnd& end, std::vector<std::string> warnings);

  /// How long run.log was when the run was stored; none: this run begins its log [byte].
  [[nodiscard]] std::optional<std::uintmax_t> size_of_log() const;

  /// Of each tool, shape (n_tools); empty: there has been no increment.
  [[nodiscard]] const std::vector<LargestForce>& largest_forces() const {
    return record_.largest_forces;
  }

  /// What a person should know about the quality of the result; empty: nothing.
  [[nodiscard]] std::vector<std::string> warnings(const process::Run& run) const;

  /// What may help a run that could not go on; empty: it could.
  [[nodiscard]] std::vector<std::string> advice(const process::Run& run) const;

private:
  void note_unmet_tools(const process::Run& run, const process::IncrementReport& report);
  void warn_of_unmet_tools(const process::Run& run, std::vector<std::string>& lines) const;
  void warn_of_penetration(std::vector<std::string>& lines) const;
  void warn_of_elements(const process::Run& run, std::vector<std::string>& lines) const;
  [[nodiscard]] std::string early_end(const process::Run& run) const;
  void warn_of_metal(const process::Run& run, std::vector<std::string>& lines) const;
  void write_frame(const process::Run& run);
  void write_list();
  void synchronize_results() const;
  [[nodiscard]] bool frame_due(double time) const;

  std::filesystem::path folder_;
  std::optional<FolderLock> lock_; ///< outlives what writes there
  std::string name_;
  const Case* content_;
  RunFacts facts_;
  FrameSettings settings_;
  double every_;
  RunBeginning beginning_;
  double stored_at_ = 0.0;   ///< when the run was stored last, time of the process [s]
  double stored_wall_ = 0.0; ///< the same by the wall clock [s]
  process::CheckpointReason reason_ = process::CheckpointReason::due;
  std::optional<CsvWriter> history_;
  std::optional<CsvWriter> iterations_;
  double listed_ = -HUGE_VAL; ///< when the list of frames was written last [s]
  std::size_t n_listed_ = 0;  ///< entries that it had
  std::optional<process::PostMortem> post_;
  RunRecord record_;
};

} // namespace billet::io
