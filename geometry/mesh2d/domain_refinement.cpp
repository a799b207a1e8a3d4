#include "geometry/mesh2d/domain_refinement.h"

#include "geometry/base/angle.h"
#include "geometry/base/error.h"
#include "geometry/mesh2d/triangulation_walk.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <queue>
#include <set>
#include <unordered_map>
#include <utility>

namespace billet::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Faces = CGAL::Triangulation_face_base_with_info_2<int, Kernel, FaceBase>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, Faces>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;
using Edge = Triangulation::Edge;

constexpr double most_triangles = 1e7;

/// sin^2 of the least angle asked for, as for outlines (G.37).
constexpr double shape_bound = 0.125;

/// The longest side of a triangle may be longer than the size by this: on average they are then
/// about as long as it.
constexpr double stretch = 1.3;

/// Inner points lie on a grid of this fraction of the shortest side.
constexpr double grid_fraction = 1.0 / 4096.0;

/// Sides that meet at a smaller angle are split at the same distances from their corner, 60
/// degrees.
constexpr double sharp_cosine = 0.5;

Point point(const Vec2& x) { return {x.x(), x.y()}; }
Vec2 vec(const Point& p) { return {p.x(), p.y()}; }
Vec2 vec(Vertex v) { return vec(v->point()); }

/// Whether x lies within the circle over a and b.
bool encroaches(const Vec2& x, const Vec2& a, const Vec2& b) { return (a - x).dot(b - x) < 0.0; }

[[noreturn]] void refuse(const Vec2& x) {
  throw Error(
      Fault::geometry, "",
      fmt::format("the boundary of the domain touches itself near ({:.6g}, {:.6g})", x.x(), x.y()));
}

class Refinement {
public:
  Refinement(std::span<const BoundaryCurve> curves,
             const std::vector<CurveSide>& sides,
             const RefinementRules& rules)
      : curves_(curves), rules_(rules) {
    insert_boundary(sides);
    find_sharp_corners();
    mark_domain(triangulation_);
    look_at_everything();
  }

  void run() {
    while (true) {
      if (!encroached_.empty()) {
        const std::size_t side = *encroached_.begin();
        encroached_.erase(encroached_.begin());
        if (is_encroached(side) && may_split(side))
          split(side);
      } else if (!bad_.empty()) {
        const Bad bad = bad_.top();
        bad_.pop();
        if (still_there(bad))
          mend(bad);
      } else {
        return;
      }
    }
  }

  [[nodiscard]] RefinedDomain result();

private:
  struct Side {
    CurveSide place;
    Vertex a, b;
  };
  /// A triangle that is too large or too flat.
  struct Bad {
    double badness; ///< above 1: too large
    Face face;
    std::array<Vertex, 3> vertices;
    std::array<std::int32_t, 3> numbers; ///< of the vertices, rising

    Bad(double how, Face which)
        : badness(how), face(which), vertices{which->vertex(0), which->vertex(1), which->vertex(2)},
          numbers{vertices[0]->info(), vertices[1]->info(), vertices[2]->info()} {
      std::sort(numbers.begin(), numbers.end());
    }
    bool operator<(const Bad& other) const { // the worst first; faces come in no order of theirs
      return badness != other.badness ? badness < other.badness : numbers > other.numbers;
    }
  };
  struct Shape {
    std::array<Vec2, 3> corners;
    std::array<double, 3> lengths2; ///< of the sides opposite to them, squared
    int opposite;                   ///< corner opposite to the shortest
  };
  /// A corner with a small angle of the domain, and the spans of the boundary next to it.
  struct Sharp {
    Vec2 at;
    std::int32_t loop;
    double before, place, after; ///< kept corners; before < place or, round the end, larger
  };

  void insert_boundary(const std::vector<CurveSide>& sides);
  void find_sharp_corners();
  void look_at_everything();
  void look_at(Face face);
  void look_around(Vertex vertex);

  [[nodiscard]] Vertex add_vertex(const Vec2& x, Face near);
  void add_side(std::size_t number, const Side& side);
  [[nodiscard]] Edge edge_of(const Side& side) const;
  [[nodiscard]] std::size_t side_of(const Edge& edge) const;
  [[nodiscard]] static std::uint64_t key(Vertex a, Vertex b) {
    return (static_cast<std::uint64_t>(a->info()) << 32) + static_cast<std::uint64_t>(b->info());
  }

  [[nodiscard]] double length(std::size_t side) const {
    return (vec(sides_[side].a) - vec(sides_[side].b)).norm();
  }
  [[nodiscard]] bool may_split(std::size_t side) const {
    return length(side) > 2.0 * rules_.shortest;
  }
  [[nodiscard]] bool is_encroached(std::size_t side) const;
  [[nodiscard]] double place_to_split(const Side& side) const;
  /// False if faces were lost that did not have the new vertex; all have been looked at then.
  bool split(std::size_t side);
  bool constrain(Vertex a, Vertex b);
  void mark_around(Vertex vertex, Vertex before, Vertex after);

  [[nodiscard]] static Shape shape(Face face);
  [[nodiscard]] double flatness(Face face) const;
  [[nodiscard]] double badness(Face face) const;
  [[nodiscard]] bool is_tip(const Vec2& x, Vertex u, Vertex v) const;
  [[nodiscard]] bool lies_before(Vertex v, const Sharp& corner) const;
  [[nodiscard]] bool lies_after(Vertex v, const Sharp& corner) const;
  static bool still_there(const Bad& bad);
  void mend(const Bad& bad);
  [[nodiscard]] Point rounded(const Point& x) const;
  [[nodiscard]] std::vector<std::size_t> sides_in_the_way(Face face, const Point& centre) const;

  std::span<const BoundaryCurve> curves_;
  const RefinementRules& rules_;
  Triangulation triangulation_;
  std::vector<Side> sides_;
  std::vector<CurveSide> places_; ///< of vertices on the boundary, `from` alone
  std::unordered_map<std::uint64_t, std::size_t> numbers_; ///< of sides, by their vertices in turn
  std::vector<Sharp> sharp_;
  std::set<std::size_t> encroached_; ///< sides to look at
  std::priority_queue<Bad> bad_;
};

Vertex Refinement::add_vertex(const Vec2& x, Face near) {
  const std::size_t before = triangulation_.number_of_vertices();
  const Vertex vertex = triangulation_.insert(point(x), near);
  if (triangulation_.number_of_vertices() == before)
    refuse(x);
  if (2.0 * static_cast<double>(before) > most_triangles)
    throw Error(Fault::limit, "",
                fmt::format("more than {:.0e} triangles would be made", most_triangles),
                "give larger sizes");
  vertex->info() = static_cast<std::int32_t>(before);
  return vertex;
}

void Refinement::add_side(std::size_t number, const Side& side) {
  if (number == sides_.size())
    sides_.push_back(side);
  else
    sides_[number] = side;
  numbers_[key(side.a, side.b)] = number;
}

void Refinement::insert_boundary(const std::vector<CurveSide>& sides) {
  std::vector<Vertex> vertices;
  Face near;
  for (const CurveSide& side : sides) {
    vertices.push_back(
        add_vertex(curves_[static_cast<std::size_t>(side.loop)].point(side.from), near));
    near = vertices.back()->face();
    places_.push_back(side);
  }
  std::size_t first = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].loop != sides[first].loop)
      first = i;
    const bool last = i + 1 == sides.size() || sides[i + 1].loop != sides[i].loop;
    const Side side{sides[i], vertices[i], vertices[last ? first : i + 1]};
    try {
      triangulation_.insert_constraint(side.a, side.b);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      refuse(vec(side.a));
    }
    add_side(i, side);
  }
}

void Refinement::find_sharp_corners() {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& out = sides_[i];
    const BoundaryCurve& curve = curves_[static_cast<std::size_t>(out.place.loop)];
    const std::vector<double>& kept = curve.kept();
    const auto at = std::lower_bound(kept.begin(), kept.end(), out.place.from);
    if (at == kept.end() || *at != out.place.from)
      continue;
    const auto in = std::find_if(sides_.begin(), sides_.end(),
                                 [&](const Side& side) { return side.b == out.a; });
    const Vec2 u = vec(in->a) - vec(out.a), v = vec(out.b) - vec(out.a);
    if (u.dot(v) < sharp_cosine * u.norm() * v.norm())
      continue;
    sharp_.push_back({vec(out.a), out.place.loop, at == kept.begin() ? kept.back() : *(at - 1), *at,
                      at + 1 == kept.end() ? curve.length() : *(at + 1)});
  }
}

void Refinement::look_at_everything() {
  bad_ = {};
  for (std::size_t i = 0; i < sides_.size(); ++i)
    encroached_.insert(i);
  for (const Face face : triangulation_.finite_face_handles())
    if (face->info() == 1)
      look_at(face);
}

/// Notes the face if it is bad, and sides that it encroaches upon.
void Refinement::look_at(Face face) {
  const double how = badness(face);
  if (how > 0.0)
    bad_.emplace(how, face);
  for (int i = 0; i < 3; ++i)
    if (face->is_constrained(i) &&
        encroaches(vec(face->vertex(i)), vec(face->vertex(Triangulation::ccw(i))),
                   vec(face->vertex(Triangulation::cw(i)))))
      encroached_.insert(side_of({face, i}));
}

void Refinement::look_around(Vertex vertex) {
  auto face = triangulation_.incident_faces(vertex);
  const auto start = face;
  do {
    if (face->info() == 1)
      look_at(face);
  } while (++face != start);
}

/// The face left of a side and the side's number in it.
Edge Refinement::edge_of(const Side& side) const {
  Face face;
  int edge = 0;
  triangulation_.is_edge(side.a, side.b, face, edge);
  if (face->vertex(Triangulation::ccw(edge)) == side.a)
    return {face, edge};
  return {face->neighbor(edge), triangulation_.tds().mirror_index(face, edge)};
}

/// Of a constrained edge of a face in the domain.
std::size_t Refinement::side_of(const Edge& edge) const {
  return numbers_.at(key(edge.first->vertex(Triangulation::ccw(edge.second)),
                         edge.first->vertex(Triangulation::cw(edge.second))));
}

bool Refinement::is_encroached(std::size_t number) const {
  const Side& side = sides_[number];
  const auto [face, edge] = edge_of(side);
  return encroaches(vec(face->vertex(edge)), vec(side.a), vec(side.b));
}

/// The middle; next to a sharp corner, a power of two from it, so that both edges that meet there
/// are split at the same distances.
double Refinement::place_to_split(const Side& side) const {
  const auto is_sharp = [&](Vertex v) {
    return std::any_of(sharp_.begin(), sharp_.end(),
                       [&](const Sharp& corner) { return corner.at == vec(v); });
  };
  const bool at_a = is_sharp(side.a), at_b = is_sharp(side.b);
  if (at_a == at_b)
    return side.place.middle();
  const BoundaryCurve& curve = curves_[static_cast<std::size_t>(side.place.loop)];
  const double unit = curve.length(), chord = (vec(side.b) - vec(side.a)).norm();
  const double wanted = unit * std::exp2(std::round(std::log2(0.5 * chord / unit)));
  const double place = at_a ? curve.place_at(side.place.from, wanted, 1.0)
                            : curve.place_at(side.place.to, wanted, -1.0);
  const double whole = side.place.to - side.place.from;
  const double part = (place - side.place.from) / whole;
  return part > 0.25 && part < 0.75 ? place : side.place.middle();
}

/// Marks an edge between a and b; false if other edges had to give way.
bool Refinement::constrain(Vertex a, Vertex b) {
  Face face;
  int edge = 0;
  if (triangulation_.is_edge(a, b, face, edge)) {
    face->set_constraint(edge, true);
    face->neighbor(edge)->set_constraint(triangulation_.tds().mirror_index(face, edge), true);
    return true;
  }
  try {
    triangulation_.insert_constraint(a, b);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    refuse(vec(a));
  }
  return false;
}

/// Marks the faces around a vertex of the boundary.
void Refinement::mark_around(Vertex vertex, Vertex before, Vertex after) {
  auto face = triangulation_.incident_faces(vertex);
  while (face->vertex(Triangulation::ccw(face->index(vertex))) != after)
    ++face;
  const auto start = face;
  int in = 1;
  do {
    face->info() = in;
    if (face->vertex(Triangulation::cw(face->index(vertex))) == before)
      in = 0;
  } while (++face != start);
}

bool Refinement::split(std::size_t number) {
  const Side side = sides_[number];
  const auto [face, edge] = edge_of(side);
  // Without the constraint, but still an edge: the new vertex lies next to it and makes it flip.
  face->set_constraint(edge, false);
  face->neighbor(edge)->set_constraint(triangulation_.tds().mirror_index(face, edge), false);
  const double place = place_to_split(side);
  const BoundaryCurve& curve = curves_[static_cast<std::size_t>(side.place.loop)];
  const Vertex vertex = add_vertex(curve.point(place), face);
  places_.resize(triangulation_.number_of_vertices(), {-1, 0.0, 0.0});
  places_.back() = {side.place.loop, place, place};
  numbers_.erase(key(side.a, side.b));
  add_side(number, {{side.place.loop, side.place.from, place}, side.a, vertex});
  add_side(sides_.size(), {{side.place.loop, place, side.place.to}, vertex, side.b});
  const bool first = constrain(side.a, vertex), second = constrain(vertex, side.b);
  if (!first || !second) {
    mark_domain(triangulation_);
    look_at_everything();
    return false;
  }
  mark_around(vertex, side.a, side.b);
  encroached_.insert(number);
  encroached_.insert(sides_.size() - 1);
  look_around(vertex);
  return true;
}

bool Refinement::lies_before(Vertex v, const Sharp& corner) const {
  const auto number = static_cast<std::size_t>(v->info());
  if (number >= places_.size() || places_[number].loop != corner.loop)
    return false;
  const double s = places_[number].from;
  return corner.before < corner.place ? s > corner.before && s < corner.place : s > corner.before;
}

bool Refinement::lies_after(Vertex v, const Sharp& corner) const {
  const auto number = static_cast<std::size_t>(v->info());
  if (number >= places_.size() || places_[number].loop != corner.loop)
    return false;
  const double s = places_[number].from;
  return s > corner.place && s < corner.after;
}

/// Whether the triangle is the tip of a sharp corner at x, between u and v that are equally far
/// from it: it is as it was meant.
bool Refinement::is_tip(const Vec2& x, Vertex u, Vertex v) const {
  return std::any_of(sharp_.begin(), sharp_.end(), [&](const Sharp& corner) {
    if (corner.at != x || !((lies_before(u, corner) && lies_after(v, corner)) ||
                            (lies_before(v, corner) && lies_after(u, corner))))
      return false;
    const double r = (vec(u) - x).norm(), q = (vec(v) - x).norm();
    return std::abs(r - q) < 0.01 * (r + q);
  });
}

Refinement::Shape Refinement::shape(Face face) {
  const std::array<Vec2, 3> x{vec(face->vertex(0)), vec(face->vertex(1)), vec(face->vertex(2))};
  std::array<double, 3> lengths2;
  for (std::size_t i = 0; i < 3; ++i)
    lengths2[i] = (x[(i + 1) % 3] - x[(i + 2) % 3]).squaredNorm();
  const auto shortest = std::min_element(lengths2.begin(), lengths2.end()) - lengths2.begin();
  return {x, lengths2, static_cast<int>(shortest)};
}

/// How flat a triangle is: 0 if not too much, at most 1.
double Refinement::flatness(Face face) const {
  const auto [x, lengths2, opposite] = shape(face);
  const double twice = cross(x[1] - x[0], x[2] - x[0]);
  // The shortest side is opposite to the smallest angle.
  const double sine2 = twice * twice * lengths2[static_cast<std::size_t>(opposite)] /
                       (lengths2[0] * lengths2[1] * lengths2[2]);
  return sine2 >= shape_bound ? 0.0 : 1.0 - sine2;
}

/// 0: good; up to 1: too flat; above: too large.
double Refinement::badness(Face face) const {
  const auto [x, lengths2, opposite] = shape(face);
  if (is_tip(x[static_cast<std::size_t>(opposite)], face->vertex(Triangulation::ccw(opposite)),
             face->vertex(Triangulation::cw(opposite))))
    return 0.0;
  const double longest2 = *std::max_element(lengths2.begin(), lengths2.end());
  const double size = stretch * rules_.size((x[0] + x[1] + x[2]) / 3.0);
  return longest2 > size * size ? longest2 / (size * size) : flatness(face);
}

bool Refinement::still_there(const Bad& bad) {
  for (int i = 0; i < 3; ++i)
    if (bad.face->vertex(i) != bad.vertices[static_cast<std::size_t>(i)])
      return false;
  return bad.face->info() == 1;
}

/// Sides that part the face from the centre of its circle, or that the centre encroaches upon.
std::vector<std::size_t> Refinement::sides_in_the_way(Face face, const Point& centre) const {
  const Point inside =
      CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point());
  int exit = 0;
  while (exit < 2 && (triangulation_.orientation(
                          inside, centre, face->vertex(Triangulation::ccw(exit))->point()) > 0 ||
                      triangulation_.orientation(
                          inside, centre, face->vertex(Triangulation::cw(exit))->point()) < 0))
    ++exit;
  const auto end = walk(triangulation_, face, exit, inside, centre);
  if (end.edge >= 0)
    return {side_of({end.face, end.edge})};
  std::vector<Edge> border;
  std::vector<Face> conflicts;
  triangulation_.get_conflicts_and_boundary(centre, std::back_inserter(conflicts),
                                            std::back_inserter(border), end.face);
  std::vector<std::size_t> result;
  for (const Edge& edge : border) // given from outside or inside
    if (edge.first->is_constrained(edge.second)) {
      const Edge own = edge.first->info() == 1 ? edge : triangulation_.mirror_edge(edge);
      const std::size_t side = side_of(own);
      if (encroaches(vec(centre), vec(sides_[side].a), vec(sides_[side].b)))
        result.push_back(side);
    }
  return result;
}

/// A point of a fine grid: without it rounding errors grow from centre to centre of flat triangles,
/// and the mesh in mm is not that in m.
Point Refinement::rounded(const Point& x) const {
  const Vec2 origin = vec(sides_.front().a);
  const double grid = grid_fraction * rules_.shortest;
  const Vec2 steps = (vec(x) - origin) / grid;
  return point(origin + grid * Vec2(std::round(steps.x()), std::round(steps.y())));
}

/// Inserts the centre of the circle of a bad face, or splits the sides that are in its way.
void Refinement::mend(const Bad& bad) {
  const Point centre = rounded(triangulation_.circumcenter(bad.face));
  if (!std::isfinite(centre.x()) || !std::isfinite(centre.y()))
    return;
  const std::vector<std::size_t> sides = sides_in_the_way(bad.face, centre);
  if (sides.empty()) {
    const Vertex vertex = add_vertex(vec(centre), bad.face);
    auto face = triangulation_.incident_faces(vertex);
    const auto start = face;
    do
      face->info() = 1;
    while (++face != start);
    return look_around(vertex);
  }
  bool any = false;
  for (const std::size_t side : sides) {
    // Sides of the boundary have the right size: a triangle too large is no reason to halve them.
    const bool wanted =
        bad.badness <= 1.0 ||
        length(side) > rules_.size(0.5 * (vec(sides_[side].a) + vec(sides_[side].b)));
    if (!wanted || !may_split(side))
      continue;
    if (!split(side))
      return;
    any = true;
  }
  const double flat = any ? bad.badness : bad.badness > 1.0 ? flatness(bad.face) : 0.0;
  if (flat > 0.0)
    bad_.emplace(flat, bad.face);
}

/// The same triangle, from its vertex of least number on.
std::array<Vertex, 3> from_least(std::array<Vertex, 3> triangle) {
  std::rotate(triangle.begin(),
              std::min_element(triangle.begin(), triangle.end(),
                               [](Vertex a, Vertex b) { return a->info() < b->info(); }),
              triangle.end());
  return triangle;
}

/// Everything in an order that does not depend on how the triangulation stores its faces.
RefinedDomain Refinement::result() {
  RefinedDomain result;
  std::sort(sides_.begin(), sides_.end(), [](const Side& p, const Side& q) {
    return p.place.loop != q.place.loop ? p.place.loop < q.place.loop : p.place.from < q.place.from;
  });
  std::vector<std::array<Vertex, 3>> faces;
  for (const Face face : triangulation_.finite_face_handles())
    if (face->info() == 1)
      faces.push_back(from_least({face->vertex(0), face->vertex(1), face->vertex(2)}));
  std::sort(faces.begin(), faces.end(), [](const auto& p, const auto& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end(),
                                        [](Vertex a, Vertex b) { return a->info() < b->info(); });
  });
  std::vector<std::int32_t> number(triangulation_.number_of_vertices(), -1);
  const auto add = [&](Vertex vertex) {
    std::int32_t& own = number[static_cast<std::size_t>(vertex->info())];
    if (own < 0) {
      own = static_cast<std::int32_t>(result.mesh.points.size());
      result.mesh.points.push_back(vec(vertex));
    }
    return own;
  };
  for (const Side& side : sides_)
    add(side.a);
  for (const Side& side : sides_) {
    const BoundaryCurve& curve = curves_[static_cast<std::size_t>(side.place.loop)];
    result.mesh.boundary.push_back({{add(side.a), add(side.b)},
                                    curve.point(side.place.middle()),
                                    curve.part(side.place.middle())});
    result.sides.push_back(side.place);
  }
  for (const auto& [a, b, c] : faces)
    result.mesh.triangles.push_back({add(a), add(b), add(c)});
  return result;
}

} // namespace

RefinedDomain refine(std::span<const BoundaryCurve> curves,
                     const std::vector<CurveSide>& sides,
                     const RefinementRules& rules) {
  Refinement refinement(curves, sides, rules);
  refinement.run();
  return refinement.result();
}

} // namespace billet::geometry
