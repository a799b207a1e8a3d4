// Tools for the page: a shape is stored once, and moved as the tool moves.
//
// A frame holds every tool where it was then. Where the points of two frames differ by a rigid
// motion, the motion is stored; where a tool without an end is drawn on another stretch, its new
// shape. A surface of very many triangles is thinned: points in one cell of a grid become one.

#pragma once

#include "app/report/blob.h"
#include "io/results/vtk_writer.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace billet::report {

/// Thins a surface that has more triangles than that; cell fields go with the triangles that stay.
/// @return those that stay; empty: the surface is as it was
[[nodiscard]] std::vector<std::size_t> thin(io::SurfaceFrame& surface, std::size_t most_triangles);

class ToolShapes {
public:
  /// The tool in a frame: {"tool", "shape", "pose", "fields"}; fields go into the frame's blob.
  [[nodiscard]] nlohmann::ordered_json
  add(const std::string& tool, io::SurfaceFrame surface, Blob& frame);

  /// Of every shape {"points", "lines", "triangles"} and its blob.
  [[nodiscard]] const nlohmann::ordered_json& about() const { return about_; }
  [[nodiscard]] const std::vector<std::string>& blobs() const { return blobs_; }
  /// Tools that were thinned, and how many triangles they had.
  [[nodiscard]] const std::map<std::string, std::size_t>& thinned() const { return thinned_; }

private:
  struct Shape {
    std::vector<Vec3> points;
    std::vector<std::vector<mechanics::Index>> lines, polygons;
    std::vector<std::size_t> stay; ///< polygons that a thinned one keeps; empty: all
    std::size_t number;            ///< in the page
  };
  [[nodiscard]] std::size_t store(const io::SurfaceFrame& surface);

  std::map<std::string, Shape> latest_; ///< by tool
  nlohmann::ordered_json about_ = nlohmann::ordered_json::array();
  std::vector<std::string> blobs_;
  std::map<std::string, std::size_t> thinned_;
};

} // namespace billet::report
