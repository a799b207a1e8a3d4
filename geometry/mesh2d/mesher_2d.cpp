#include "geometry/mesh2d/mesher_2d.h"

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/mesh2d/plane_smoother.h"
#include "geometry/surfaces/profile_piece.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

namespace billet::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using Faces = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, Faces>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Vertex = Triangulation::Vertex_handle;

constexpr double most_triangles = 1e7;

/// Chords of arcs turn by no more than this: the curved side of a triangle then turns by half of it
/// at its ends, which must stay well below the least angle.
constexpr double most_turn = std::numbers::pi / 8.0;

/// An angle bound of 1 / (2 sin a) with a = 20.7 degrees: the best with which refinement is known
/// to end. CGAL asks for its square, times 1/4.
constexpr double shape_bound = 0.125;

/// A chord of the outline: what the refinement takes for the boundary.
struct Chord {
  Vec2 from;
  std::size_t piece;
};

double turned_area(const std::vector<ProfilePiece>& pieces) {
  double twice = 0.0;
  for (const ProfilePiece& piece : pieces) {
    twice += cross(piece.a, piece.b);
    if (piece.is_arc()) // the segment between arc and chord lies right of an arc that turns left
      twice += std::copysign(piece.radius * piece.radius * (piece.sweep - std::sin(piece.sweep)),
                             piece.radius);
  }
  return 0.5 * twice;
}

/// The pieces the other way round.
std::vector<ProfilePiece> reversed(const std::vector<ProfilePiece>& pieces) {
  std::vector<ProfilePiece> result(pieces.rbegin(), pieces.rend());
  for (ProfilePiece& piece : result) {
    std::swap(piece.a, piece.b);
    std::swap(piece.tangent_a, piece.tangent_b);
    piece.tangent_a *= -1.0;
    piece.tangent_b *= -1.0;
    piece.radius = -piece.radius;
  }
  return result;
}

std::vector<Chord> chords(const std::vector<ProfilePiece>& pieces, double size) {
  std::vector<Chord> result;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const double parts = std::ceil(
        std::max({1.0, pieces[p].length() / size * (1.0 - 1e-9), pieces[p].sweep / most_turn}));
    for (std::size_t i = 0; i < static_cast<std::size_t>(parts); ++i)
      result.push_back({i == 0 ? pieces[p].a : pieces[p].point(static_cast<double>(i) / parts), p});
  }
  return result;
}

/// The nearest point of a piece to a point of its chord, near it.
Vec2 onto(const ProfilePiece& piece, const Vec2& x) {
  if (!piece.is_arc())
    return x;
  return piece.centre + std::abs(piece.radius) * (x - piece.centre).normalized();
}

/// The triangulation of the domain, its boundary and its refinement.
class Mesher {
public:
  /// @param most  nodes that may be made
  Mesher(const std::vector<ProfilePiece>& pieces, double size, std::size_t most) : pieces_(pieces) {
    const std::vector<Chord> start = chords(pieces, size);
    for (const Chord& chord : start)
      given_.push_back(triangulation_.insert(Kernel::Point_2(chord.from.x(), chord.from.y())));
    for (std::size_t i = 0; i < start.size(); ++i) {
      triangulation_.insert_constraint(given_[i], given_[(i + 1) % start.size()]);
      pieces_of_.push_back(start[i].piece);
    }
    CGAL::Delaunay_mesher_2<Triangulation, Criteria> refinement(triangulation_,
                                                                Criteria(shape_bound, size));
    refinement.init();
    while (refinement.step_by_step_refine_mesh())
      if (triangulation_.number_of_vertices() > most)
        throw Error(Fault::limit, "",
                    fmt::format("triangles of size {:.6g} with good angles need more than {} nodes "
                                "in this outline: somewhere it is far thinner than they are, or a "
                                "piece of it far shorter",
                                size, most),
                    "give the thin place its thickness, leave the short piece out, or check the "
                    "unit of the outline");
  }

  [[nodiscard]] PlaneMesh mesh() {
    PlaneMesh mesh;
    std::map<Vertex, std::int32_t> number;
    const auto add = [&](Vertex vertex) {
      const auto [place, is_new] =
          number.try_emplace(vertex, static_cast<std::int32_t>(mesh.points.size()));
      if (is_new)
        mesh.points.emplace_back(vertex->point().x(), vertex->point().y());
      return place->second;
    };
    add_boundary(mesh, add);
    for (const auto face : triangulation_.finite_face_handles())
      if (face->is_in_domain())
        mesh.triangles.push_back(
            {add(face->vertex(0)), add(face->vertex(1)), add(face->vertex(2))});
    return mesh;
  }

private:
  /// Walks the constrained edges around the domain, from one given corner to the next.
  template <class Add> void add_boundary(PlaneMesh& mesh, const Add& add) const {
    std::map<Vertex, std::vector<Vertex>> next;
    for (const auto& edge : triangulation_.constrained_edges()) {
      const Vertex a = edge.first->vertex(Triangulation::ccw(edge.second));
      const Vertex b = edge.first->vertex(Triangulation::cw(edge.second));
      next[a].push_back(b);
      next[b].push_back(a);
    }
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const Vertex end = given_[(i + 1) % given_.size()];
      const ProfilePiece& piece = pieces_[pieces_of_[i]];
      Vertex before = given_[i];
      Vertex here = towards(next.at(before), before, end);
      std::int32_t a = add(before);
      while (true) {
        const std::int32_t b = add(here);
        Vec2& place = mesh.points[static_cast<std::size_t>(b)];
        if (here != end)
          place = onto(piece, place);
        const Vec2 chord_middle = 0.5 * (mesh.points[static_cast<std::size_t>(a)] + place);
        mesh.boundary.push_back(
            {{a, b}, onto(piece, chord_middle), static_cast<std::int32_t>(pieces_of_[i])});
        if (here == end)
          break;
        const std::vector<Vertex>& both = next.at(here);
        const Vertex after = both[0] == before ? both[1] : both[0];
        before = std::exchange(here, after);
        a = b;
      }
    }
  }

  /// The neighbour along the boundary that lies in the direction of `end`.
  static Vertex towards(const std::vector<Vertex>& neighbours, Vertex from, Vertex end) {
    const auto direction = [&](Vertex to) {
      return Vec2(to->point().x() - from->point().x(), to->point().y() - from->point().y())
          .normalized();
    };
    const Vec2 wanted = direction(end);
    return *std::max_element(neighbours.begin(), neighbours.end(), [&](Vertex a, Vertex b) {
      return direction(a).dot(wanted) < direction(b).dot(wanted);
    });
  }

  const std::vector<ProfilePiece>& pieces_;
  Triangulation triangulation_;
  std::vector<Vertex> given_;          ///< ends of the chords, in turn
  std::vector<std::size_t> pieces_of_; ///< of each chord
};

void require_sound(const Profile& outline, double size) {
  if (!(size > 0.0) || !std::isfinite(size))
    throw Error(Fault::geometry, "", fmt::format("the size of triangles is {}", size),
                "give a positive size");
  const std::vector<std::string> wrong = flaws(outline);
  if (!wrong.empty())
    throw Error(Fault::geometry, "", wrong.front());
  if (!outline.closed)
    throw Error(Fault::geometry, "", "the outline of a domain must be closed",
                "set closed = true: a line from the last point to the first is then added if it "
                "is missing");
}

} // namespace

PlaneMesh mesh_outline(const Profile& outline, double size) {
  require_sound(outline, size);
  std::vector<ProfilePiece> all = pieces(outline);
  const double area = turned_area(all);
  const auto last = static_cast<std::int32_t>(all.size()) - 1;
  if (area < 0.0)
    all = reversed(all);
  const double expected = 2.0 * std::abs(area) / (size * size);
  if (!(expected < most_triangles))
    throw Error(Fault::limit, "",
                fmt::format("triangles of size {} would be about {:.3g}; at most {:.0e} are made",
                            size, expected, most_triangles),
                "give a larger size");
  // Small pieces take triangles in addition to those that the area takes, but not without limit.
  constexpr double for_small_pieces = 2e5;
  constexpr double over_expected = 10.0;
  const auto most = static_cast<std::size_t>(for_small_pieces + over_expected * expected);
  PlaneMesh mesh = Mesher(all, size, most).mesh();
  smooth(mesh);
  if (area < 0.0) // numbers are those of the outline as it was given
    for (BoundarySide& side : mesh.boundary)
      side.segment = last - side.segment;
  return mesh;
}

double smallest_angle(const PlaneMesh& mesh) {
  double least = std::numbers::pi;
  for (const auto& [a, b, c] : mesh.triangles)
    least = std::min(least, smallest_angle(mesh.points[static_cast<std::size_t>(a)],
                                           mesh.points[static_cast<std::size_t>(b)],
                                           mesh.points[static_cast<std::size_t>(c)]));
  return least * 180.0 / std::numbers::pi;
}

} // namespace billet::geometry
