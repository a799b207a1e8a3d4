#include "geometry/collision/penetration_bound.h"

#include "geometry/base/limits.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace billet::geometry {

namespace {

constexpr int most_halvings = 60;     // of a face: its width is then that of rounding
constexpr int halvings_at_rim = 5;    // of what has its centre beyond the rim of an open tool
constexpr int most_remembered = 5;    // halvings: what is smaller is soon another place
constexpr double looser = 3.0;        // excess that balls of the search before may leave
constexpr int most_balls = 5;         // tried for a piece
constexpr double largest_ball = 1e6;  // radius over that of the piece; more is rounding
constexpr double small_ball = 30.0;   // the same, tried first: from afar many facets are near
constexpr double least_shrink = 0.02; // of a ball that would touch in two places
constexpr double most_shrink = 0.2;
constexpr double share_of_room = 0.25; // that the curvature of the ball may take
constexpr double rounding_of_distance =
    8.0 * std::numeric_limits<double>::epsilon(); // of a distance
constexpr std::size_t grain = 64;                 // pieces a task should have at least

struct Piece {
  Piece(const BezierPatch& of, std::size_t number) : shape(of), face(number) {}

  BezierPatch shape;
  std::size_t face;        ///< its place in the list of candidates
  std::uint64_t place = 1; ///< as of KnownPiece
  int halvings = 0;
  bool known_halved = false; ///< in the search before
  double allowed = 1.0;      ///< excess
  double bound = infinity;   ///< no point of the piece is deeper [mm]
  double sample = 0.0;       ///< depth of its deepest point looked at [mm]
  Vec3 sampled_at = Vec3::Zero();
  std::array<ClearBall, 2> clear; ///< those that gave the bound; tried first on both halves
  std::int32_t patch = -1;        ///< hint
  int queries = 0;
};

/// One number for each control point of a piece.
struct Heights {
  std::array<double, 9> at;
  std::size_t size = 0;

  double& operator[](std::size_t i) { return at[i]; }
  double operator[](std::size_t i) const { return at[i]; }
  [[nodiscard]] double largest() const {
    return *std::max_element(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(size));
  }
};

class Search {
public:
  Search(const RigidSurface& surface,
         std::span<const CandidateFace> faces,
         const BoundSearch& settings,
         std::span<const KnownPiece> known);

  PenetrationBound run();
  /// What the next search can begin with. (G.59)
  [[nodiscard]] std::vector<KnownPiece> take_found();

private:
  void look_at_all(std::vector<Piece>& pieces);
  void look(Piece& piece) const;
  void recall(Piece& piece) const;
  void remember(const Piece& piece, bool halved);
  void blow_up_ball(Piece& piece, const Projection& at) const;
  Projection look_at_point(Piece& piece, const Vec3& x) const;
  [[nodiscard]] Projection query(Piece& piece, const Vec3& x) const;
  [[nodiscard]] static Heights heights(const BezierPatch& shape, const ClearBall& ball);
  [[nodiscard]] static double together(const Heights& a, const Heights& b);
  static void use(Piece& piece, const ClearBall& ball);
  [[nodiscard]] double depth(const Piece& piece) const { return faces_[piece.face].depth; }
  [[nodiscard]] double tolerance(const Piece& piece) const;
  [[nodiscard]] double room(const Piece& piece, const Projection& at) const;
  [[nodiscard]] double excess(const Piece& piece) const;
  void sample(const Piece& piece);
  void decide(const Piece& piece);
  [[nodiscard]] std::vector<Piece> take_worst(std::vector<Piece>& pool);

  const RigidSurface& surface_;
  std::span<const CandidateFace> faces_;
  BoundSearch settings_;
  std::span<const KnownPiece> known_;
  std::vector<KnownPiece> found_;
  double deepest_;          ///< sample so far, anywhere [mm]
  double deepest_relative_; ///< the same, relative to the parent element [-]
  PenetrationBound result_;
};

bool before(const KnownPiece& a, const KnownPiece& b) {
  return std::pair(a.face, a.place) < std::pair(b.face, b.place);
}

Search::Search(const RigidSurface& surface,
               std::span<const CandidateFace> faces,
               const BoundSearch& settings,
               std::span<const KnownPiece> known)
    : surface_(surface), faces_(faces), settings_(settings), known_(known),
      deepest_(settings.known_depth), deepest_relative_(settings.known_relative) {}

Projection Search::query(Piece& piece, const Vec3& x) const {
  Projection at;
  at.patch = piece.patch;
  surface_.project({&x, 1}, infinity, {&at, 1});
  if (at.found())
    piece.patch = at.patch;
  ++piece.queries;
  return at;
}

double Search::tolerance(const Piece& piece) const {
  return std::max(settings_.tightness * deepest_, settings_.floor * depth(piece));
}

/// How far the bound of a piece may be above its depth, as deep as a flat tool would have it.
double Search::room(const Piece& piece, const Projection& at) const {
  double flat = -infinity;
  for (const Vec3& point : piece.shape.control())
    flat = std::max(flat, at.normal.dot(at.foot - point));
  const double deepest = std::min(deepest_, deepest_relative_ * depth(piece));
  return tolerance(piece) + std::max(deepest - flat, 0.0);
}

/// How far a bound is above the deepest samples, as a multiple of what is tolerated. (G.27)
double Search::excess(const Piece& piece) const {
  const double relative_tolerance =
      std::max(settings_.tightness * deepest_relative_, settings_.floor);
  return std::max((piece.bound - deepest_) / tolerance(piece),
                  (piece.bound / depth(piece) - deepest_relative_) / relative_tolerance);
}

/// Distances of the control points from a ball; their largest is a bound. (G.25)
Heights Search::heights(const BezierPatch& shape, const ClearBall& ball) {
  Heights heights;
  for (const Vec3& point : shape.control())
    heights[heights.size++] =
        (1.0 + rounding_of_distance) * (point - ball.centre).norm() - ball.radius;
  return heights;
}

/// The least of the largest of w a + (1 - w) b over 0 <= w <= 1: a bound as well, and a far better
/// one where the two balls lie on the two sides of an edge. (G.28)
///
/// The largest is a convex polygon over w. Its lowest corner is looked for where the two pieces
/// that enclose it meet; each time one of them gives way to what lies above that.
double Search::together(const Heights& a, const Heights& b) {
  const auto slope = [&](std::size_t i) { return a[i] - b[i]; };
  const auto at = [&](std::size_t i, double w) { return w * a[i] + (1.0 - w) * b[i]; };
  const auto highest = [&](double w) {
    std::size_t top = 0;
    for (std::size_t i = 1; i < a.size; ++i)
      if (at(i, w) > at(top, w))
        top = i;
    return top;
  };
  std::size_t falling = highest(0.0), rising = highest(1.0);
  if (slope(falling) >= 0.0)
    return at(falling, 0.0);
  if (slope(rising) <= 0.0)
    return at(rising, 1.0);
  double least = std::min(at(falling, 0.0), at(rising, 1.0));
  for (std::size_t i = 0; i < a.size; ++i) {
    const double w =
        std::clamp((b[falling] - b[rising]) / (slope(rising) - slope(falling)), 0.0, 1.0);
    const std::size_t top = highest(w);
    least = std::min(least, at(top, w));
    if (top == falling || top == rising)
      break;
    (slope(top) > 0.0 ? rising : falling) = top;
  }
  return least;
}

/// Bounds the piece by a ball, alone and together with each of those that it has.
void Search::use(Piece& piece, const ClearBall& ball) {
  const Heights now = heights(piece.shape, ball);
  if (now.largest() < piece.bound) {
    piece.bound = now.largest();
    piece.clear = {ball, piece.clear[0]};
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (piece.clear[k].radius == -infinity || piece.clear[k].centre == ball.centre)
      continue;
    const double bound = together(now, heights(piece.shape, piece.clear[k]));
    if (bound >= piece.bound)
      continue;
    piece.bound = bound;
    piece.clear = {ball, piece.clear[k]};
  }
}

/// Bounds the piece by the balls of the search before.
void Search::recall(Piece& piece) const {
  KnownPiece asked;
  asked.face = faces_[piece.face].id;
  asked.place = piece.place;
  const auto last = std::lower_bound(known_.begin(), known_.end(), asked, before);
  if (last == known_.end() || before(asked, *last))
    return;
  for (const ClearBall& ball : last->clear)
    if (ball.radius != -infinity)
      use(piece, ball);
  piece.known_halved = last->halved;
  if (excess(piece) <= looser)
    piece.allowed = looser;
}

void Search::remember(const Piece& piece, bool halved) {
  if (piece.clear[0].radius != -infinity && piece.halvings <= most_remembered)
    found_.push_back({faces_[piece.face].id, piece.place, halved, piece.clear});
}

void Search::look(Piece& piece) const {
  if (piece.halvings > 0) { // what bounded the whole bounds the half better
    const std::array<ClearBall, 2> of_whole = std::exchange(piece.clear, {});
    piece.bound = infinity;
    for (const ClearBall& ball : of_whole)
      use(piece, ball);
  }
  if (excess(piece) > 1.0)
    recall(piece);
  if (excess(piece) <= piece.allowed || piece.known_halved)
    return;
  const Vec3 x = piece.shape.centre();
  const Projection at = look_at_point(piece, x);
  if (!at.found() || at.gap < -settings_.reach) {
    if (piece.halvings >= halvings_at_rim)
      piece.bound = 0.0;
    return;
  }
  use(piece, {x, at.gap});
  if (excess(piece) > 1.0)
    blow_up_ball(piece, at);
  // Where the deepest point is a corner no centre comes close to it soon.
  if (excess(piece) > 1.0)
    look_at_point(piece, piece.shape.farthest_corner(piece.clear[0].centre));
}

Projection Search::look_at_point(Piece& piece, const Vec3& x) const {
  Projection at = query(piece, x);
  if (at.found() && at.gap >= -settings_.reach && -at.gap > piece.sample) {
    piece.sample = -at.gap;
    piece.sampled_at = x;
  }
  return at;
}

/// The largest ball that touches the tool from outside at the foot, by shrinking one that is too
/// large to the point of the tool nearest its centre. Each of them gives a bound. (G.26)
void Search::blow_up_ball(Piece& piece, const Projection& at) const {
  const double half = piece.shape.farthest(piece.shape.centre());
  const double much = share_of_room * room(piece, at); // for what the ball lacks to a plane
  const double enough = std::min(half * largest_ball, std::max(half, half * half / (2.0 * much)));
  double radius = std::min(enough, small_ball * half);
  for (int ball = 0; ball < most_balls; ++ball) {
    const Vec3 centre = at.foot + radius * at.normal;
    const Projection nearest = query(piece, centre);
    if (!nearest.found())
      return;
    use(piece, {centre, nearest.gap});
    // As large as a ball that touches at the foot can be, but for what does not matter.
    const bool touches = nearest.gap >= radius - much;
    const Vec3 way = nearest.foot - at.foot;
    const double height = way.dot(at.normal);
    if (excess(piece) <= 1.0)
      return;
    if (touches && ball == 0 && radius < enough) {
      radius = enough;
      continue;
    }
    if (touches || !(height > 0.0))
      return;
    // One that touches in two places, made smaller: from the centre of a hollow's curvature all of
    // it is equally far, and a search would have to look at every facet.
    const double touching = 0.5 * way.squaredNorm() / height;
    const double shrink = 2.0 * touching * much / (half * half);
    radius = std::min((1.0 - std::clamp(shrink, least_shrink, most_shrink)) * touching, radius);
  }
}

void Search::look_at_all(std::vector<Piece>& pieces) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pieces.size(), grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        look(pieces[i]);
                    });
  for (Piece& piece : pieces) {
    sample(piece);
    result_.queries += static_cast<std::size_t>(piece.queries);
    piece.queries = 0;
  }
}

void Search::sample(const Piece& piece) {
  const double relative = piece.sample / depth(piece);
  const std::size_t id = faces_[piece.face].id;
  if (piece.sample > result_.deepest.depth)
    result_.deepest = {piece.sample, piece.sampled_at, id};
  if (relative > result_.deepest_relative.depth)
    result_.deepest_relative = {relative, piece.sampled_at, id};
  deepest_ = std::max(deepest_, piece.sample);
  deepest_relative_ = std::max(deepest_relative_, relative);
}

std::vector<KnownPiece> Search::take_found() {
  std::sort(found_.begin(), found_.end(), before);
  return std::move(found_);
}

void Search::decide(const Piece& piece) {
  remember(piece, false);
  if (piece.bound == infinity)
    return; // never found: beyond a rim
  result_.bound = std::max(result_.bound, piece.bound);
  result_.relative_bound = std::max(result_.relative_bound, piece.bound / depth(piece));
}

/// Decides the pieces of the pool that are good enough, and takes out those of the worse half.
std::vector<Piece> Search::take_worst(std::vector<Piece>& pool) {
  double most = 1.0;
  for (const Piece& piece : pool)
    if (piece.halvings < most_halvings)
      most = std::max(most, excess(piece));
  std::vector<Piece> rest, worst;
  for (const Piece& piece : pool) {
    const double by = excess(piece);
    if (by <= piece.allowed || piece.halvings >= most_halvings)
      decide(piece);
    else
      (by >= 0.5 * most ? worst : rest).push_back(piece);
  }
  pool = std::move(rest);
  return worst;
}

PenetrationBound Search::run() {
  std::vector<Piece> pool;
  pool.reserve(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f)
    pool.emplace_back(faces_[f].shape, f);
  look_at_all(pool);
  while (true) {
    const std::vector<Piece> worst = take_worst(pool);
    if (worst.empty())
      break;
    if (result_.queries >= settings_.most_queries) {
      pool.insert(pool.end(), worst.begin(), worst.end());
      break;
    }
    std::vector<Piece> halves;
    halves.reserve(2 * worst.size());
    for (const Piece& piece : worst) {
      remember(piece, true);
      const std::array<BezierPatch, 2> shapes = piece.shape.halves();
      for (std::size_t half = 0; half < 2; ++half) {
        Piece& made = halves.emplace_back(piece);
        made.shape = shapes[half];
        made.place = 2 * piece.place + half;
        made.sample = 0.0;
        made.known_halved = false;
        made.allowed = 1.0;
        ++made.halvings;
      }
    }
    look_at_all(halves);
    pool.insert(pool.end(), halves.begin(), halves.end());
  }
  for (const Piece& piece : pool)
    decide(piece);
  result_.bound = std::max(result_.bound, result_.deepest.depth);
  result_.relative_bound = std::max(result_.relative_bound, result_.deepest_relative.depth);
  return result_;
}

} // namespace

PenetrationBound bound_penetration(const RigidSurface& surface,
                                   std::span<const CandidateFace> faces,
                                   const BoundSearch& search,
                                   std::vector<KnownPiece>& known) {
  Search bounds(surface, faces, search, known);
  PenetrationBound found = bounds.run();
  known = bounds.take_found();
  return found;
}

} // namespace billet::geometry
