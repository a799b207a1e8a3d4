// Who looks at a run, and how a run ends.

#pragma once

#include "process/run_reports.h"

namespace billet::process {

class Process;

/// Looks at a run.
class Observer {
public:
  virtual ~Observer() = default;
  virtual void started(const Process&) {}
  virtual void incremented(const Process&, const IncrementReport&) {}
  virtual void failed(const Process&, const PostMortem&) {}
  /// The mesh is about to be replaced.
  virtual void remeshing(const Process&) {}
  virtual void remeshed(const Process&, const RemeshReport&) {}
  virtual void finished(const Process&) {}
  /// True ends the run after this increment (a signal).
  [[nodiscard]] virtual bool stop_requested() const { return false; }
};

enum class RunStatus { done, not_converged, stopped };

} // namespace billet::process
