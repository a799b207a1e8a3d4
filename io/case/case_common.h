// Pieces that several parts of a case share: places, selectors, input files.

#pragma once

#include "geometry/base/time_function.h"
#include "geometry/base/vector.h"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

namespace billet {

/// Two functions are equal when their points are.
inline bool operator==(const TimeFunction& a, const TimeFunction& b) {
  return a.points() == b.points();
}

} // namespace billet

namespace billet::io {

/// A file that the case names.
struct InputFile {
  std::string given;          ///< as written in the case file
  std::filesystem::path path; ///< where it is: `given`, relative to the case file's folder

  bool operator==(const InputFile&) const = default;
};

/// A turn about a line.
struct PlaceRotation {
  Vec3 point = Vec3::Zero(); ///< on the axis [mm]
  Vec3 axis = Vec3::UnitZ(); ///< not zero, of any length; z in the plane
  double degrees = 0.0;      ///< right-handed about `axis`

  bool operator==(const PlaceRotation&) const = default;
};

/// Where a body is put: first turned, then shifted.
struct Place {
  Vec3 translate = Vec3::Zero(); ///< [mm]
  std::optional<PlaceRotation> rotate;

  bool operator==(const Place&) const = default;
};

/// Nodes of the initial mesh on the plane "x = 0", to 1e-6 of the mesh's size.
struct OnPlane {
  int axis = 0;       ///< 0: x, 1: y, 2: z
  double value = 0.0; ///< [mm]

  bool operator==(const OnPlane&) const = default;
};

/// A named set of the mesh ("set:NAME").
struct InSet {
  std::string name;

  bool operator==(const InSet&) const = default;
};

/// "all".
struct Everywhere {
  bool operator==(const Everywhere&) const = default;
};

/// A place of the workpiece, and where the case says it: what is wrong with it shows with the mesh.
struct Where {
  std::variant<Everywhere, OnPlane, InSet> kind;
  std::string place; ///< "case.toml:12:9"
  std::string key;   ///< "load.0.where"

  bool operator==(const Where& other) const { return kind == other.kind; }
};

} // namespace billet::io
