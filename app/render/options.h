// The command line of billet-render.

#pragma once

#include "geometry/base/vector.h"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace billet::render {

/// What axes are called, in their order.
inline constexpr std::string_view axis_names = "xyz";

/// One curve of a chart: two columns of a table. A column written with a minus before its name is
/// drawn with the opposite sign.
struct Series {
  std::filesystem::path file; ///< .csv with a header row
  std::string x_column;
  std::string y_column;
  std::string label;
  bool points = false; ///< markers without a line: measured values
};

/// Columns of history.csv over another one.
struct Columns {
  std::string x;
  std::vector<std::string> y;
};

/// A plane across an axis.
struct AxisPlane {
  int axis = 0;    ///< 0, 1, 2: x, y, z
  double at = 0.0; ///< its coordinate [mm]
};

/// A plane with something in front of it.
struct CutPlane {
  AxisPlane plane;
  int keep = 0; ///< -1: what lies below, +1: above, 0: what the viewer looks at from the plane on
};

/// What lies in front of all planes of a cut is taken away: one plane takes a half, two a quarter.
using Cut = std::vector<CutPlane>;

/// From where a scene is looked at.
struct View {
  enum class From { usual, iso, axis, angles };
  From from = From::usual;
  Vec3 axis = Vec3::UnitZ(); ///< towards the viewer, of From::axis
  double azimuth = 0.0;      ///< about `up` [degree]
  double elevation = 0.0;    ///< above the plane across `up` [degree]
  std::optional<int> up;     ///< the axis that is drawn upwards; empty: z, in the plane y
  double zoom = 1.0;         ///< over the scale at which all is in the picture
  std::optional<Vec3> focus; ///< what is in the middle [mm]; empty: the middle of the part
};

enum class ToolStyle { glass, solid, outline, none };

/// Where a field is shown.
enum class Place { workpiece, contact, tools };

/// A frame that is asked for: the one nearest to a time, or the last.
using AskedTime = std::optional<double>;

/// Which mirror images are drawn.
struct Mirror {
  enum class Planes { usual, none, known, given };
  Planes planes = Planes::usual; ///< usual: the axis of revolution
  std::vector<AxisPlane> given;
  std::vector<int> axes; ///< of known planes; empty: all of them
};

struct SceneOptions {
  std::string field = "von_mises"; ///< "none": the part in grey
  std::optional<Place> on;         ///< empty: where the results have the field
  std::vector<AskedTime> times;    ///< a picture each, next to each other; empty: the last
  std::optional<std::filesystem::path> compare; ///< other results, next to these
  std::optional<std::array<double, 2>> range;   ///< of the colours; empty: that of the frames
  std::optional<int> bands;                     ///< colours; empty: a smooth scale
  std::optional<int> flow_lines;                ///< of each family, instead of the mesh
  bool mesh = true;                             ///< edges of elements
  Mirror mirror;
  int copies = 1;                ///< of a sector, around the axis `up`
  std::optional<double> revolve; ///< angle of the body of an axisymmetric scene [degree]
  View view;
  std::vector<Cut> cuts;
  ToolStyle tools = ToolStyle::glass;
  std::string arrows;       ///< a vector field; empty: none
  double arrow_scale = 1.0; ///< over the usual length
};

/// Which frames a film shows, in the order of the results, counted from 0.
struct FrameSlice {
  int first = 0;
  int last = std::numeric_limits<int>::max(); ///< included
  int step = 1;
};

struct FilmOptions {
  bool wanted = false;
  std::optional<double> fps;       ///< frames a second; empty: the usual rate
  std::optional<FrameSlice> slice; ///< empty: all frames

  [[nodiscard]] double rate() const { return fps.value_or(10.0); } ///< frames a second
};

struct ChartOptions {
  bool wanted = false;
  std::vector<Series> series;   ///< columns of any tables
  std::vector<Columns> columns; ///< of the results' history.csv; neither: forces over strokes
  std::string x_label, y_label;
  bool tight = false;                ///< axes need not hold zero
  std::array<bool, 2> logarithmic{}; ///< x, y
};

/// What to draw.
struct Options {
  bool help = false;
  std::optional<std::filesystem::path> output;  ///< a file or a folder; empty: with the results
  std::optional<std::array<int, 2>> size_asked; ///< [pixels]
  std::string title;                            ///< empty: that of the results

  std::vector<std::filesystem::path> results; ///< folders; of a scene one, also .pvd or .vtu
  SceneOptions scene;
  FilmOptions film;
  ChartOptions chart;

  [[nodiscard]] std::array<int, 2> size() const;
};

/// Where the picture goes: by default into the folder of the results, named after what it shows.
[[nodiscard]] std::filesystem::path picture_file(const Options& options);

/// @throws Error  (Fault::usage)
[[nodiscard]] Options parse(const std::vector<std::string>& arguments);

} // namespace billet::render
