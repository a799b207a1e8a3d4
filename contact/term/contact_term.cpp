#include "contact/term/contact_term.h"

#include "contact/law/fading.h"
#include "geometry/base/stopwatch.h"
#include "mechanics/equilibrium/faces.h"

#include <Eigen/Geometry>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace billet::contact {

namespace {

using mechanics::FacePoint;

/// Gaps below this share of the element beneath are rounding of coordinates (of all of them when a
/// tool is brought to touch).
constexpr double rounding = 1e-10;
constexpr double rounding_of_touch = 1e-9;

/// Points a task should have at least.
constexpr std::size_t grain = 256;

/// The derivative of a traction without what couples its shear to the pressure, and symmetric: a
/// stiff normal and a soft tangential spring. (C.40)
Mat3 without_coupling(const Mat3& D, const Vec3& n) {
  const Mat3 plane = Mat3::Identity() - n * n.transpose();
  const Mat3 tangential = plane * D * plane;
  return n.dot(D * n) * n * n.transpose() + 0.5 * (tangential + tangential.transpose());
}

/// What rounding makes of a gap that is zero [mm].
double noise_of_gap(const Vec3& in_space, const Vec3& on_tool) {
  constexpr double units_in_the_last_place = 16.0;
  return units_in_the_last_place * std::numeric_limits<double>::epsilon() *
         (in_space.lpNorm<Eigen::Infinity>() + on_tool.lpNorm<Eigen::Infinity>());
}

} // namespace

ContactTerm::ContactTerm(const ContactSurface& surface,
                         const mechanics::Bulk& bulk,
                         const mechanics::BlockPattern& pattern,
                         std::span<const Tool> tools,
                         double reach,
                         const DriveScale& drives)
    : surface_(&surface), bulk_(&bulk), pattern_(&pattern), tools_(tools), reach_(reach),
      enabled_(tools.size(), 1), held_(tools.size(), 0), rests_(tools.size(), 0),
      positions_(surface.n_points()), predicted_positions_(surface.n_points()),
      areas_(surface.n_points()), traction_(surface.n_points()), dtraction_(surface.n_points()),
      symmetric_(surface.n_points()), touched_(surface.n_points()), loads_(tools.size()),
      closed_(tools.size()), drives_(drive_unknowns(tools)), scale_(drives) {
  const std::size_t n = surface.n_points();
  states_.resize(tools.size());
  for (std::size_t t = 0; t < tools.size(); ++t) {
    ToolState& state = states_[t];
    state.corners = CornerContact(surface, *tools[t].surface);
    state.history.resize(n);
    state.multiplier.resize(n, 0.0);
    state.touching.resize(n);
    state.trial.resize(n);
    state.position.resize(n);
    state.foot.resize(n);
    state.changes.resize(n, 0);
    state.friction_limited.resize(n, 0);
    state.queried_at.resize(n, Vec3::Zero());
    state.known_gap.resize(n, -std::numeric_limits<double>::infinity());
    state.force.resize(n, Vec3::Zero());
    state.even_at.resize(idx(surface.n_faces()), -1);
  }
}

void ContactTerm::start(std::span<const double> x, double time) {
  for (std::size_t t = 0; t < tools_.size(); ++t)
    start(t, x, time);
}

void ContactTerm::start(std::size_t tool, std::span<const double> x, double time) {
  surface_->positions(x, positions_);
  ToolState& state = states_[tool];
  search(tools_[tool], state, pose(tool, time, x));
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    PointHistory& history = state.history[k];
    const geometry::Projection& foot = state.foot[k];
    history.position = state.position[k];
    // What lies on the tool sticks from the start; rounding must not decide.
    if (acts(tool, time) && foot.gap <= rounding_of_touch * surface_->depth(face_of(k)))
      history.normal = foot.normal;
  }
}

Index ContactTerm::face_of(std::size_t point) const {
  return static_cast<Index>(point / idx(surface_->points()));
}

double ContactTerm::touching_gap(std::size_t point) const {
  return rounding * surface_->depth(face_of(point));
}

bool ContactTerm::acts(std::size_t tool, double time) const {
  return enabled_[tool] != 0 && tools_[tool].active(time);
}

void ContactTerm::search(const Tool& tool, ToolState& state, const geometry::Pose& pose) {
  const std::size_t n = positions_.size();
  std::vector<std::size_t> asked;
  std::vector<Vec3> points;
  std::vector<geometry::Projection> feet;
  for (std::size_t k = 0; k < n; ++k) {
    state.position[k] = pose.to_tool(positions_[k]);
    const double moved = (state.position[k] - state.queried_at[k]).norm();
    if (state.known_gap[k] > moved + opening_gap(state, k)) {
      state.foot[k].gap = std::numeric_limits<double>::infinity();
      continue;
    }
    asked.push_back(k);
    points.push_back(state.position[k]);
    feet.emplace_back();
    feet.back().patch = state.foot[k].patch;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, asked.size(), grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const std::size_t count = range.end() - range.begin();
                      tool.surface->project(std::span(points).subspan(range.begin(), count), reach_,
                                            std::span(feet).subspan(range.begin(), count));
                    });
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::size_t k = asked[i];
    state.foot[k] = feet[i];
    state.queried_at[k] = points[i];
    state.known_gap[k] = feet[i].found() ? feet[i].gap : 0.0;
  }
}

double ContactTerm::strength(const Friction& friction, std::size_t point) const {
  const std::optional<Strength> followed = friction.followed_strength();
  if (!followed)
    return 0.0;
  const std::size_t beneath = surface_->beneath(point);
  const double stress = *followed == Strength::yield ? bulk_->trial_strength(beneath)
                                                     : bulk_->trial_stress(beneath).stress;
  return stress / std::numbers::sqrt3;
}

int ContactTerm::evaluate(std::size_t t, const mechanics::Trial& trial, bool keep) {
  const Tool& tool = tools_[t];
  ToolState& state = states_[t];
  const Penalty penalty = this->penalty();
  if (state.turn.empty())
    state.turn = turns(t, trial);
  int changes = 0;
  for (std::size_t k = 0; k < state.trial.size(); ++k) {
    const Status before = state.trial[k].status;
    const geometry::Projection& foot = state.foot[k];
    const bool kept = keep && state.history[k].closed() && foot.found();
    const EvenFace* even = even_face(state, k);
    const bool opens = even != nullptr ? !(shared_pressure(*even, k).pressure > 0.0)
                                       : !(foot.gap <= opening_gap(state, k));
    if (opens && !kept) {
      state.trial[k] = Traction{};
    } else {
      const PointHistory& old = state.history[k];
      InterfaceInput in{state.position[k], foot};
      in.projection.gap += old.added();
      in.rounding = touching_gap(k);
      in.noise = noise_of_gap(positions_[k], state.position[k]);
      in.dt = trial.time - trial.time_old;
      if (!old.closed()) {
        if (!state.touching[k])
          state.touching[k] = touching_share(t, k, trial);
        in.touching = *state.touching[k];
      }
      in.softening = trial.softening.slip;
      in.kept = kept;
      in.multiplier = carried(state, k);
      in.strength = strength(tool.friction, k);
      in.friction_limited = state.friction_limited[k] != 0;
      in.turn = state.turn[idx(face_of(k))];
      if (even != nullptr)
        in.shared = shared_pressure(*even, k);
      state.trial[k] = traction(tool.friction, penalty, old, in, surface_->scheme());
    }
    if (state.trial[k].status != before) {
      ++changes;
      ++state.changes[k];
    }
  }
  return changes;
}

bool ContactTerm::many_parted(const ToolState& state) const {
  constexpr double many = 0.25; // of the points that touched; fewer, and the guess tells them apart
  int closed = 0;
  int parted = 0;
  for (std::size_t k = 0; k < state.history.size(); ++k)
    if (state.history[k].closed()) {
      ++closed;
      const EvenFace* even = even_face(state, k);
      const bool open = even != nullptr ? !(shared_pressure(*even, k).pressure > 0.0)
                                        : state.foot[k].gap > opening_gap(state, k);
      parted += open ? 1 : 0;
    }
  return parted > many * closed;
}

bool ContactTerm::pulls(const ToolState& state) {
  return std::any_of(state.trial.begin(), state.trial.end(),
                     [](const Traction& point) { return point.pressure < 0.0; });
}

void ContactTerm::sum(const ToolState& state, const geometry::Pose& pose) {
  for (std::size_t k = 0; k < state.trial.size(); ++k) {
    if (state.trial[k].status == Status::open)
      continue;
    touched_[k] = 1;
    traction_[k] += pose.rotation * state.trial[k].traction;
    const Mat3& D = state.trial[k].dtraction_dx;
    dtraction_[k] += pose.rotation * D * pose.rotation.transpose();
    symmetric_[k] +=
        pose.rotation * without_coupling(D, state.foot[k].normal) * pose.rotation.transpose();
  }
}

Outcome<mechanics::Assembled> ContactTerm::assemble(const mechanics::Trial& trial,
                                                    mechanics::System& system) {
  const double begun = seconds_now();
  const double searched = times_.search;
  softening_ = trial.softening.penetration;
  surface_->positions(trial.x, positions_);
  std::fill(traction_.begin(), traction_.end(), Vec3::Zero());
  std::fill(dtraction_.begin(), dtraction_.end(), Mat3::Zero());
  std::fill(symmetric_.begin(), symmetric_.end(), Mat3::Zero());
  std::fill(touched_.begin(), touched_.end(), char{0});
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    if (!acts(t, trial.time)) {
      std::fill(states_[t].trial.begin(), states_[t].trial.end(), Traction{});
      states_[t].corners.part();
      continue;
    }
    const geometry::Pose place = pose(t, trial.time, trial.x);
    states_[t].rotation = place.rotation;
    const double asked = seconds_now();
    search(tools_[t], states_[t], place);
    times_.search += seconds_now() - asked;
    press_even_faces(states_[t], false);
    const bool keep = trial.first_guess && many_parted(states_[t]);
    if (keep)
      press_even_faces(states_[t], true);
    system.contact_changes += evaluate(t, trial, keep);
    system.kept_contacts = system.kept_contacts || pulls(states_[t]);
    sum(states_[t], place);
    states_[t].stabilization.add(*surface_, *pattern_, trial.x, system);
    press_corners(t, place, trial, system);
  }
  scatter(trial.x, system);
  add_strength(trial, system);
  add_loads(trial, system);
  add_borders(trial, system);
  softening_ = 1.0;
  times_.elements += seconds_now() - begun - (times_.search - searched);
  return mechanics::Assembled{};
}

template <class Shape, class Square>
void ContactTerm::couple_points(const std::vector<FacePoint<Shape>>& places,
                                std::size_t first,
                                Square& tangent,
                                Square& near) const {
  constexpr int dim = Shape::dim + 1;
  using Block = Eigen::Matrix<double, dim, dim>;
  for (const ToolState& state : states_) {
    const EvenFace* even = even_face(state, first);
    const auto in_space = [&](const Vec3& v) -> Eigen::Matrix<double, dim, 1> {
      return (state.rotation * v).template head<dim>();
    };
    for (std::size_t i = 0; even != nullptr && i < places.size(); ++i)
      for (std::size_t j = 0; j < places.size(); ++j) {
        const double fall = places[i].measure * even->now.d_gap(static_cast<Eigen::Index>(i),
                                                                static_cast<Eigen::Index>(j));
        if (i == j || fall == 0.0 || state.trial[first + i].status == Status::open)
          continue;
        const Eigen::Matrix<double, dim, 1> n = in_space(state.foot[first + j].normal);
        const Block D = fall * in_space(state.trial[first + i].dtraction_dp) * n.transpose();
        const Block C = fall * in_space(state.foot[first + i].normal) * n.transpose();
        for (int a = 0; a < Shape::nodes; ++a)
          for (int b = 0; b < Shape::nodes; ++b) {
            const double N = places[i].N[idx(a)] * places[j].N[idx(b)];
            tangent.template block<dim, dim>(a * dim, b * dim) -= N * D;
            near.template block<dim, dim>(a * dim, b * dim) -= N * C;
          }
      }
  }
}

void ContactTerm::scatter(std::span<const double> x, mechanics::System& system) const {
  visit_contact_face(surface_->kind(), surface_->form(), [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    constexpr int size = Shape::nodes * dim;
    const mechanics::Scatter& faces = surface_->scatter();
    std::array<double, std::size_t{size}> local{};
    for (const Index f : faces.order()) {
      const std::size_t first = idx(f * Rule::points);
      if (std::none_of(touched_.begin() + f * Rule::points,
                       touched_.begin() + (f + 1) * Rule::points, [](char c) { return c != 0; }))
        continue;
      system.symmetric = false;
      mechanics::gather(x, faces.nodes(f), dim, local.data());
      Eigen::Matrix<double, size, 1> force = Eigen::Matrix<double, size, 1>::Zero();
      using Square = Eigen::Matrix<double, size, size, Eigen::RowMajor>;
      Square tangent = Square::Zero();
      Square near = Square::Zero(); // without what couples slip to pressure
      std::vector<FacePoint<Shape>> places;
      places.reserve(Rule::points);
      for (int i = 0; i < Rule::points; ++i)
        places.emplace_back(surface_->analysis(), local.data(), Rule::point(i), Rule::weight(i));
      for (int i = 0; i < Rule::points; ++i) {
        const std::size_t k = first + idx(i);
        if (touched_[k] == 0)
          continue;
        const FacePoint<Shape>& at = places[idx(i)];
        const Eigen::Matrix<double, dim, 1> T = traction_[k].template head<dim>();
        const Eigen::Matrix<double, dim, dim> D =
            at.measure * dtraction_[k].template topLeftCorner<dim, dim>();
        const Eigen::Matrix<double, dim, dim> C =
            at.measure * symmetric_[k].template topLeftCorner<dim, dim>();
        for (int a = 0; a < Shape::nodes; ++a) {
          const double Na = at.N[idx(a)];
          force.template segment<dim>(a * dim) -= Na * at.measure * T;
          for (int b = 0; b < Shape::nodes; ++b) {
            const Eigen::Matrix<double, dim, dim> growth =
                T * at.dmeasure[idx(b)].template head<dim>().transpose();
            tangent.template block<dim, dim>(a * dim, b * dim) -= Na * (at.N[idx(b)] * D + growth);
            near.template block<dim, dim>(a * dim, b * dim) -= Na * (at.N[idx(b)] * C + growth);
          }
        }
      }
      couple_points<Shape>(places, first, tangent, near);
      const Square unsymmetric = tangent - 0.5 * (near + near.transpose());
      faces.add(dim, f, force.data(), system.residual);
      faces.add(*pattern_, f, tangent.data(), system.tangent.values);
      faces.list(*pattern_, f, unsymmetric.data(), system.tangent.unsymmetric);
    }
  });
}

void ContactTerm::commit(const mechanics::Trial& trial) {
  surface_->areas(trial.x, areas_);
  area_ = 0.0;
  std::fill(loads_.begin(), loads_.end(), ToolLoad{});
  for (std::size_t k = 0; k < touched_.size(); ++k)
    if (touched_[k] != 0)
      area_ += areas_[k];
  work_.stored = 0.0;
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    commit_tool(t, trial);
    work_.stored += states_[t].stored;
    level_faces(t, pose(t, trial.time, trial.x), trial.x);
    choose_even_faces(t);
  }
  ++since_parting_;
  stiffening_old_ = stiffening_;
  stiffening_next_ = stiffening_;
  forget_predicted();
}

std::array<ContactTerm::WayOfTool, 2> ContactTerm::ways(std::size_t tool,
                                                        const mechanics::Trial& trial) const {
  const geometry::Motion& motion = tools_[tool].motion;
  const geometry::Driven before = driven(tool, trial.x_old), now = driven(tool, trial.x);
  const Vec3 from = motion.translation(trial.time_old, before);
  const Vec3 to = motion.translation(trial.time, now);
  const double angle = motion.angle(trial.time, now) - motion.angle(trial.time_old, before);
  const Vec3 axis = motion.axis_point() + motion.offset;
  const Vec3 turn = angle * motion.axis();
  return {WayOfTool{to - from, turn, axis + from}, WayOfTool{to - from, turn, axis + to}};
}

double ContactTerm::longest_way(const ToolState& state,
                                const geometry::Pose& pose,
                                const geometry::Pose& pose_old) const {
  double longest = 0.0;
  for (std::size_t k = 0; k < state.trial.size(); ++k) {
    const Vec3& before = state.history[k].position;
    if (state.trial[k].status != Status::open || state.history[k].closed())
      longest = std::max({longest, (pose.to_space(before) - pose_old.to_space(before)).norm(),
                          (positions_[k] - pose_old.to_space(before)).norm()});
  }
  for (const CornerContact::Corner& corner : state.corners.corners())
    if (corner.trial.foot)
      longest = std::max(
          {longest, corner.trial.traction.slip.norm(),
           (pose.to_space(corner.shape.centre) - pose_old.to_space(corner.shape.centre)).norm()});
  return longest;
}

std::array<ContactTerm::ForcesOfTool, 2>
ContactTerm::forces_of_tool(std::size_t t, const mechanics::Trial& trial) const {
  const ToolState& state = states_[t];
  const geometry::Pose pose = this->pose(t, trial.time, trial.x);
  const geometry::Pose pose_old = this->pose(t, trial.time_old, trial.x_old);
  const auto [way_old, way] = ways(t, trial);
  ForcesOfTool before, now;
  const auto add = [](ForcesOfTool& forces, const Vec3& force, const Vec3& way_of_point) {
    forces.sum += force.norm();
    forces.work += force.dot(way_of_point);
  };
  for (std::size_t k = 0; k < state.trial.size(); ++k) {
    if (state.history[k].closed())
      add(before, state.force[k], way_old.of(pose_old.to_space(state.history[k].position)));
    if (state.trial[k].status != Status::open)
      add(now, areas_[k] * (pose.rotation * state.trial[k].traction), way.of(positions_[k]));
  }
  for (const CornerContact::Corner& corner : state.corners.corners()) {
    add(before, corner.committed.force, way_old.of(corner.committed.place));
    add(now, corner.trial.force, way.of(corner.trial.place));
  }
  return {before, now};
}

void ContactTerm::commit_tool(std::size_t t, const mechanics::Trial& trial) {
  ToolState& state = states_[t];
  const Tool& tool = tools_[t];
  const geometry::Pose pose = this->pose(t, trial.time, trial.x);
  const geometry::Pose pose_old = this->pose(t, trial.time_old, trial.x_old);
  state.committed_rotation = pose.rotation;
  const Vec3 reference = pose.to_space(tool.reference);
  const bool meridian = surface_->analysis() == mechanics::Analysis::axisymmetric;
  const Penalty penalty = this->penalty();
  const bool touched = state.touches;
  state.stored = 0.0;
  state.touches = false;
  closed_[t].clear();
  const double gone = longest_way(state, pose, pose_old);
  const auto [way_old, way] = ways(t, trial);
  for (std::size_t k = 0; k < state.trial.size(); ++k) {
    const Traction& now = state.trial[k];
    PointHistory& history = state.history[k];
    const Vec3 position = pose.to_tool(positions_[k]);
    const Vec3 force = areas_[k] * (pose.rotation * now.traction);
    work_.external += 0.5 * (force.dot(way.of(positions_[k])) +
                             state.force[k].dot(way_old.of(pose_old.to_space(history.position))));
    work_.external -= 0.5 * state.retreat * areas_[k] * (history.pressure + now.pressure);
    state.force[k] = force;
    const double sliding = history.sliding + now.slip.norm();
    const ShearBalance shear = balance(penalty, history, now, sliding, surface_->depth(face_of(k)));
    work_.friction += shear.friction_work * areas_[k];
    work_.unseen += shear.unseen * areas_[k];
    // What opens, or comes to a tool that touches already, has rubbed on the way by the trapezoid
    // that the work of tools is taken by: one point's contact passes to another.
    Vec3 rubs = Vec3::Zero();
    if (history.closed() && now.status == Status::open) {
      rubs = history.shear;
      since_parting_ = -1;
    } else if (touched && !history.closed() && state.touching[k])
      rubs = (1.0 - *state.touching[k]) * now.shear;
    work_.friction += areas_[k] * std::max(0.0, -0.5 * rubs.dot(position - history.position));
    work_.enforcement += areas_[k] * enforcement_work(history, now, state.multiplier[k]);
    const bool even = even_face(state, k) != nullptr;
    const double relief = even ? this->relief(state, k) : faded(history.relief, gone);
    const PointHistory old =
        std::exchange(history, PointHistory{.position = position,
                                            .sliding = sliding,
                                            .offset = std::max(0.0, faded(history.offset, gone)),
                                            .level = history.level,
                                            .relief = relief});
    // Relief of even faces changes within the increment, the rest at its end.
    const double shift = old.faded + (even ? old.relief - relief : 0.0);
    work_.enforcement += areas_[k] * 0.5 * (old.pressure + now.pressure) *
                         pressed_shift(old, now, state.multiplier[k], shift);
    if (!even)
      history.faded += old.relief - relief;
    if (now.status == Status::open) {
      state.multiplier[k] = 0.0;
      continue;
    }
    history.multiplier = state.multiplier[k];
    history.offset = faded(old.offset, gone);
    history.faded += old.offset - history.offset; // closer to the tool: deeper by as much
    history.normal = state.foot[k].normal;
    history.shear = now.shear;
    history.pressure = now.pressure;
    history.limit = now.limit;
    history.slips = now.status == Status::slip;
    history.stiffness = shear.stiffness;
    state.touches = true;
    closed_[t].push_back({.point = k,
                          .from = old.position,
                          .to = position,
                          .foot = state.foot[k].foot,
                          .normal = history.normal,
                          .touching = old.closed() ? 1.0 : state.touching[k].value_or(0.0),
                          .pressure_old = old.pressure,
                          .pressure = now.pressure,
                          .slip = now.slip.norm(),
                          .sliding = sliding,
                          .area = areas_[k]});
    state.stored +=
        areas_[k] * (stored(now, history.multiplier) + shear_energy(now.shear, history.stiffness));
    // Around the full turn radial forces and all torques cancel.
    const Vec3 on_tool = meridian ? Vec3(0.0, -force[1], 0.0) : Vec3(-force);
    loads_[t].force += on_tool;
    if (!meridian)
      loads_[t].torque += (positions_[k] - reference).cross(on_tool);
  }
  if (!meridian)
    loads_[t].torque -= state.stabilization.moment(*surface_, trial.x);
  commit_corners(t, trial, gone);
  stabilize(t, pose, trial.x);
}

void ContactTerm::retreat(std::size_t tool, double distance, double all) {
  states_[tool].retreat = distance;
  states_[tool].drawn_back = all;
  std::fill(states_[tool].known_gap.begin(), states_[tool].known_gap.end(), 0.0);
}

bool ContactTerm::lies_on(std::size_t tool) const {
  const ToolState& state = states_[tool];
  const auto corners = state.corners.corners();
  return std::any_of(state.history.begin(), state.history.end(),
                     [](const PointHistory& history) { return history.closed(); }) ||
         std::any_of(corners.begin(), corners.end(),
                     [](const CornerContact::Corner& corner) { return corner.history.closed(); });
}

bool ContactTerm::bears_near(std::size_t tool, Index face) const {
  const ToolState& state = states_[tool];
  const auto own = surface_->scatter().nodes(face);
  const auto is_near = [&](Index other) {
    const auto nodes = surface_->scatter().nodes(other);
    return std::find_first_of(own.begin(), own.end(), nodes.begin(), nodes.end()) != own.end();
  };
  for (std::size_t k = 0; k < state.trial.size(); ++k)
    if (state.trial[k].pressure > 0.0 && is_near(face_of(k)))
      return true;
  const auto corners = state.corners.corners();
  return std::any_of(corners.begin(), corners.end(), [&](const CornerContact::Corner& corner) {
    return corner.trial.foot && corner.trial.area > 0.0 && is_near(corner.trial.foot->face);
  });
}

bool ContactTerm::leaves(std::size_t tool, double time) const {
  return states_[tool].touches && !acts(tool, time);
}

std::vector<double> ContactTerm::release(std::size_t tool) {
  ToolState& state = states_[tool];
  std::vector<double> forces(idx(pattern_->n_dofs()), 0.0);
  visit_contact_face(surface_->kind(), surface_->form(), [&](auto shape, auto rule) {
    using Shape = decltype(shape);
    using Rule = decltype(rule);
    constexpr int dim = Shape::dim + 1;
    for (std::size_t k = 0; k < state.force.size(); ++k) {
      const auto N = Shape::values(Rule::point(static_cast<int>(k) % Rule::points));
      for (std::size_t a = 0; a < N.size(); ++a)
        for (int d = 0; d < dim; ++d)
          forces[idx(surface_->scatter().nodes(face_of(k))[a] * dim + d)] +=
              N[a] * state.force[k][d];
    }
  });
  state.stabilization.add_forces(*surface_, forces);
  state.corners.release(*surface_, forces);
  state.stabilization.clear();
  state.even.clear();
  std::fill(state.even_at.begin(), state.even_at.end(), -1);
  for (PointHistory& history : state.history)
    history = PointHistory{.position = history.position, .sliding = history.sliding};
  std::fill(state.multiplier.begin(), state.multiplier.end(), 0.0);
  std::fill(state.trial.begin(), state.trial.end(), Traction{});
  std::fill(state.force.begin(), state.force.end(), Vec3::Zero());
  work_.stored -= state.stored;
  state.stored = 0.0;
  state.touches = false;
  loads_[tool] = ToolLoad{};
  closed_[tool].clear();
  return forces;
}

} // namespace billet::contact
