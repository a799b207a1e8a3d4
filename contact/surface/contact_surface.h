// The faces of the workpiece that a tool may touch, and their integration points.
//
// Two forms of contact element (the paper's section 3.2). `compatible` integrates the contact work
// fully. `mixed` gives the contact stress one order less than the displacement: on quadratic faces
// it is linear, which after condensation is the 2-point Gauss rule per direction (C.11), on a
// triangle the 3-point rule (C.25). On linear faces both forms use the 2-point rule (C.12): a
// single point finds fold-over too late. The penalty follows the stiffness of the parent elements.

#pragma once

#include "contact/law/interface_law.h"
#include "contact/law/trapped_medium.h"
#include "geometry/curved/bezier_patch.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/equilibrium/faces.h"
#include "mechanics/linear/sparse_matrix.h"
#include "mechanics/mesh/mesh.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace billet::contact {

using mechanics::Index;

enum class Form { mixed, compatible };

/// How a limit of penetration is kept: by raising the penalty, or by pressures that need no
/// penetration. (C.20)-(C.22)
enum class Method { penalty, augmented };

/// The choices of a case about contact.
struct ContactSettings {
  Form form = Form::mixed;
  double penalty = 100.0;        ///< multiple of E / h of the adjacent element [-]
  double penalty_tangent = 10.0; ///< the same against slip [-]
  Method method = Method::penalty;
  std::optional<double> max_penetration = std::nullopt; ///< of any point of a face [mm]
  SlipScheme scheme{};                                  ///< how sliding is integrated
  std::optional<Friction> self = std::nullopt; ///< of the workpiece on itself; none: not looked at
  std::optional<TrappedMedium> trapped = std::nullopt; ///< in pockets; none: they stay empty
};

/// How a contact point's traction is shared by the nodes of its face.
struct PointShares {
  std::span<const Index> nodes;
  std::vector<double> areas; ///< shape (nodes) [mm^2]
};

/// The piece of a face that one of its points stands for: pieces of a face meet without gaps.
struct Footprint {
  std::array<Vec3, 5> corners; ///< the two ends in the plane; in space in turn [mm]
  std::size_t n_corners = 0;
};

/// Where a point of a new mesh's contact surface lies on the old one: between some of its points.
struct PointSource {
  std::array<std::size_t, 3> points{}; ///< of the old surface, on the same boundary
  std::array<double, 3> weights{};     ///< their sum is 1; 0: has nothing to say [-]

  /// @param share  of the second point, in [0, 1]
  [[nodiscard]] static PointSource between(std::size_t first, std::size_t second, double share) {
    return {{first, second, second}, {1.0 - share, share, 0.0}};
  }
  /// The point with the largest weight, the last of equals.
  [[nodiscard]] std::size_t nearest() const;
};

/// Faces and points; constant during a mesh's life.
class ContactSurface {
public:
  /// @param faces  candidates, of the mesh
  ContactSurface(const mechanics::Mesh& mesh,
                 const mechanics::Bulk& bulk,
                 const mechanics::BlockPattern& pattern,
                 const std::vector<mechanics::Face>& faces,
                 const ContactSettings& settings);

  [[nodiscard]] mechanics::ElementKind kind() const { return kind_; }
  [[nodiscard]] mechanics::Analysis analysis() const { return analysis_; }
  [[nodiscard]] Form form() const { return form_; }
  [[nodiscard]] const SlipScheme& scheme() const { return scheme_; }
  [[nodiscard]] const mechanics::Scatter& scatter() const { return scatter_; }
  [[nodiscard]] Index n_faces() const { return scatter_.n_groups(); }
  /// Integration points a face.
  [[nodiscard]] int points() const { return points_; }
  [[nodiscard]] std::size_t n_points() const { return bulk_points_.size(); }
  /// Whether the faces are those of linear elements.
  [[nodiscard]] bool linear() const;
  /// Penalty of every face: multiples of E over the mean depth of the parent elements.
  [[nodiscard]] const Penalty& penalty() const { return penalty_; }
  /// E over the mean depth of the parent elements: what penalties are multiples of [MPa/mm].
  [[nodiscard]] double stiffness() const { return stiffness_; }
  /// A limit that the case sets [mm].
  [[nodiscard]] std::optional<double> max_penetration() const { return max_penetration_; }
  /// Length of a face's parent element, normal to the face [mm].
  [[nodiscard]] double depth(Index face) const { return depths_[static_cast<std::size_t>(face)]; }
  /// Index into the bulk's states of the integration point closest to a contact point.
  [[nodiscard]] std::size_t bulk_point(std::size_t point) const { return bulk_points_[point]; }

  /// The same of all points, shape (n_points).
  [[nodiscard]] std::span<const std::size_t> bulk_points() const { return bulk_points_; }

  /// Positions of all points, shape (n_points) [mm].
  void positions(std::span<const double> x, std::span<Vec3> out) const;
  /// Coordinates of a face's points on its line, in [-1, 1], shape (points()); in the plane only.
  [[nodiscard]] std::vector<double> line_coordinates() const;
  /// Coordinates of a face's points on the reference face, shape (points()); in space only.
  [[nodiscard]] std::vector<Vec2> face_coordinates() const;
  /// Areas that the points stand for, shape (n_points) [mm^2].
  void areas(std::span<const double> x, std::span<double> out) const;
  /// How the traction at a point is shared by the nodes of its face.
  [[nodiscard]] PointShares shares(std::span<const double> x, std::size_t point) const;
  /// Its sides divide the face's coordinates like the weights of the rule.
  [[nodiscard]] Footprint footprint(std::span<const double> x, std::size_t point) const;
  /// A face as the curve or surface that its nodes span.
  [[nodiscard]] geometry::BezierPatch patch(std::span<const double> x, Index face) const;
  /// Points at equal steps of a face's coordinates, with its corners and edges, for a look at
  /// overlap [mm].
  ///
  /// @return  of a line steps + 1, of a quadrilateral rows of as many; of a triangle rows of which
  ///          each has one point less than the one before
  [[nodiscard]] std::vector<Vec3>
  samples(std::span<const double> x, Index face, int steps = 4) const;

private:
  void set_penalty(const mechanics::Mesh& mesh,
                   const mechanics::Bulk& bulk,
                   const std::vector<mechanics::Face>& faces,
                   const ContactSettings& settings);
  void set_bulk_points(const mechanics::Mesh& mesh,
                       const mechanics::Bulk& bulk,
                       const std::vector<mechanics::Face>& faces,
                       std::span<const double> x);

  mechanics::ElementKind kind_;
  mechanics::Analysis analysis_;
  Form form_;
  SlipScheme scheme_;
  std::optional<double> max_penetration_;
  int points_;
  mechanics::Scatter scatter_;
  Penalty penalty_{};
  double stiffness_ = 0.0;
  std::vector<double> depths_;
  std::vector<std::size_t> bulk_points_;
};

/// Whether a face shape is a triangle.
template <class Shape>
inline constexpr bool is_triangle =
    std::is_same_v<Shape, mechanics::Tri3> || std::is_same_v<Shape, mechanics::Tri6>;

/// Whether a face shape is that of a linear element.
template <class Shape>
inline constexpr bool
    of_linear_element = Shape::nodes == (1 << Shape::dim) || Shape::nodes == Shape::dim + 1;

/// Calls `visitor(shape, rule)` with the face shape and the integration rule of a form.
template <class Visitor>
decltype(auto) visit_contact_face(mechanics::ElementKind kind, Form form, Visitor&& visitor) {
  return mechanics::visit_face(kind, [&](auto shape) {
    using Shape = decltype(shape);
    using Mixed = typename mechanics::FaceRules<Shape>::Lower;
    using Full = std::conditional_t<of_linear_element<Shape>, Mixed,
                                    typename mechanics::FaceRules<Shape>::Full>;
    return form == Form::mixed ? visitor(shape, Mixed{}) : visitor(shape, Full{});
  });
}

} // namespace billet::contact
