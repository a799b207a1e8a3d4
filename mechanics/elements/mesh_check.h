// Is a mesh fit for a computation, and how good are its cells?
//
// Quality is the scaled Jacobian, smallest over the corners: 1 for a cube, a square, an
// equilateral triangle or tetrahedron, 0 for a collapsed corner, negative for an inverted one.
// At a corner of a quadratic cell the tangents are those of the true, curved edges; each is
// measured against the longer of itself and the chord to the next corner, so that the quality
// falls to 0 as a mid-side node reaches the quarter point of its edge, and not all of a sudden.
//
// Units   lengths in mm; quality [-].

#pragma once

#include "geometry/base/error.h"
#include "geometry/base/vector.h"
#include "mechanics/mesh/mesh.h"
#include "mechanics/mesh/mesh_labels.h"

#include <span>
#include <string>
#include <vector>

namespace billet::mechanics {

/// Scaled Jacobian of one cell, in [-1, 1]; a value that is not finite counts as -1.
///
/// @param points  shape (nodes_per_element), in the order of the cell's nodes
[[nodiscard]] double element_quality(ElementKind kind, std::span<const Vec3> points);

/// Quality of every cell at the given places of the nodes, shape (n_elements).
///
/// @param points  shape (n_points) [mm]; for the mesh as it is, pass `mesh.points`
[[nodiscard]] std::vector<double> element_qualities(const Mesh& mesh, std::span<const Vec3> points);

/// Longest over shortest edge of one cell, between its corners; infinite if one has no length [-].
[[nodiscard]] double element_aspect(ElementKind kind, std::span<const Vec3> points);

/// Largest aspect of a mesh at the given places of the nodes, shape (n_points).
[[nodiscard]] double largest_aspect(const Mesh& mesh, std::span<const Vec3> points);

/// Area [mm^2] or volume [mm^3] of one cell, negative if its nodes turn the wrong way.
[[nodiscard]] double element_measure(ElementKind kind, std::span<const Vec3> points);

/// Smallest determinant of the Jacobian over corners and integration points, divided by the mean
/// size of the cell (to the power of the dimension) [-]: <= 0 where the cell is turned inside out.
[[nodiscard]] double smallest_jacobian(ElementKind kind, std::span<const Vec3> points);

/// Everything that is wrong with a mesh; empty if it is sound. After ten complaints of one sort the
/// rest is only counted.
///
/// @param place         what the complaints give as their place (the file, or empty)
/// @param axisymmetric  x is a radius and must not be negative
/// @param labels        by which elements and nodes are named
[[nodiscard]] std::vector<Complaint> check_mesh(const Mesh& mesh,
                                                const std::string& place,
                                                bool axisymmetric,
                                                const MeshLabels& labels = {});

/// Throws `Error` (Fault::geometry) with the complaints of `check_mesh`, if there are any.
void require_sound_mesh(const Mesh& mesh,
                        const std::string& place,
                        bool axisymmetric,
                        const MeshLabels& labels = {});

/// Cells of hex20 that lie against others with two opposite faces at most, as in a bar one element
/// across: with the reduced rule each keeps a motion that strains nothing and that only its other
/// four faces show.
///
/// @param held  shape (n_points), of nodes that a support holds: a face of such nodes alone is not
///              free
[[nodiscard]] std::vector<Index> cells_in_single_file(const Mesh& mesh, std::span<const char> held);

/// Removes the nodes no cell uses, from the sets too; returns how many.
Index drop_unused_points(Mesh& mesh);

} // namespace billet::mechanics
