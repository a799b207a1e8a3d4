#include "app/report/frame_encoder.h"

#include "geometry/base/error.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>

namespace billet::report {

namespace {

using mechanics::Index;
using nlohmann::ordered_json;

constexpr std::array<std::string_view, 8> asked_for_most{
    "von_mises", "plastic_strain", "temperature",     "contact_pressure",
    "gap",       "contact_status", "element_quality", "lap_depth"};

std::span<const double> flat(const std::vector<Vec3>& points) {
  return {points.empty() ? nullptr : points.front().data(), 3 * points.size()};
}

ordered_json components_of(Blob& blob, std::span<const double> values, std::size_t n, int levels) {
  ordered_json components = ordered_json::array();
  for (std::size_t c = 0; c < n; ++c)
    components.push_back(blob.add_numbers(values, c, n, levels));
  return components;
}

struct SamePlace {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double x : p)
      hash = hash * 1000003U ^ std::hash<double>()(x);
    return hash;
  }
};

/// Contact faces by numbers of shown nodes, padded with -1 to one length; empty: they are no
/// faces of this mesh.
std::vector<Index> contact_faces(const io::StoredWorkpiece& workpiece,
                                 const ShownMesh& shown,
                                 const io::SurfaceFrame& contact,
                                 std::size_t width) {
  std::unordered_map<std::array<double, 3>, Index, SamePlace> node_at;
  for (const Index node : shown.nodes) {
    const Vec3& p = workpiece.mesh.points[idx(node)];
    node_at[{p[0], p[1], p[2]}] = shown.number(node);
  }
  std::vector<Index> faces;
  for (const auto* cells : {&contact.lines, &contact.polygons})
    for (const std::vector<Index>& cell : *cells) {
      for (const Index point : cell) {
        const Vec3& p = contact.points[idx(point)];
        const auto found = node_at.find({p[0], p[1], p[2]});
        if (found == node_at.end() || cell.size() > width)
          return {};
        faces.push_back(found->second);
      }
      faces.resize((faces.size() + width - 1) / width * width, -1);
    }
  return faces;
}

} // namespace

bool FrameEncoder::wanted(const io::Field& field) const {
  return detail_.all_fields || std::find(asked_for_most.begin(), asked_for_most.end(),
                                         field.name) != asked_for_most.end();
}

void FrameEncoder::note_field(const io::Field& field, const std::string& on) {
  if (!fields_.contains(field.name))
    fields_[field.name] = {{"unit", field.unit}, {"components", field.components}, {"on", on}};
}

void FrameEncoder::use_mesh_of(const io::StoredWorkpiece& workpiece) {
  if (!meshes_.empty() && workpiece.mesh.kind == mesh_.kind && workpiece.mesh.cells == mesh_.cells)
    return;
  mesh_ = workpiece.mesh;
  shown_ = shown(mesh_, detail_.volume);
  contact_.clear();
  Blob blob;
  ordered_json about{{"element", mechanics::name(mesh_.kind)},
                     {"elements", mesh_.n_elements()},
                     {"nodes", shown_.nodes.size()},
                     {"all_nodes", mesh_.n_points()},
                     {"ring", shown_.ring},
                     {"corners", shown_.corners}};
  about["faces"] = blob.add_integers(shown_.faces);
  about["cells"] = blob.add_integers(shown_.cells);
  meshes_.push_back(std::move(about));
  mesh_blobs_.push_back(blob.text());
  size_ += mesh_blobs_.back().size();
}

void FrameEncoder::add_node_fields(const io::StoredWorkpiece& workpiece, Blob& blob) {
  ordered_json& frame = frames_.back();
  for (const io::Field& field : workpiece.points) {
    const auto n = static_cast<std::size_t>(field.components);
    if (!wanted(field) || field.values.size() != n * workpiece.mesh.points.size())
      continue;
    note_field(field, "nodes");
    frame["fields"][field.name] =
        components_of(blob, of_shown_nodes(shown_, field.values, n), n, Blob::coarse);
  }
}

void FrameEncoder::add_element_fields(const io::StoredWorkpiece& workpiece, Blob& blob) {
  ordered_json& frame = frames_.back();
  for (const io::Field& field : workpiece.cells) {
    if (!wanted(field) || field.components != 1)
      continue;
    note_field(field, "elements");
    std::vector<double> at_faces;
    for (const Index element : shown_.face_elements)
      at_faces.push_back(field.values[idx(element)]);
    frame["fields"][field.name] = {blob.add_numbers(at_faces, 0, 1, Blob::coarse)};
    if (shown_.corners > 0)
      frame["inside"][field.name] = {blob.add_numbers(field.values, 0, 1, Blob::coarse)};
  }
}

/// Fields of contact faces that nodes do not have as well.
void FrameEncoder::add_contact(const io::StoredWorkpiece& workpiece,
                               const io::SurfaceFrame& contact,
                               Blob& blob) {
  constexpr std::size_t widest = 8;
  const std::size_t width = workpiece.mesh.dimension() == 2 ? 3 : widest;
  const std::vector<Index> faces = contact_faces(workpiece, shown_, contact, width);
  if (faces.empty())
    return;
  if (contact_.empty()) {
    contact_ = faces;
    Blob numbers;
    meshes_.back()["contact"] = {{"width", width}, {"faces", numbers.add_integers(faces)}};
    mesh_blobs_.push_back(numbers.text());
    size_ += mesh_blobs_.back().size();
    meshes_.back()["contact_blob"] = mesh_blobs_.size() - 1;
  }
  if (faces != contact_)
    return;
  for (const io::Field& field : contact.cell_fields) {
    if (!wanted(field) || field.components != 1 || frames_.back()["fields"].contains(field.name))
      continue;
    note_field(field, "contact");
    frames_.back()["fields"][field.name] = {blob.add_numbers(field.values, 0, 1, Blob::coarse)};
  }
}

void FrameEncoder::add(const io::FrameFiles& files) {
  const io::StoredWorkpiece workpiece = io::read_workpiece(files.workpiece);
  const std::size_t n_meshes = meshes_.size();
  symmetry_ = workpiece.symmetry;
  use_mesh_of(workpiece);
  if (meshes_.size() > n_meshes)
    meshes_.back()["blob"] = mesh_blobs_.size() - 1;
  Blob blob;
  frames_.push_back({{"time", files.time}, {"mesh", meshes_.size() - 1}});
  frames_.back()["points"] =
      components_of(blob, of_shown_nodes(shown_, flat(workpiece.mesh.points), 3), 3, Blob::fine);
  frames_.back()["fields"] = ordered_json::object();
  add_node_fields(workpiece, blob);
  add_element_fields(workpiece, blob);
  if (files.contact)
    try {
      add_contact(workpiece, io::read_surface(*files.contact), blob);
    } catch (const Error&) { // the rest of the frame is worth showing without
    }
  for (const auto& [name, file] : files.tools)
    try {
      io::SurfaceFrame surface = io::read_surface(file);
      for (const io::Field& field : surface.cell_fields)
        note_field({field.name + " (tools)", 1, {}, field.unit}, "tools");
      const std::size_t n_shapes = tools_.blobs().size();
      frames_.back()["tools"].push_back(tools_.add(name, std::move(surface), blob));
      if (tools_.blobs().size() > n_shapes)
        size_ += tools_.blobs().back().size();
    } catch (const Error&) { // the frame is worth showing without this tool
    }
  frame_blobs_.push_back(blob.text());
  size_ += frame_blobs_.back().size();
}

ordered_json FrameEncoder::scene() const {
  ordered_json scene{{"dimension", mesh_.dimension()}, {"fields", fields_}, {"meshes", meshes_}};
  std::size_t number = mesh_blobs_.size();
  scene["frames"] = frames_;
  for (ordered_json& frame : scene["frames"])
    frame["blob"] = number++;
  scene["shapes"] = tools_.about();
  for (ordered_json& shape : scene["shapes"])
    shape["blob"] = number++;
  return scene;
}

std::vector<std::string> FrameEncoder::blobs() const {
  std::vector<std::string> all = mesh_blobs_;
  all.insert(all.end(), frame_blobs_.begin(), frame_blobs_.end());
  all.insert(all.end(), tools_.blobs().begin(), tools_.blobs().end());
  return all;
}

} // namespace billet::report
