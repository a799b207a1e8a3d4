// Who looks at a run, and how a run ends.

#pragma once

#include "process/reports/run_reports.h"

#include <string>

namespace billet::process {

struct Run;

/// Why a run may be stored.
enum class CheckpointReason {
  due,       ///< it goes on: it is up to the observer whether it is time
  new_stage, ///< a stage has ended, another one follows
  end,       ///< of the run
  stopped,   ///< by a signal
  failed     ///< an increment could not be solved
};

/// Looks at a run.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void started(const Run&) {}
  /// In place of `started`: the run goes on from a checkpoint.
  virtual void resumed(const Run&) {}
  virtual void incremented(const Run&, const IncrementReport&) {}
  virtual void failed(const Run&, const PostMortem&) {}
  /// The mesh is about to be replaced.
  virtual void remeshing(const Run&) {}
  virtual void remeshed(const Run&, const RemeshReport&) {}
  virtual void finished(const Run&) {}
  /// Whether the run should be stored now, at the beginning of an increment.
  [[nodiscard]] virtual bool wants_checkpoint(const Run&, CheckpointReason) { return false; }
  /// The run as it is now; taken only where one was wanted.
  virtual void checkpoint(const Run&, const std::string& /*stored*/) {}
  /// True ends the run after this increment (a signal).
  [[nodiscard]] virtual bool stop_requested() const { return false; }
};

enum class RunStatus { done, not_converged, stopped };

} // namespace billet::process
