// The command line of billet-render.

#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace billet::render {

/// One curve of a chart: two columns of a table. A column written with a minus before its name is
/// drawn with the opposite sign.
struct Series {
  std::filesystem::path file; ///< .csv with a header row
  std::string x_column;
  std::string y_column;
  std::string label;
  bool points = false; ///< markers without a line: measured values
};

/// What to draw.
struct Options {
  bool help = false;
  bool curves = false;                         ///< a chart, not a scene
  std::optional<std::filesystem::path> output; ///< .png, or a folder; empty: beside the results
  std::array<int, 2> size{1200, 900};          ///< [pixels]
  std::string title;                           ///< empty: that of the results

  std::filesystem::path results; ///< folder of results; of a scene also .pvd or .vtu

  // scene
  std::string field = "von_mises";
  std::optional<double> time;                 ///< nearest frame; empty: the last [s]
  std::optional<std::array<double, 2>> range; ///< of the colours; empty: that of the frame
  std::optional<int> flow_lines;              ///< of each family, instead of the mesh
  std::optional<bool> mirror;                 ///< empty: in axisymmetric scenes

  // chart
  std::vector<Series> series; ///< empty: forces over strokes of the results
  std::string x_label, y_label;
  bool tight = false; ///< axes need not hold zero
};

/// How the program is called.
[[nodiscard]] std::string usage();

/// Where the picture goes: by default into the folder of the results, named after what it shows.
[[nodiscard]] std::filesystem::path picture_file(const Options& options);

/// @throws Error  (Fault::usage)
[[nodiscard]] Options parse(const std::vector<std::string>& arguments);

} // namespace billet::render
