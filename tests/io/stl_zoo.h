// A zoo of STL files, good, dirty and hopeless, and what must become of each kind.

#pragma once

#include "geometry/triangles/triangle_mesh.h"

#include <functional>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace billet::io {

using Random = std::mt19937;

enum class Verdict {
  sound,   ///< taken as it is
  noted,   ///< taken, with a repair or a remark
  refused, ///< with a place and a reason
};

/// One kind of file; the random numbers vary size, place and damage.
struct ZooKind {
  std::string name;
  Verdict verdict;
  std::string says; ///< part of the report or complaint; may be empty
  std::function<std::string(Random&)> bytes;
  std::optional<bool> closed = std::nullopt; ///< whether the surface taken must be closed
};

inline std::ostream& operator<<(std::ostream& stream, const ZooKind& kind) {
  return stream << kind.name;
}

/// Damage to files, such as truncation.
std::vector<ZooKind> zoo_of_files();
/// Damage to surfaces, such as cracks.
std::vector<ZooKind> zoo_of_surfaces();

double between(Random& random, double low, double high);

/// Somewhere, turned anyhow, 10 to 100 times larger.
geometry::TriangleMesh posed(geometry::TriangleMesh mesh, Random& random);
/// Both, without common points.
geometry::TriangleMesh together(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b);
geometry::TriangleMesh moved(geometry::TriangleMesh mesh, const Vec3& by);

std::string binary_stl(const geometry::TriangleMesh& mesh, const std::string& header = "zoo");
/// @param digits  significant digits of each coordinate
std::string
ascii_stl(const geometry::TriangleMesh& mesh, int digits = 9, const std::string& name = "zoo");

} // namespace billet::io
