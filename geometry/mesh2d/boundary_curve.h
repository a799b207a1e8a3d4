// A closed chain of quadratic sides read as a smooth curve. Internal to geometry/.
//
// Corners that are kept break the curve into spans. Within a span it passes through every corner
// and middle with the tangent of the circle through a node and its neighbours, as one cubic from
// node to node: straight where the nodes are, a circle (to sixth order) where they lie on one.
// Places are arc lengths from the first kept corner. Theory: docs/theory/geometry.md (G.40),
// (G.41).
//
// Units   mm.

#pragma once

#include "geometry/base/vector.h"
#include "geometry/mesh2d/domain_remesher.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace billet::geometry {

/// What is a corner of a boundary.
struct CornerRule {
  double turn; ///< a boundary that turns by more at a node may have a corner there [rad]
  double turn_of_side = 0.0; ///< most that a side turns by [rad]
  /// Ripples of free sides that one no longer than that, near a place, passes over have none;
  /// empty: they do. [mm]
  std::function<double(const Vec2&)> longest_side = {};
  bool parabolas = false; ///< sides are taken as they are, and not as a smooth curve (G.41)
};

class BoundaryCurve {
public:
  /// @pre the side loop has been found sound: sizes agree, no two successive nodes coincide
  BoundaryCurve(const SideLoop& loop, std::int32_t number, const CornerRule& rule);

  [[nodiscard]] double length() const { return length_; }
  /// Where the kept corners are, rising from 0; empty: none [mm].
  [[nodiscard]] const std::vector<double>& kept() const { return kept_; }

  /// By how much the boundary turns left at a kept corner, -pi to pi [rad].
  [[nodiscard]] double turn_at(std::size_t kept) const;

  [[nodiscard]] Vec2 point(double s) const;
  /// The place after or, with `sense` -1, before `s` whose point is `distance` from that of s,
  /// if the curve leads away from it that far. [mm]
  [[nodiscard]] double place_at(double s, double distance, double sense) const;
  /// Unit vector along the way.
  [[nodiscard]] Vec2 tangent(double s) const;
  [[nodiscard]] BoundaryPlace place(double s) const;
  /// Of the side at s.
  [[nodiscard]] std::int32_t part(double s) const;
  /// Whether the side at s is held.
  [[nodiscard]] bool is_held(double s) const;
  /// From 0 on held sides and at kept corners, smoothly, to 1 in the middle of a free stretch.
  [[nodiscard]] double freedom(double s) const;

  /// Places of all nodes and of enough between them for chords that turn by no more than `turn` and
  /// are no longer than `step`; rising from 0.
  [[nodiscard]] std::vector<double> stations(double turn, double step) const;
  /// Angle the curve turns through per length, of the piece that holds s [rad/mm], >= 0.
  [[nodiscard]] double curvature(double s) const;

private:
  /// The cubic a, a + u, b - v, b.
  struct Piece {
    Vec2 a, b, u, v;
    double start = 0.0; ///< arc length at a
    double turn = 0.0;  ///< [rad]
    std::int32_t side = 0;
    double xi = 0.0; ///< at a; half a side on at b

    [[nodiscard]] Vec2 point(double t) const;
    [[nodiscard]] Vec2 derivative(double t) const;
    [[nodiscard]] double length(double t) const;
  };
  struct At {
    const Piece& piece;
    double t;
  };
  struct Stretch {
    double from, to;
    bool endless; ///< a whole loop without an end
  };

  [[nodiscard]] At at(double s) const;
  void add_pieces(const SideLoop& loop, std::size_t first, const std::vector<char>& kept);
  void add_parabolas(const SideLoop& loop, std::size_t first);
  void find_free_stretches(const SideLoop& loop);

  std::vector<Piece> pieces_;
  std::vector<double> kept_;
  std::vector<Stretch> free_;
  std::vector<std::int32_t> part_; ///< of each side
  std::vector<char> held_;         ///< of each side
  std::int32_t number_;
  double length_ = 0.0;
};

/// Of each corner of a loop: whether it is kept, where the boundary has a corner by the rule or for
/// another reason. (G.40), (G.42a)
[[nodiscard]] std::vector<char> kept_corners(const SideLoop& loop, const CornerRule& rule);

} // namespace billet::geometry
