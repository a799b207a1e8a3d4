// The workpiece of a case: mesh, element, place; and the materials.
//
// Units: those of the case (mm, MPa, s, degC here).

#pragma once

#include "io/case/case_common.h"
#include "mechanics/materials/any_flow_law.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace billet::io {

/// A rectangle or a brick of cells.
struct BoxMesh {
  Vec3 low = Vec3::Zero();                      ///< corner of least coordinates [mm]
  Vec3 high = Vec3::Zero();                     ///< opposite corner [mm]
  std::array<int, 3> cells = {1, 1, 1};         ///< along x, y, z; 1 along z in the plane
  std::array<double, 3> grading = {1., 1., 1.}; ///< last cell over first cell, by axis [-]

  bool operator==(const BoxMesh&) const = default;
};

/// A solid cylinder about z, base at z = 0 (3d).
struct CylinderMesh {
  double radius = 0.0;               ///< [mm]
  double height = 0.0;               ///< [mm]
  std::array<int, 2> cells = {1, 1}; ///< along the radius, along the height
  int sector = 360;                  ///< 90, 180 or 360 degrees, from the x axis

  bool operator==(const CylinderMesh&) const = default;
};

/// A mesh file of Gmsh, VTK (.vtu), Abaqus or CalculiX.
struct FileMesh {
  InputFile file;
  std::filesystem::path folder; ///< of the case: what the file includes may lie in it as well
  bool allow_outside = false;   ///< what the file includes may lie anywhere

  bool operator==(const FileMesh&) const = default;
};

/// A domain of the plane, bounded by the lines and arcs of a closed profile, to be meshed with
/// tri6.
struct OutlineMesh {
  InputFile file;
  double size = 0.0; ///< of the triangles [mm]

  bool operator==(const OutlineMesh&) const = default;
};

/// A closed triangulated surface, the body in which is to be meshed with tet10.
struct StlMesh {
  InputFile file;
  double size = 0.0;             ///< of the tetrahedra [mm]
  std::string unit;              ///< of the file's numbers, as given; empty: that of the case
  double unit_factor = 1.0;      ///< from the file's numbers to the case's lengths [mm]
  double feature_angle = 30.0;   ///< edges sharper than this are kept [degrees]
  std::optional<double> details; ///< shapes smaller than this are passed over; none: all count [mm]

  bool operator==(const StlMesh&) const = default;
};

/// A body out of CAD, meshed with tetrahedra.
struct StepMesh {
  InputFile file;
  double size = 0.0;                 ///< of the tetrahedra [mm]
  double unit_factor = 1.0;          ///< from mm to the case's lengths
  std::optional<double> chord_error; ///< of its triangles; none: a hundredth of `size` [mm]
  double feature_angle = 30.0;       ///< edges sharper than this are kept [degrees]
  std::optional<double> details;     ///< shapes smaller than this are passed over [mm]

  bool operator==(const StepMesh&) const = default;
};

using MeshSource = std::variant<BoxMesh, CylinderMesh, FileMesh, OutlineMesh, StlMesh, StepMesh>;

struct Workpiece {
  std::string element;  ///< "quad8", "quad4", "tri6", "hex20", "hex8", "tet10"
  std::string material; ///< a key of Case::materials
  MeshSource mesh;
  Place place;

  bool operator==(const Workpiece&) const = default;
};

struct ElasticConstants {
  double young = 0.0;   ///< [MPa], > 0
  double poisson = 0.0; ///< [-], -1 < poisson < 0.5

  bool operator==(const ElasticConstants&) const = default;
};

/// The flow laws of metals; their keys, units and bounds are listed in their headers.
using FlowLaw = mechanics::AnyPlasticLaw;

struct Material {
  std::string library; ///< name in material_library.h that gave what the case does not; empty: none
  ElasticConstants elastic;
  std::optional<FlowLaw> flow;         ///< absent: an elastic body
  std::optional<double> hardness;      ///< [MPa]; absent only where nothing gives a default
  std::optional<double> density;       ///< [t/mm^3]
  std::optional<double> heat_capacity; ///< [mm^2/s^2/K]
  std::optional<double> heating; ///< share of the plastic work that heats it [-]; absent: none

  bool operator==(const Material&) const = default;
};

} // namespace billet::io
