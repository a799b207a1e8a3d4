#include "geometry/penetration_bound.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace billet::geometry {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_halvings = 60;           // of a face: its width is then that of rounding
constexpr int halvings_at_rim = 5;          // of what has its centre beyond the rim of an open tool
constexpr int most_balls = 5;               // tried for a piece
constexpr double largest_ball = 1e6;        // radius over that of the piece; more is rounding
constexpr double share_of_tolerance = 0.25; // that the curvature of the ball may take
constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon(); // of a distance
constexpr std::size_t grain = 64; // pieces a task should have at least

/// A ball that holds no point of the tool.
struct ClearBall {
  Vec3 centre = Vec3::Zero();
  double radius = -infinity; ///< none
};

struct Piece {
  Piece(const BezierPatch& of, std::size_t number) : shape(of), face(number) {}

  BezierPatch shape;
  std::size_t face; ///< its place in the list of candidates
  int halvings = 0;
  double bound = infinity; ///< no point of the piece is deeper [mm]
  double sample = 0.0;     ///< depth of its centre [mm]
  ClearBall clear;         ///< the one that gave the bound; tried first on both halves
  std::int32_t patch = -1; ///< hint
  int queries = 0;
};

class Search {
public:
  Search(const RigidSurface& surface,
         std::span<const CandidateFace> faces,
         const BoundSearch& settings);

  PenetrationBound run();

private:
  void look_at_all(std::vector<Piece>& pieces);
  void look(Piece& piece) const;
  void blow_up_ball(Piece& piece, const Projection& at) const;
  [[nodiscard]] Projection query(Piece& piece, const Vec3& x) const;
  static void use(Piece& piece, const ClearBall& ball);
  [[nodiscard]] double depth(const Piece& piece) const { return faces_[piece.face].depth; }
  [[nodiscard]] double tolerance(const Piece& piece) const;
  [[nodiscard]] double excess(const Piece& piece) const;
  void sample(const Piece& piece);
  void settle(const Piece& piece);
  [[nodiscard]] std::vector<Piece> take_worst(std::vector<Piece>& pool);

  const RigidSurface& surface_;
  std::span<const CandidateFace> faces_;
  BoundSearch settings_;
  double deepest_;          ///< sample so far, anywhere [mm]
  double deepest_relative_; ///< likewise [-]
  PenetrationBound result_;
};

Search::Search(const RigidSurface& surface,
               std::span<const CandidateFace> faces,
               const BoundSearch& settings)
    : surface_(surface), faces_(faces), settings_(settings), deepest_(settings.known_depth),
      deepest_relative_(settings.known_relative) {}

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

/// How far a bound is above the deepest samples, as a multiple of what is tolerated. (G.27)
double Search::excess(const Piece& piece) const {
  const double relative_tolerance =
      std::max(settings_.tightness * deepest_relative_, settings_.floor);
  return std::max((piece.bound - deepest_) / tolerance(piece),
                  (piece.bound / depth(piece) - deepest_relative_) / relative_tolerance);
}

/// No point is deeper than its distance from a ball that is clear of the tool. (G.25)
void Search::use(Piece& piece, const ClearBall& ball) {
  const double bound = (1.0 + rounding) * piece.shape.farthest(ball.centre) - ball.radius;
  if (bound >= piece.bound)
    return;
  piece.bound = bound;
  piece.clear = ball;
}

void Search::look(Piece& piece) const {
  if (piece.halvings > 0) { // what bounded the whole bounds the half better
    piece.bound = infinity;
    use(piece, ClearBall(piece.clear));
  }
  if (excess(piece) <= 1.0)
    return;
  const Vec3 x = piece.shape.centre();
  const Projection at = query(piece, x);
  if (!at.found() || at.gap < -settings_.reach) {
    if (piece.halvings >= halvings_at_rim)
      piece.bound = 0.0;
    return;
  }
  piece.sample = std::max(0.0, -at.gap);
  use(piece, {x, at.gap});
  if (excess(piece) > 1.0)
    blow_up_ball(piece, at);
}

/// The largest ball that touches the tool from outside at the foot, by shrinking one that is too
/// large to the point of the tool nearest its centre. Each of them gives a bound. (G.26)
void Search::blow_up_ball(Piece& piece, const Projection& at) const {
  const double half = piece.shape.farthest(piece.shape.centre());
  double radius =
      std::min(half * largest_ball,
               std::max(half, half * half / (2.0 * share_of_tolerance * tolerance(piece))));
  for (int ball = 0; ball < most_balls; ++ball) {
    const Vec3 centre = at.foot + radius * at.normal;
    const Projection nearest = query(piece, centre);
    if (!nearest.found())
      return;
    use(piece, {centre, nearest.gap});
    // As large as a ball that touches at the foot can be, but for what does not matter.
    const bool touches = nearest.gap >= radius - share_of_tolerance * tolerance(piece);
    const Vec3 way = nearest.foot - at.foot;
    const double height = way.dot(at.normal);
    if (touches || excess(piece) <= 1.0 || !(height > 0.0))
      return;
    radius = std::min(0.5 * way.squaredNorm() / height, radius);
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
    result_.deepest = {piece.sample, piece.shape.centre(), id};
  if (relative > result_.deepest_relative.depth)
    result_.deepest_relative = {relative, piece.shape.centre(), id};
  deepest_ = std::max(deepest_, piece.sample);
  deepest_relative_ = std::max(deepest_relative_, relative);
}

void Search::settle(const Piece& piece) {
  if (piece.bound == infinity)
    return; // never found: beyond a rim
  result_.bound = std::max(result_.bound, piece.bound);
  result_.relative_bound = std::max(result_.relative_bound, piece.bound / depth(piece));
}

/// Settles the pieces of the pool that are good enough, and takes out those of the worse half.
std::vector<Piece> Search::take_worst(std::vector<Piece>& pool) {
  double most = 1.0;
  for (const Piece& piece : pool)
    if (piece.halvings < most_halvings)
      most = std::max(most, excess(piece));
  std::vector<Piece> rest, worst;
  for (const Piece& piece : pool) {
    const double by = excess(piece);
    if (by <= 1.0 || piece.halvings >= most_halvings)
      settle(piece);
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
    for (const Piece& piece : worst)
      for (const BezierPatch& half : piece.shape.halves()) {
        halves.push_back(piece);
        halves.back().shape = half;
        halves.back().sample = 0.0;
        ++halves.back().halvings;
      }
    look_at_all(halves);
    pool.insert(pool.end(), halves.begin(), halves.end());
  }
  for (const Piece& piece : pool)
    settle(piece);
  result_.bound = std::max(result_.bound, result_.deepest.depth);
  result_.relative_bound = std::max(result_.relative_bound, result_.deepest_relative.depth);
  return result_;
}

} // namespace

PenetrationBound bound_penetration(const RigidSurface& surface,
                                   std::span<const CandidateFace> faces,
                                   const BoundSearch& search) {
  return Search(surface, faces, search).run();
}

} // namespace billet::geometry
