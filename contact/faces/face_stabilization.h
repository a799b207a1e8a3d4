// What holds the shape of quadratic faces on a tool where the mixed form has no say. (C.44)
//
// A contact stress of one order less than the displacement does no work on the rest of the gap: a
// corner could sink into the tool and the nodes next to it rise, held by the solid alone. Springs
// as stiff as the parent elements press on the rest of the gap where it is inside the tool. They
// have no resultant, so force and friction stay those of the contact points, and they are a hundred
// times softer than the penalty, so a face need not follow the tool closer than the solid lets it.

#pragma once

#include "contact/surface/contact_surface.h"
#include "geometry/motion.h"
#include "geometry/rigid_surface.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace billet::contact {

/// Springs of the faces that lie on one tool, set at the end of an increment for the next one.
class FaceStabilization {
public:
  /// A tool as the faces see it at the end of an increment.
  struct At {
    const geometry::RigidSurface& tool;
    const geometry::Pose& pose;
    double reach; ///< of queries [mm]
  };

  /// Sets springs on the faces of which a point touches the tool. They press where a place is both
  /// inside the tool and deeper than its face's points make it, by the lesser of the two: what
  /// bridges a groove is not pulled down, and a force begins and ends with nothing. Nor do they
  /// press more than ten times what the face's points do: a slender part's corner can be deep
  /// inside before a point next to it closes. Existing springs go half of the way to that.
  ///
  /// @param history    of the contact points, shape (n_points)
  /// @param x          shape (n_dofs) [mm]
  /// @param stiffness  pressure per length [MPa/mm]
  void set(const ContactSurface& surface,
           std::span<const PointHistory> history,
           const At& at,
           std::span<const double> x,
           double stiffness);
  void clear() { springs_.clear(); }

  void add(const ContactSurface& surface,
           const mechanics::BlockPattern& pattern,
           std::span<const double> x,
           mechanics::System& system) const;
  /// Adds the springs' forces on the nodes where they were set, shape (n_dofs) [N].
  void add_forces(const ContactSurface& surface, std::span<double> forces) const;
  /// Moment of the springs' forces on the workpiece [N mm]; their resultant is zero.
  [[nodiscard]] Vec3 moment(const ContactSurface& surface, std::span<const double> x) const;
  /// About what a tool turns about: the springs turn it as its gaps to the faces do, a body of
  /// revolution not at all about its own axis.
  struct Turning {
    const Mat3& rotation; ///< of the tool
    const Vec3& point;    ///< in its own frame [mm]
  };
  /// What the springs turn a tool with, with the sign of `moment` [N mm].
  [[nodiscard]] Vec3 moment_about(const Turning& turning,
                                  const ContactSurface& surface,
                                  std::span<const double> x) const;
  /// Adds the derivative of that moment about an axis through the point, shape (n_dofs) [N].
  void add_moment_row(const Turning& turning,
                      const ContactSurface& surface,
                      std::span<const double> x,
                      const Vec3& axis,
                      std::span<double> row) const;
  /// [N mm]
  [[nodiscard]] double energy(const ContactSurface& surface, std::span<const double> x) const;

  template <class Archive> void fields(Archive& archive) { archive(springs_); }

private:
  /// Against the rest of the gap at one place of a face.
  struct Spring {
    Index face;
    int place;        ///< point of the face's full rule
    Vec3 normal;      ///< of the tool when it was set, in space [-]
    double stiffness; ///< [N/mm]
    double rest;      ///< of the gap when it was set, or the gap if that is more [mm]
    double along;     ///< what the nodes' positions along the normal made of it then [mm]
    /// The rest of place x normal over the face, and of the normals, in the tool's frame.
    Vec3 levers, normals;

    /// About a point of the tool [mm].
    [[nodiscard]] Vec3 lever(const Vec3& point) const { return levers - point.cross(normals); }

    template <class Archive> void fields(Archive& archive) {
      archive(face, place, normal, stiffness, rest, along, levers, normals);
    }
  };

  template <class Visitor>
  void for_each(const ContactSurface& surface, std::span<const double> x, Visitor&& visitor) const;

  std::vector<Spring> springs_;
};

} // namespace billet::contact
