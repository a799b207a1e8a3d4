// Pictures of frames of results: the part coloured by a field, its elements, the tools.
//
// A picture shows one frame, or several next to each other. All pictures of a film, and all parts
// of one, have the same scale, the same view and the same colours: what they need is found in a
// first pass over the frames. VTK in a header: only for sources of this folder.

#pragma once

#include "app/render/body.h"
#include "app/render/colours.h"
#include "app/render/options.h"
#include "app/render/results.h"
#include "app/render/stage.h"
#include "app/render/view.h"

#include <vtkRenderWindow.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace billet::render {

/// A frame of one of the results.
struct Source {
  const Results* results = nullptr;
  double time = 0.0; ///< [s]
};

/// Frames next to each other.
using Picture = std::vector<Source>;

class Scene {
public:
  /// @throws Error  for results that cannot be read, a field that is not there, planes that miss
  ///                the part
  explicit Scene(const Options& options);

  [[nodiscard]] const std::vector<Picture>& pictures() const { return pictures_; }
  /// Draws one of the pictures into the window, in place of what is there.
  void draw(const Picture& picture, vtkRenderWindow& window) const;
  /// What the colours are, in words.
  [[nodiscard]] std::string in_words() const;
  /// A line for each time asked for that lies outside of the results; empty where none does.
  [[nodiscard]] std::string times_outside() const;

private:
  void choose_pictures();
  void measure();
  void measure_parts();
  void measure_tools();
  void check_cuts() const;
  [[nodiscard]] Completion completion_of(const Frame& frame) const;
  void draw_frame(Stage& stage, const Frame& frame, double pixel) const;
  void draw_tools(Stage& stage, const Frame& frame) const;
  void draw_arrows(Stage& stage, vtkPolyData& faces) const;
  /// Of the longest vector. [mm]
  [[nodiscard]] double arrow_length() const;
  [[nodiscard]] std::string caption(const Source& source) const;

  Options options_;
  std::vector<std::unique_ptr<Results>> results_;
  std::vector<Picture> pictures_;
  Shown shown_;
  ColourRange range_;
  bool flat_ = false; ///< a scene of the plane, not revolved
  Sight sight_;
  Extent extent_{sight_};
  Box part_;   ///< of all frames, as they were computed [mm]
  Box whole_;  ///< of all copies [mm]
  Box window_; ///< what is drawn of tools [mm]
  double longest_vector_ = 0.0;
};

/// Draws the picture that is asked for and writes it.
/// @returns what its colours are, in words
/// @throws Error  for results that cannot be read, a field that is not there, a full disk
[[nodiscard]] std::string draw_scene(const Options& options, const std::filesystem::path& picture);

/// A window for pictures of a size, without a place on the screen.
[[nodiscard]] vtkSmartPointer<vtkRenderWindow> window_of(const std::array<int, 2>& size);

} // namespace billet::render
