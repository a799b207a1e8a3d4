// Encodes frames one after another: a mesh is stored once for all frames that share it.

#pragma once

#include "app/report/shown_mesh.h"
#include "app/report/tool_shapes.h"
#include "io/results/read_frames.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace billet::report {

/// How much of a frame is stored.
struct Detail {
  bool volume = true;     ///< cells, of parts in space
  bool all_fields = true; ///< else those that are asked for most
};

class FrameEncoder {
public:
  explicit FrameEncoder(Detail detail) : detail_(detail) {}

  /// @throws Error  if the workpiece cannot be read; tools and contact that cannot are left out
  void add(const io::FrameFiles& files);

  /// So far, of all blobs [byte].
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The scene without what the case says; blobs are numbered as in `blobs`.
  [[nodiscard]] nlohmann::ordered_json scene() const;
  [[nodiscard]] std::vector<std::string> blobs() const;
  [[nodiscard]] const ToolShapes& tools() const { return tools_; }
  /// Of the last frame.
  [[nodiscard]] const std::vector<io::SymmetryPlane>& symmetry() const { return symmetry_; }

private:
  void use_mesh_of(const io::StoredWorkpiece& workpiece);
  void add_node_fields(const io::StoredWorkpiece& workpiece, Blob& blob);
  void add_element_fields(const io::StoredWorkpiece& workpiece, Blob& blob);
  void add_contact(const io::StoredWorkpiece& workpiece, const io::SurfaceFrame& contact, Blob& b);
  void note_field(const io::Field& field, const std::string& on);
  [[nodiscard]] bool wanted(const io::Field& field) const;

  Detail detail_;
  std::size_t size_ = 0;
  mechanics::Mesh mesh_; ///< of the last frame
  ShownMesh shown_;
  std::vector<mechanics::Index> contact_; ///< faces in contact of that mesh, as stored
  nlohmann::ordered_json meshes_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json frames_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json fields_ = nlohmann::ordered_json::object();
  std::vector<std::string> mesh_blobs_, frame_blobs_;
  ToolShapes tools_;
  std::vector<io::SymmetryPlane> symmetry_;
};

} // namespace billet::report
