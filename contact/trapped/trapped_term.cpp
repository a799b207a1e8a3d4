#include "contact/trapped/trapped_term.h"

#include "contact/term/contact_report.h"
#include "contact/term/couplings.h"
#include "contact/trapped/pocket_search.h"
#include "mechanics/equilibrium/face_area.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace billet::contact {

namespace {

using mechanics::Coupling;

constexpr int dim = 2;

std::size_t unknown(Index node, int component) { return idx(node * dim + component); }

Vec3 position_of(std::span<const double> x, Index node) {
  return {x[unknown(node, 0)], x[unknown(node, 1)], 0.0};
}

/// How the force of a pressure of 1 on a chain of faces changes as these turn and grow, times that
/// pressure. (M.15)
void add_turning(const ContactSurface& surface,
                 std::span<const Index> faces,
                 double pressure,
                 std::span<const double> x,
                 std::vector<Coupling>& couplings) {
  mechanics::visit_face(surface.kind(), [&](auto shape) {
    using Shape = decltype(shape);
    using Rule = typename mechanics::FaceRules<Shape>::Full;
    if constexpr (Shape::dim == 1)
      for (const Index face : faces) {
        const std::span<const Index> nodes = surface.scatter().nodes(face);
        std::array<double, std::size_t{Shape::nodes} * dim> local{};
        mechanics::gather(x, nodes, dim, local.data());
        for (int i = 0; i < Rule::points; ++i) {
          const mechanics::FacePoint<Shape> at(surface.analysis(), local.data(), Rule::point(i),
                                               Rule::weight(i));
          for (std::size_t b = 0; b < Shape::nodes; ++b) {
            const Mat3 D =
                pressure * mechanics::area_derivative(at, b, surface.analysis(), Rule::weight(i));
            for (std::size_t a = 0; a < Shape::nodes; ++a)
              for (int d = 0; d < dim; ++d)
                for (int e = 0; e < dim; ++e)
                  couplings.push_back({static_cast<Index>(unknown(nodes[a], d)),
                                       static_cast<Index>(unknown(nodes[b], e)),
                                       at.N[a] * D(d, e)});
          }
        }
      }
  });
}

/// Pocket found now of each face; -1: none.
std::vector<std::int32_t> owners(const std::vector<PocketPlace>& found, std::size_t n_faces) {
  std::vector<std::int32_t> owner(n_faces, -1);
  for (std::size_t j = 0; j < found.size(); ++j)
    for (const Index face : found[j].faces)
      owner[idx(face)] = static_cast<std::int32_t>(j);
  return owner;
}

/// Which of those found now an old one has become, by common faces and tool; of these, such as it
/// has not filled.
std::vector<std::size_t> heirs_of(const Pocket& pocket,
                                  const std::vector<PocketPlace>& found,
                                  const std::vector<std::int32_t>& owner) {
  std::vector<std::size_t> heirs;
  for (const Index face : pocket.place.faces)
    if (const std::int32_t j = owner[idx(face)];
        j >= 0 && found[static_cast<std::size_t>(j)].tool == pocket.place.tool &&
        found[static_cast<std::size_t>(j)].left())
      heirs.push_back(static_cast<std::size_t>(j));
  std::sort(heirs.begin(), heirs.end());
  heirs.erase(std::unique(heirs.begin(), heirs.end()), heirs.end());
  return heirs;
}

/// Gives what is in a pocket to those that it has become, by their volumes.
void hand_down(const Pocket& pocket,
               const std::vector<std::size_t>& heirs,
               std::vector<Pocket>& now) {
  double sum = 0.0;
  for (const std::size_t j : heirs)
    sum += now[j].place.volume;
  for (const std::size_t j : heirs) {
    const double share = now[j].place.volume / sum;
    now[j].rest_volume += share * pocket.rest_volume;
    now[j].volume += share * pocket.volume;
    now[j].dead_volume += share * pocket.dead_volume;
    now[j].since = std::min(now[j].since, pocket.since);
  }
}

MediumPressure medium_in(const Pocket& pocket, const TrappedMedium& medium, double volume) {
  return pressure_of(medium, pocket.rest_volume + pocket.dead_volume, volume + pocket.dead_volume);
}

/// Takes the volumes of a pocket's present place in the place of those of before; the pressure goes
/// on. What was in the difference stays behind, in contact that has closed.
void leave_behind(Pocket& pocket) {
  const double compression =
      (pocket.rest_volume + pocket.dead_volume) / (pocket.volume + pocket.dead_volume);
  pocket.volume = pocket.place.volume;
  pocket.dead_volume = pocket.place.dead_volume;
  pocket.rest_volume = compression * (pocket.volume + pocket.dead_volume) - pocket.dead_volume;
}

Pocket empty_at(const PocketPlace& place, double time) { return {.place = place, .since = time}; }

} // namespace

TrappedTerm::TrappedTerm(ContactTerm& contact,
                         const TrappedMedium& medium,
                         std::vector<SymmetryLine> lines)
    : contact_(&contact), medium_(medium), lines_(std::move(lines)) {}

TrappedTerm::Tried TrappedTerm::tried(const Pocket& pocket, const mechanics::Trial& trial) const {
  const ContactModel& model = contact_->model();
  const std::size_t tool = pocket.place.tool;
  Tried tried;
  tried.old = chain_of(*model.surface, pocket.place.faces, trial.x_old,
                       model.pose(tool, trial.time_old, trial.x_old));
  tried.now =
      chain_of(*model.surface, pocket.place.faces, trial.x, model.pose(tool, trial.time, trial.x));
  tried.volume = pocket.volume + volume_change(model.surface->analysis(), tried.old, tried.now);
  if (tried.volume + pocket.dead_volume > 0.0)
    tried.medium = medium_in(pocket, medium_, tried.volume);
  return tried;
}

Outcome<mechanics::Assembled> TrappedTerm::assemble(const mechanics::Trial& trial,
                                                    mechanics::System& system) {
  for (const Pocket& pocket : state_.pockets) {
    const Tried now = tried(pocket, trial);
    if (!(now.volume + pocket.dead_volume > 0.0))
      return Failure{"metal has gone through what is trapped in a pocket"};
    for (std::size_t a = 0; a < now.now.nodes.size(); ++a)
      for (int d = 0; d < dim; ++d)
        system.residual[unknown(now.now.nodes[a], d)] += now.medium.pressure * now.now.areas[a][d];
    add_drives(pocket, now, trial, system);
    if (!system.forces_only)
      add_tangent(pocket, now, trial, system);
    system.symmetric = false;
  }
  return mechanics::Assembled{};
}

void TrappedTerm::add_tangent(const Pocket& pocket,
                              const Tried& now,
                              const mechanics::Trial& trial,
                              mechanics::System& system) const {
  const ContactModel& model = contact_->model();
  add_turning(*model.surface, pocket.place.faces, now.medium.pressure, trial.x, system.couplings);
  const std::vector<Vec3> gradient =
      volume_gradient(model.surface->analysis(), now.old, now.now,
                      model.pose(pocket.place.tool, trial.time, trial.x));
  const std::vector<Index>& nodes = now.now.nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; b < nodes.size(); ++b)
      for (int d = 0; d < dim; ++d)
        for (int e = 0; e < dim; ++e)
          system.couplings.push_back({static_cast<Index>(unknown(nodes[a], d)),
                                      static_cast<Index>(unknown(nodes[b], e)),
                                      now.now.areas[a][d] * now.medium.by_volume * gradient[b][e]});
  merge(system.couplings);
}

// With the velocity v of the tool's material at the nodes for dq = 1: dV/dq = -sum dV/dx . v, and
// the force of the medium on the tool is the opposite of that on the metal. (C.61)
void TrappedTerm::add_drives(const Pocket& pocket,
                             const Tried& now,
                             const mechanics::Trial& trial,
                             mechanics::System& system) const {
  const ContactModel& model = contact_->model();
  const std::vector<Index>& nodes = now.now.nodes;
  const std::vector<Vec3> gradient =
      volume_gradient(model.surface->analysis(), now.old, now.now,
                      model.pose(pocket.place.tool, trial.time, trial.x));
  struct Driven {
    std::size_t drive;
    double on_tool = 0.0;   ///< of the area vectors [mm^2]
    double by_drive = 0.0;  ///< d volume / d q [mm^2]
    std::vector<Vec3> rate; ///< of the tool at the nodes
    Vec3 spin = Vec3::Zero();
  };
  std::vector<Driven> all;
  for (std::size_t j = 0; j < model.drives.size(); ++j) {
    if (model.drives[j].tool != pocket.place.tool ||
        !contact_->view().follows(model.drives[j], trial.time))
      continue;
    Driven& driven = all.emplace_back(Driven{.drive = j, .rate = {}});
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const DriveRate rate =
          model.drive_rate(model.drives[j], trial.time, trial.x, position_of(trial.x, nodes[a]));
      driven.rate.push_back(rate.velocity);
      driven.spin = rate.spin;
      driven.on_tool += now.now.areas[a].dot(rate.velocity);
      driven.by_drive -= gradient[a].dot(rate.velocity);
    }
  }
  const double p = now.medium.pressure, dp = now.medium.by_volume;
  for (const Driven& driven : all) {
    mechanics::Border& border = system.borders[driven.drive];
    system.residual[idx(model.pattern->n_dofs()) + driven.drive] -= p * driven.on_tool;
    std::vector<Coupling> turning;
    add_turning(*model.surface, pocket.place.faces, p, trial.x, turning);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int d = 0; d < dim; ++d) {
        border.column[unknown(nodes[a], d)] += now.now.areas[a][d] * dp * driven.by_drive;
        border.row[unknown(nodes[a], d)] -=
            dp * driven.on_tool * gradient[a][d] + p * now.now.areas[a].cross(driven.spin)[d];
      }
    const auto rate_at = [&](Index row) {
      const auto node = std::find(nodes.begin(), nodes.end(), row / dim) - nodes.begin();
      return driven.rate[static_cast<std::size_t>(node)][row % dim];
    };
    for (const Coupling& entry : turning)
      border.row[idx(entry.column)] -= rate_at(entry.row) * entry.value;
    for (const Driven& other : all)
      border.corner[other.drive] -= dp * driven.on_tool * other.by_drive;
  }
}

double TrappedTerm::work_in(const mechanics::Trial& trial) const {
  double work = 0.0;
  for (const Pocket& pocket : state_.pockets) {
    const Tried now = tried(pocket, trial);
    for (std::size_t a = 0; a < now.now.nodes.size(); ++a) {
      const Index node = now.now.nodes[a];
      const Vec3 mean =
          0.5 * (pocket.pressure * now.old.areas[a] + now.medium.pressure * now.now.areas[a]);
      work -= mean.dot(position_of(trial.x, node) - position_of(trial.x_old, node));
    }
  }
  return work;
}

void TrappedTerm::commit(const mechanics::Trial& trial) {
  state_.work += work_in(trial);
  for (Pocket& pocket : state_.pockets) {
    const Tried now = tried(pocket, trial);
    pocket.volume = now.volume;
    pocket.pressure = now.medium.pressure;
    state_.highest = std::max(state_.highest, pocket.pressure);
    for (std::size_t a = 0; a < now.now.nodes.size(); ++a)
      contact_->bear(pocket.place.tool, pocket.pressure * now.now.areas[a],
                     position_of(trial.x, now.now.nodes[a]), trial);
  }
  look(trial.x, trial.time);
}

void TrappedTerm::look(std::span<const double> x, double time) {
  const std::vector<PocketPlace> found = find_pockets(*contact_, lines_, x, time);
  const std::vector<std::int32_t> owner = owners(found, idx(contact_->model().surface->n_faces()));
  std::vector<Pocket> now;
  for (const PocketPlace& place : found)
    now.push_back(empty_at(place, time));
  std::vector<char> touched(owner.size(), 0);
  for (const auto& closed : contact_->closed())
    for (const ClosedPoint& point : closed)
      touched[idx(contact_->model().face_of(point.point))] = 1;
  for (const Pocket& pocket : state_.pockets) {
    const std::vector<std::size_t> heirs = heirs_of(pocket, found, owner);
    hand_down(pocket, heirs, now);
    if (!heirs.empty())
      continue;
    // Where faces touch, or next to nothing is left between them and the tool.
    const bool filled =
        std::all_of(pocket.place.faces.begin(), pocket.place.faces.end(),
                    [&](Index face) { return touched[idx(face)] != 0 || owner[idx(face)] >= 0; });
    ++(filled ? state_.n_filled : state_.n_vented);
  }
  state_.pockets.clear();
  for (Pocket& pocket : now) {
    if (pocket.dead_volume > 0.0) {
      leave_behind(pocket);
    } else if (pocket.place.resolved()) { // it has closed in this increment
      pocket.rest_volume = pocket.volume = pocket.place.volume;
      pocket.dead_volume = pocket.place.dead_volume;
      ++state_.n_closed;
    } else {
      continue;
    }
    pocket.pressure = medium_in(pocket, medium_, pocket.volume).pressure;
    state_.pockets.push_back(std::move(pocket));
  }
}

void TrappedTerm::go_on_from(const TrappedSnapshot& before,
                             std::span<const double> x,
                             double time) {
  state_ = before.state;
  state_.pockets.clear();
  std::vector<Pocket> now;
  for (const PocketPlace& place : find_pockets(*contact_, lines_, x, time))
    now.push_back(empty_at(place, time));
  for (const Pocket& old : before.state.pockets) {
    std::optional<std::size_t> nearest;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < now.size(); ++j)
      if (const double apart = (now[j].place.centre - old.place.centre).norm();
          now[j].place.tool == old.place.tool && apart < distance) {
        nearest = j;
        distance = apart;
      }
    // Farther off than pockets are long it is another one.
    if (nearest && distance < old.place.length)
      hand_down(old, {*nearest}, now);
    else
      ++state_.n_vented;
  }
  for (Pocket& pocket : now)
    if (pocket.dead_volume > 0.0) {
      leave_behind(pocket);
      pocket.pressure = medium_in(pocket, medium_, pocket.volume).pressure;
      state_.pockets.push_back(std::move(pocket));
    }
}

} // namespace billet::contact
