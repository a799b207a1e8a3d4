#include "contact/self/self_contact_term.h"

#include "contact/self/laps.h"
#include "contact/term/couplings.h"
#include "contact/term/penalty_factors.h"
#include "mechanics/equilibrium/faces.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace billet::contact {

namespace {

using mechanics::Coupling;

/// Gaps below this share of the parent element are rounding of coordinates.
constexpr double rounding = 1e-10;
/// Faces are looked for as far ahead as this many of the last increment's ways, ...
constexpr double ways_ahead = 4.0;
/// ... and this share of a face's depth, ...
constexpr double depths_ahead = 0.5;
/// ... but no farther than this many: what comes from beyond in one increment is a passage.
constexpr double most_depths_ahead = 4.0;

bool is_plane(const ContactSurface& surface) {
  return surface.analysis() != mechanics::Analysis::solid;
}

double mean_depth(const ContactSurface& surface) {
  double sum = 0.0;
  for (Index f = 0; f < surface.n_faces(); ++f)
    sum += surface.depth(f);
  return surface.n_faces() > 0 ? sum / surface.n_faces() : 0.0;
}

/// A node and the variables of a traction that it is in.
struct NodeVariables {
  Index node;
  std::array<double, 7> weights{}; ///< in each group of three variables
};

/// What the traction at a point puts on the nodes of both faces, and its derivative.
class PairEquations {
public:
  PairEquations(const ContactSurface& surface, const SelfTraction& traction, std::size_t point)
      : traction_(traction), dim_(is_plane(surface) ? 2 : 3),
        shapes_(surface.kind(), traction.foot.place.xi),
        face_(surface.scatter().nodes(traction.foot.face)) {
    for (std::size_t b = 0; b < face_.size(); ++b)
      variables_.push_back(
          {face_[b], {0.0, shapes_.N[b], shapes_.d1[b], shapes_.d2[b], 0.0, 0.0, 0.0}});
    if (traction.old_face >= 0) {
      const FaceShapes old(surface.kind(), traction.old_xi);
      const std::span<const Index> nodes = surface.scatter().nodes(traction.old_face);
      for (std::size_t c = 0; c < nodes.size(); ++c)
        variables_.push_back({nodes[c], {0.0, 0.0, 0.0, 0.0, old.N[c], old.d1[c], old.d2[c]}});
    }
    own_ = surface.scatter().nodes(static_cast<Index>(point / idx(surface.points())));
  }

  /// @param at      the point on its face
  /// @param weight  of the point's area
  template <class FacePoint>
  void add(const FacePoint& at, double weight, mechanics::System& system) {
    const double area = weight * at.measure;
    const Vec3& T = traction_.law.traction;
    for (std::size_t a = 0; a < own_.size(); ++a)
      add_force(own_[a], -at.N[a] * area * T, system);
    for (std::size_t b = 0; b < face_.size(); ++b)
      add_force(face_[b], shapes_.N[b] * area * T, system);
    if (system.forces_only)
      return;
    for (std::size_t a = 0; a < own_.size(); ++a)
      variables_.push_back({own_[a], {at.N[a], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}});
    for (const NodeVariables& column : variables_) {
      const Mat3 dT = by_node(traction_.d_traction, column);
      const Eigen::Matrix<double, 2, 3> dxi = by_node(traction_.d_place, column);
      for (std::size_t a = 0; a < own_.size(); ++a)
        add_block(own_[a], column.node, -at.N[a] * area * dT, system);
      for (std::size_t b = 0; b < face_.size(); ++b)
        add_block(face_[b], column.node,
                  area * (shapes_.N[b] * dT +
                          T * (shapes_.d1[b] * dxi.row(0) + shapes_.d2[b] * dxi.row(1))),
                  system);
    }
    for (std::size_t c = 0; c < own_.size(); ++c) { // the area grows
      const Mat3 growth = weight * T * at.dmeasure[c].transpose();
      for (std::size_t a = 0; a < own_.size(); ++a)
        add_block(own_[a], own_[c], -at.N[a] * growth, system);
      for (std::size_t b = 0; b < face_.size(); ++b)
        add_block(face_[b], own_[c], shapes_.N[b] * growth, system);
    }
  }

private:
  template <int rows>
  [[nodiscard]] static Eigen::Matrix<double, rows, 3>
  by_node(const Eigen::Matrix<double, rows, n_self_variables>& by_variables,
          const NodeVariables& node) {
    Eigen::Matrix<double, rows, 3> sum = Eigen::Matrix<double, rows, 3>::Zero();
    for (int g = 0; g < n_self_variables / 3; ++g)
      if (const double w = node.weights[idx(g)]; w != 0.0)
        sum += w * by_variables.template middleCols<3>(3 * g);
    return sum;
  }
  void add_force(Index node, const Vec3& force, mechanics::System& system) const {
    for (int d = 0; d < dim_; ++d)
      system.residual[idx(node * dim_ + d)] += force[d];
  }
  void add_block(Index row, Index column, const Mat3& block, mechanics::System& system) const {
    for (int i = 0; i < dim_; ++i)
      for (int j = 0; j < dim_; ++j)
        if (block(i, j) != 0.0)
          system.couplings.push_back({row * dim_ + i, column * dim_ + j, block(i, j)});
  }

  const SelfTraction& traction_;
  int dim_;
  FaceShapes shapes_;
  std::span<const Index> face_, own_;
  std::vector<NodeVariables> variables_;
};

/// The shear and the offset of a closed point in axes of the place that it touches.
void store(const ContactSurface& surface,
           std::span<const double> x,
           const Vec3& position,
           const Vec3& shear,
           SelfPoint& point) {
  const std::vector<Vec3> nodes = nodes_of_face(surface, x, point.face);
  const FaceFrame frame(FaceShapes(surface.kind(), point.xi), nodes, is_plane(surface));
  const Mat3 axes = frame.axes();
  point.offset = axes.transpose() * (position - frame.position);
  point.shear = axes.transpose() * shear;
  point.history.normal = frame.normal();
  point.history.shear = shear;
}

} // namespace

SelfContactTerm::SelfContactTerm(const ContactSurface& surface,
                                 const mechanics::Bulk& bulk,
                                 const Friction& friction)
    : surface_(&surface), bulk_(&bulk), friction_(&friction), positions_(surface.n_points()) {
  state_.points.resize(surface.n_points());
  state_.ahead.resize(surface.n_points());
}

void SelfContactTerm::start(std::span<const double> x) {
  // On a new mesh the way to the present may be gone several times, each from another beginning.
  state_ = SelfContactState{};
  state_.points.resize(surface_->n_points());
  state_.ahead.resize(surface_->n_points());
  std::fill(trial_.begin(), trial_.end(), SelfTraction{});
  look_ahead(*surface_, x, mean_depth(*surface_), true, state_);
  if (!state_.any_ahead)
    return;
  // What a mesh is off by presses nothing.
  surface_->positions(x, positions_);
  for (std::size_t k = 0; k < state_.points.size(); ++k)
    if (const SelfFoot foot = find_foot(*surface_, x, state_.ahead[k], positions_[k]);
        foot.face >= 0)
      state_.points[k].history.offset = std::max(0.0, -foot.gap);
}

SelfContactSnapshot SelfContactTerm::snapshot(std::span<const double> x) const {
  SelfContactSnapshot made{{}, state_.laps_since, state_.work};
  if (std::none_of(state_.points.begin(), state_.points.end(),
                   [](const SelfPoint& point) { return point.closed() || point.lap >= 0; }))
    return made;
  for (const SelfPoint& point : state_.points) {
    SelfPointInSpace& in_space = made.points.emplace_back();
    in_space.history = point.history;
    in_space.closed = point.closed();
    in_space.since = point.since;
    in_space.shear_yield = point.shear_yield;
    in_space.lap = point.lap;
    if (point.closed()) {
      const std::vector<Vec3> nodes = nodes_of_face(*surface_, x, point.face);
      const FaceFrame frame(FaceShapes(surface_->kind(), point.xi), nodes, is_plane(*surface_));
      in_space.history.shear = frame.axes() * point.shear;
    }
  }
  return made;
}

void SelfContactTerm::go_on_from(const SelfContactSnapshot& before,
                                 std::span<const PointSource> sources,
                                 std::span<const double> x) {
  start(x);
  state_.work = before.work;
  state_.laps_since = before.laps_since;
  if (before.points.empty())
    return;
  surface_->positions(x, positions_);
  for (std::size_t k = 0; k < state_.points.size(); ++k) {
    const SelfPointInSpace& from = before.points[sources[k].nearest()];
    SelfPoint& point = state_.points[k];
    point.history.sliding = from.history.sliding;
    point.lap = from.lap;
    if (!from.closed)
      continue;
    const SelfFoot foot = find_foot(*surface_, x, state_.ahead[k], positions_[k]);
    constexpr double near = 0.05; // of the parent element
    if (foot.face < 0 || foot.gap > near * surface_->depth(foot.face))
      continue;
    const PointHistory& old = from.history;
    point.face = foot.face;
    point.xi = foot.place.xi;
    point.since = from.since;
    point.shear_yield = from.shear_yield;
    point.history.pressure = old.pressure;
    // The pressure goes on, whatever the gap of the new mesh.
    point.history.offset = -foot.gap - old.pressure / penalty(1.0).normal;
    point.history.stiffness = old.stiffness;
    point.history.limit = old.limit;
    point.history.slips = old.slips;
    store(*surface_, x, positions_[k], turn(old.shear, old.normal, foot.normal), point);
  }
}

Penalty SelfContactTerm::penalty(double softening) const {
  return applied_penalty(*surface_, {}, softening).penalty;
}

SelfTraction SelfContactTerm::evaluate(std::size_t k,
                                       const Vec3& position,
                                       const mechanics::Trial& trial,
                                       const Penalty& penalty) const {
  const SelfPoint& old = state_.points[k];
  const SelfFoot foot = find_foot(*surface_, trial.x, state_.ahead[k], position);
  if (foot.face < 0)
    return {};
  const double softening = trial.softening.penetration;
  SelfInput in{.point = position,
               .foot = foot,
               .face = {},
               .old_face = {},
               .kind = surface_->kind(),
               .plane = is_plane(*surface_),
               .shear_yield = old.shear_yield,
               .rounding = rounding * surface_->depth(foot.face),
               .dt = trial.time - trial.time_old,
               .softening = trial.softening.slip,
               .carried = old.closed() ? (1.0 - softening) * old.history.pressure : 0.0};
  const double gap = foot.gap + old.history.offset;
  if (in.carried - penalty.normal * gap <= 0.0 && gap > in.rounding)
    return {};
  const std::vector<Vec3> face = nodes_of_face(*surface_, trial.x, foot.face);
  std::vector<Vec3> old_face;
  if (old.closed())
    old_face = nodes_of_face(*surface_, trial.x, old.face);
  in.face = face;
  in.old_face = old_face;
  return self_traction(*friction_, penalty, old, in, surface_->scheme());
}

Outcome<mechanics::Assembled> SelfContactTerm::assemble(const mechanics::Trial& trial,
                                                        mechanics::System& system) {
  if (!state_.looked) {
    const double depth = mean_depth(*surface_);
    look_ahead(*surface_, trial.x_old,
               std::min(depths_ahead * depth + ways_ahead * state_.way, most_depths_ahead * depth),
               false, state_);
  }
  if (!state_.any_ahead)
    return mechanics::Assembled{};
  surface_->positions(trial.x, positions_);
  const Penalty applied = penalty(trial.softening.penetration);
  trial_.resize(surface_->n_points());
  bool any = false;
  for (std::size_t k = 0; k < trial_.size(); ++k) {
    if (state_.ahead[k].empty())
      continue;
    const Status before = trial_[k].law.status;
    trial_[k] = evaluate(k, positions_[k], trial, applied);
    system.contact_changes += trial_[k].law.status != before ? 1 : 0;
    if (trial_[k].closed()) {
      add_forces(k, trial.x, system);
      any = true;
    }
  }
  if (any) {
    system.symmetric = false;
    merge(system.couplings);
  }
  return mechanics::Assembled{};
}

void SelfContactTerm::add_forces(std::size_t k,
                                 std::span<const double> x,
                                 mechanics::System& system) const {
  visit_contact_face(surface_->kind(), surface_->form(), [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    const int i = static_cast<int>(k % idx(Rule::points));
    std::array<double, std::size_t{Shape::nodes} * dim> local{};
    mechanics::gather(x, surface_->scatter().nodes(static_cast<Index>(k / idx(Rule::points))), dim,
                      local.data());
    const mechanics::FacePoint<Shape> at(surface_->analysis(), local.data(), Rule::point(i),
                                         Rule::weight(i));
    PairEquations(*surface_, trial_[k], k).add(at, weight, system);
  });
}

double SelfContactTerm::shear_yield(std::size_t k) const {
  const std::optional<FollowedStress> followed = friction_->followed_stress();
  if (!followed)
    return 0.0;
  const std::size_t point = surface_->bulk_point(k);
  const double stress = *followed == FollowedStress::yield ? bulk_->trial_flow_stress(point)
                                                           : bulk_->trial_stress(point).stress;
  return stress / std::numbers::sqrt3;
}

void SelfContactTerm::commit_point(std::size_t k, const mechanics::Trial& trial, double area) {
  const Traction& now = trial_[k].law;
  SelfPoint& point = state_.points[k];
  const double sliding = point.history.sliding + now.slip.norm();
  const Penalty applied = penalty(1.0);
  const Index own = static_cast<Index>(k / idx(surface_->points()));
  const PenaltyWork penalty_work(applied.normal, {});
  const ShearBalance shear = balance(applied, point.history, now, sliding, surface_->depth(own));
  state_.work.friction += area * shear.friction_work;
  state_.work.unseen += area * shear.unseen;
  SelfPoint old = std::exchange(point, SelfPoint{});
  point.history.sliding = sliding;
  point.history.offset = old.history.offset;
  point.lap = old.lap;
  point.shear_yield = shear_yield(k);
  if (!trial_[k].closed())
    return;
  point.face = trial_[k].foot.face;
  point.xi = trial_[k].foot.place.xi;
  point.since = old.closed() ? old.since : trial.time;
  point.history.pressure = now.pressure;
  point.history.limit = now.limit;
  point.history.slips = now.status == Status::slip;
  point.history.stiffness = shear.stiffness;
  store(*surface_, trial.x, positions_[k], now.shear, point);
  state_.work.stored +=
      area * (penalty_work.stored(now, 0.0) + shear_energy(now.shear, shear.stiffness));
  state_.area += area;
  state_.depth = std::max(state_.depth, -trial_[k].foot.gap);
}

void SelfContactTerm::commit(const mechanics::Trial& trial) {
  state_.work.stored = 0.0;
  state_.area = 0.0;
  state_.depth = 0.0;
  if (state_.any_ahead) {
    std::vector<double> areas(surface_->n_points());
    surface_->areas(trial.x, areas);
    for (std::size_t k = 0; k < trial_.size(); ++k)
      if (!state_.ahead[k].empty() || state_.points[k].closed())
        commit_point(k, trial, weight * areas[k]);
    mark_laps(*surface_, state_);
    std::fill(trial_.begin(), trial_.end(), SelfTraction{});
  }
  state_.way = relative_way(*surface_, trial.x_old, trial.x);
  state_.looked = false;
}

ContactWork SelfContactTerm::work_after(const mechanics::Trial& trial) const {
  if (state_.any_ahead) {
    SelfContactTerm after = *this;
    after.commit(trial);
    return after.work();
  }
  ContactWork same = work();
  same.stored = 0.0;
  return same;
}

std::optional<SelfPassage> SelfContactTerm::passage(const mechanics::Trial& trial) const {
  const double way = relative_way(*surface_, trial.x_old, trial.x);
  if (2.0 * way <= state_.look_ahead)
    return std::nullopt;
  return find_passage(*surface_, trial.x_old, trial.x, 2.0 * way, state_);
}

} // namespace billet::contact
