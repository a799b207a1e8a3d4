// The frames of results: which there are, what is in one, and what its field data say. VTK in a
// header: only for sources of this folder.

#pragma once

#include "app/render/options.h"
#include "io/results/pvd.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace billet::render {

/// A frame in memory.
struct Frame {
  vtkSmartPointer<vtkUnstructuredGrid> workpiece;
  vtkSmartPointer<vtkPolyData> contact;                      ///< the faces that may touch; or null
  std::map<std::string, vtkSmartPointer<vtkPolyData>> tools; ///< by name
  double time = 0.0;                                         ///< [s]
};

/// Frames of one run, by their time. Of two at the same time, at a new mesh, the later one counts.
class Results {
public:
  /// @param path  folder of results, .pvd or .vtu
  /// @throws Error  (Fault::input_output)
  explicit Results(const std::filesystem::path& path);

  /// Rising, each once, at least one. [s]
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  /// The time of the frame nearest to the one asked for; without one, the last.
  [[nodiscard]] double nearest(const AskedTime& time) const;
  /// A frame of `times()`. The last few are kept.
  [[nodiscard]] const Frame& frame(double time) const;
  /// Of the case, or the name of the file.
  [[nodiscard]] std::string title() const;
  /// How the results are called among others: the name of their folder.
  [[nodiscard]] std::string name() const;
  /// How far the tool that travels farthest has gone, from history.csv; empty: none travels. [mm]
  [[nodiscard]] std::optional<double> stroke(double time) const;

private:
  [[nodiscard]] Frame read(double time) const;

  std::filesystem::path path_;
  std::vector<io::PvdEntry> entries_; ///< empty: one .vtu
  std::vector<double> times_;
  std::vector<std::pair<double, double>> strokes_; ///< time, way
  mutable std::deque<Frame> kept_;
};

/// The text "NAME: text" in the field data; empty if it is not there.
[[nodiscard]] std::string text_in(vtkDataObject& data, const std::string& name);

} // namespace billet::render
