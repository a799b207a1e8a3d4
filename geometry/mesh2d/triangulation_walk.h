// Which faces of a constrained triangulation lie in the domain, and straight ways through them.
// Internal to geometry/; templates, so that this header knows nothing of CGAL.
//
// The `info()` of a face is 1 in the domain and 0 outside.

#pragma once

#include <vector>

namespace billet::geometry {

/// Marks the faces that an odd number of constrained edges parts from the outside.
template <class Triangulation> void mark_domain(Triangulation& triangulation) {
  using Face = typename Triangulation::Face_handle;
  for (const Face face : triangulation.all_face_handles())
    face->info() = -1;
  std::vector<Face> front{triangulation.infinite_face()};
  front.front()->info() = 0;
  while (!front.empty()) {
    const Face face = front.back();
    front.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Face next = face->neighbor(i);
      if (next->info() >= 0)
        continue;
      next->info() = face->info() ^ static_cast<int>(face->is_constrained(i));
      front.push_back(next);
    }
  }
}

/// Where a way ends: in a face, or before its constrained edge.
template <class Triangulation> struct WalkEnd {
  typename Triangulation::Face_handle face;
  int edge; ///< -1: in the face
};

/// The edge by which a way from p towards q, which came into `face` by edge `entry`, leaves it.
template <class Triangulation>
int exit_of(const Triangulation& triangulation,
            typename Triangulation::Face_handle face,
            int entry,
            const typename Triangulation::Point& p,
            const typename Triangulation::Point& q) {
  const bool left = triangulation.orientation(p, q, face->vertex(entry)->point()) > 0;
  return left ? Triangulation::ccw(entry) : Triangulation::cw(entry);
}

/// Follows the way from p, which leaves the first face by edge `exit` if it does, to q or to the
/// first constrained edge.
template <class Triangulation>
WalkEnd<Triangulation> walk(const Triangulation& triangulation,
                            typename Triangulation::Face_handle face,
                            int exit,
                            const typename Triangulation::Point& p,
                            const typename Triangulation::Point& q) {
  while (true) {
    const auto& a = face->vertex(Triangulation::ccw(exit))->point();
    const auto& b = face->vertex(Triangulation::cw(exit))->point();
    if (triangulation.orientation(a, b, q) >= 0)
      return {face, -1};
    if (face->is_constrained(exit) || triangulation.is_infinite(face->neighbor(exit)))
      return {face, exit};
    const int entry = triangulation.tds().mirror_index(face, exit);
    face = face->neighbor(exit);
    exit = exit_of(triangulation, face, entry, p, q);
  }
}

} // namespace billet::geometry
