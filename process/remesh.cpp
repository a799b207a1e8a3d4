// The part meshed anew in the midst of a run: when, and what is carried over. (P.14)-(P.17)

#include "geometry/base/error.h"
#include "geometry/base/stopwatch.h"
#include "mechanics/materials/j2_hencky.h"
#include "mechanics/mesh_check.h"
#include "mechanics/mesh_edges.h"
#include "mechanics/mesh_locator.h"
#include "mechanics/state_transfer.h"
#include "process/part_boundary.h"
#include "process/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace billet::process {

namespace {

std::size_t idx(Index i) { return static_cast<std::size_t>(i); }

/// What a remeshing may change (RM-01): of the volume, of a tool's force, of the plastic work.
constexpr double volume_budget = 1e-4;
constexpr double force_budget = 1e-2;
constexpr double work_budget = 5e-3;

/// Without a limit of the case: a face that lies deeper in a tool, relative to the element beneath,
/// and twice as deep as when the mesh was new, is too coarse for it.
constexpr double deep = 0.1;

/// A mesh has to have lost this share of its first quality before it is replaced.
constexpr double worn_share = 0.7;

std::vector<Vec3> points_in_plane(std::span<const double> x) {
  std::vector<Vec3> points;
  points.reserve(x.size() / 2);
  for (std::size_t i = 0; i + 1 < x.size(); i += 2)
    points.emplace_back(x[i], x[i + 1], 0.0);
  return points;
}

double worst_quality(const mechanics::Mesh& mesh, std::span<const double> x) {
  const std::vector<double> all = mechanics::element_qualities(mesh, points_in_plane(x));
  return *std::min_element(all.begin(), all.end());
}

/// Side of an equilateral triangle, or of a square, of the mean size.
double mean_side(const mechanics::Mesh& mesh) {
  double area = 0.0;
  for (Index e = 0; e < mesh.n_elements(); ++e) {
    std::vector<Vec3> points;
    for (const Index node : mesh.cell(e))
      points.push_back(mesh.points[idx(node)]);
    area += mechanics::element_measure(mesh.kind, points);
  }
  const double share = mechanics::is_simplex(mesh.kind) ? std::numbers::sqrt3 / 4.0 : 1.0;
  return std::sqrt(area / (share * mesh.n_elements()));
}

/// Sums over the fields of a bulk.
struct Stock {
  double plastic_work = 0.0;
  double mean_strain = 0.0;
  double largest_strain = 0.0;
};

/// @param rate  plastic strain rates of the points [1/s]
Stock stock_of(const mechanics::Bulk& bulk, std::span<const double> rate) {
  Stock stock;
  double volume = 0.0;
  for (std::size_t k = 0; k < bulk.states().size(); ++k) {
    const double strain = bulk.states()[k].plastic_strain;
    const double v = bulk.volumes()[k];
    if (strain > 0.0)
      stock.plastic_work += v * mechanics::plastic_work(bulk.material().flow, 0.0,
                                                        {strain, rate[k], bulk.temperature(k)});
    stock.mean_strain += v * strain;
    stock.largest_strain = std::max(stock.largest_strain, strain);
    volume += v;
  }
  stock.mean_strain /= volume;
  return stock;
}

/// Values of nodal fields of an old mesh at the nodes of a new one.
std::vector<double> at_new_nodes(const mechanics::Mesh& old,
                                 std::span<const mechanics::MeshLocation> places,
                                 std::span<const double> nodal) {
  std::vector<double> result(2 * places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    mechanics::interpolate(old, places[i], nodal, std::span(result).subspan(2 * i, 2));
  return result;
}

/// Faces that touch a tool are off it by up to this share of their length.
constexpr double off = 0.05;

/// Length of the old side that holds a place [mm].
double chord_at(const PartBoundary& boundary, const geometry::BoundaryPlace& place) {
  const std::vector<Vec2>& corners = boundary.loops[idx(place.loop)].corners;
  return (corners[(idx(place.side) + 1) % corners.size()] - corners[idx(place.side)]).norm();
}

std::vector<double> forces_on_tools(const contact::ContactTerm* contact) {
  std::vector<double> forces;
  if (contact != nullptr)
    for (const contact::ToolLoad& load : contact->loads())
      forces.push_back(load.force.norm());
  return forces;
}

} // namespace

double RemeshReport::Pair::change() const {
  return before != 0.0 ? std::abs(after - before) / std::abs(before) : std::abs(after);
}

double RemeshReport::force_jump() const {
  double largest = 0.0;
  double jump = 0.0;
  for (const Pair& force : forces) {
    largest = std::max(largest, force.before);
    jump = std::max(jump, std::abs(force.after - force.before));
  }
  return largest > 0.0 ? jump / largest : 0.0;
}

std::vector<std::string> RemeshReport::complaints() const {
  std::vector<std::string> lines;
  const auto check = [&](const char* what, double change, double budget) {
    if (change > budget)
      lines.push_back(fmt::format("warning: remeshing {} changed the {} by {:.2g} %, more than "
                                  "{:.2g} %",
                                  number, what, 100.0 * change, 100.0 * budget));
  };
  check("volume", volume.change(), volume_budget);
  check("plastic work", plastic_work.change(), work_budget);
  if (balanced)
    check("force on a tool", force_jump(), force_budget);
  else
    lines.push_back(fmt::format(
        "warning: remeshing {} was not followed by equilibrium before time went on", number));
  return lines;
}

void Process::start_remeshing() {
  side_ = mean_side(scene_.mesh);
  mesh_quality_ = worst_quality(scene_.mesh, positions());
  mesh_strain_.assign(bulk_->states().size(), 0.0);
}

bool Process::may_remesh() const {
  return scene_.remesh && fading_until_ <= time_ && increment_ > mesh_increment_;
}

std::string Process::remeshing_due() const {
  if (!may_remesh())
    return {};
  const RemeshSettings& settings = *scene_.remesh;
  const double quality = worst_quality(scene_.mesh, positions());
  const double limit = std::min({settings.quality, worn_share * mesh_quality_, refused_quality_});
  if (quality < limit)
    return fmt::format("element quality {:.2g} < {:.2g}", quality, limit);
  constexpr double rounding = 1e-9;
  if (settings.interval && time_ - mesh_time_ >= *settings.interval * (1.0 - rounding))
    return "interval";
  if (settings.penetration ? penetration_.bound > *settings.penetration
                           : penetration_.share > std::max(deep, 2.0 * mesh_share_))
    return fmt::format("penetration {:.3g}", penetration_.bound);
  if (settings.strain) {
    double grown = 0.0;
    for (std::size_t k = 0; k < mesh_strain_.size(); ++k)
      grown = std::max(grown, bulk_->states()[k].plastic_strain - mesh_strain_[k]);
    if (grown > *settings.strain)
      return fmt::format("plastic strain {:.2g} since the last mesh", grown);
  }
  return {};
}

std::vector<int> Process::touching_tools() const {
  std::vector<int> touching(scene_.contact_faces.size(), -1);
  if (contact_)
    for (std::size_t t = 0; t < scene_.tools.size(); ++t)
      for (const contact::ClosedPoint& at : contact_->closed()[t])
        touching[at.point / idx(surface_->points())] = static_cast<int>(t);
  return touching;
}

geometry::RemeshSizes Process::remesh_sizes() const {
  const RemeshSettings& settings = *scene_.remesh;
  const double usual = settings.size.value_or(side_);
  geometry::RemeshSizes sizes;
  sizes.min =
      settings.size_min.value_or(0.25 * std::min(usual, settings.size_contact.value_or(usual)));
  sizes.max = settings.size_max.value_or(usual);
  std::vector<std::size_t> acting;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t)
    if (contact_ && contact_->acts(t, time_))
      acting.push_back(t);
  const double at_contact = settings.size_contact.value_or(usual);
  sizes.wanted = [this, acting, usual, at_contact, turn = sizes.turn, growth = sizes.growth,
                  least = sizes.min](const Vec2& x) {
    double size = usual;
    for (const std::size_t t : acting) {
      const Vec3 at = contact_->pose(t, time_, x_).to_tool(Vec3(x.x(), x.y(), 0.0));
      geometry::Projection foot;
      constexpr double reach = 4.0; // sizes
      scene_.tools[t].surface->project(std::span(&at, 1), reach * usual, std::span(&foot, 1));
      if (!foot.found())
        continue;
      // Sides turn with the tool's surface, as far as it is near.
      const double curvature = foot.dnormal_dx.norm();
      const double here = std::min(at_contact, curvature > 0.0 ? turn / curvature : at_contact);
      size = std::min(size, std::max(here, least) + growth * std::abs(foot.gap));
    }
    return size;
  };
  return sizes;
}

std::string Process::remesh(const std::string& cause, const std::vector<Observer*>& observers) {
  const double begun = seconds_now();
  RemeshReport report;
  report.number = static_cast<int>(remeshings_.size()) + 1;
  report.time = time_;
  report.increment = increment_;
  report.cause = cause;
  const PartBoundary boundary =
      part_boundary(scene_, positions(), touching_tools(), scene_.remesh->keep);
  geometry::RemeshSizes sizes = remesh_sizes();
  sizes.at = contact_sizes(boundary);
  RemeshedPart part;
  try {
    part = remesh_part(scene_, boundary, sizes, onto_tools(boundary));
  } catch (const Error& error) {
    refused_quality_ = 0.5 * worst_quality(scene_.mesh, positions());
    refusals_.push_back({time_, error.complaints().front().message});
    return refusals_.back().why;
  }
  const double written = seconds_now();
  for (Observer* observer : observers)
    observer->remeshing(*this);
  const double output = seconds_now() - written;
  const double missing = energy_.missing();
  exchange_mesh(boundary, std::move(part), report);
  const double exchanged = seconds_now();
  restore_balance(report);
  update_energy();
  report.energy = energy_.missing() - missing;
  energy_.remeshing += report.energy;
  report.seconds = seconds_now() - begun - output;
  times_.output += output;
  times_.remeshing += exchanged - begun - output; // the balance counts with the other solutions
  remeshings_.push_back(report);
  for (Observer* observer : observers)
    observer->remeshed(*this, report);
  return {};
}

void Process::exchange_mesh(const PartBoundary& boundary, RemeshedPart part, RemeshReport& report) {
  const Stock before = stock_of(*bulk_, plastic_rate_);
  const std::vector<double> forces = forces_on_tools(contact_.get());
  report.elements[0] = scene_.mesh.n_elements();
  report.nodes[0] = scene_.mesh.n_points();
  report.quality.before = worst_quality(scene_.mesh, positions());
  report.volume.before = bulk_->volume(x_);

  const mechanics::StateField field{&scene_.mesh, positions(), bulk_->states(),
                                    bulk_->temperatures(), plastic_rate_};
  mechanics::TransferredState state =
      mechanics::transfer_state(field, part.mesh, scene_.analysis, scene_.material);
  const mechanics::MeshLocator locator(scene_.mesh, positions());
  const std::vector<mechanics::MeshLocation> places = locator.locate(part.mesh.points);
  std::vector<double> origins = at_new_nodes(scene_.mesh, places, x0_);
  velocity_ = at_new_nodes(scene_.mesh, places, velocity_);
  if (!last_step_.empty()) {
    std::vector<double> step = at_new_nodes(scene_.mesh, places, last_step_);
    step.insert(step.end(), last_step_.begin() + static_cast<std::ptrdiff_t>(x0_.size()),
                last_step_.end());
    last_step_ = std::move(step);
  }
  std::vector<double> x = mechanics::node_positions(part.mesh);
  x.insert(x.end(), x_.begin() + static_cast<std::ptrdiff_t>(x0_.size()), x_.end());

  // Sums of what goes with the old mesh.
  for (const auto& load : loads_)
    load_work_ += load->work();
  for (const auto& load : fading_)
    load_work_ += load->work();
  take_times();
  earlier_times_ = times_;
  earlier_work_ = solver_work();
  const double plastic_work = bulk_->plastic_work();
  const ContactStops stops(boundary, scene_.contact_faces,
                           surface_ ? surface_->line_coordinates() : std::vector<double>());
  const std::unique_ptr<contact::ContactSurface> old_surface = std::move(surface_);
  const std::unique_ptr<contact::ContactTerm> old_contact = std::move(contact_);
  terms_.clear();
  loads_.clear();
  fading_.clear();
  grounding_.reset();
  newton_.reset();
  bulk_.reset();

  scene_.mesh = std::move(part.mesh);
  scene_.supports = std::move(part.supports);
  scene_.loads = std::move(part.loads);
  scene_.contact_faces = part.contact_faces;
  pattern_ = mechanics::block_pattern(scene_.mesh);
  x0_ = std::move(origins);
  x_ = std::move(x);
  for (const Support& support : scene_.supports)
    for (const Index node : support.nodes) {
      const std::size_t i = idx(2 * node + support.component);
      x0_[i] = x_[i] - support.displacement(time_);
    }
  trial_x_ = x_;
  reactions_.assign(x0_.size(), 0.0);
  make_terms();
  analysis_before_run_ = newton_->solver_work().analysis;
  bulk_->adopt(std::move(state.states), std::move(state.temperatures), plastic_work);
  plastic_rate_ = std::move(state.plastic_rate);
  if (contact_) {
    contact_->start(x_, time_);
    const std::vector<contact::PointSource> sources =
        point_sources(stops, part.places, surface_->line_coordinates());
    contact_->go_on_from(*old_contact, sources);
    if (wear_)
      wear_->change_surface(*surface_, sources);
  }
  mesh_increment_ = increment_;
  mesh_time_ = time_;
  mesh_quality_ = worst_quality(scene_.mesh, positions());
  refused_quality_ = 1.0;
  mesh_strain_.clear();
  for (const mechanics::PointState& point : bulk_->states())
    mesh_strain_.push_back(point.plastic_strain);

  const Stock after = stock_of(*bulk_, plastic_rate_);
  report.elements[1] = scene_.mesh.n_elements();
  report.nodes[1] = scene_.mesh.n_points();
  report.quality.after = mesh_quality_;
  report.volume.after = bulk_->volume(x_);
  report.plastic_work = {before.plastic_work, after.plastic_work};
  report.mean_strain = {before.mean_strain, after.mean_strain};
  report.largest_strain = {before.largest_strain, after.largest_strain};
  report.returned = state.returned;
  for (const double force : forces)
    report.forces.push_back({force, force});
}

std::optional<Vec2>
Process::onto_tool(std::size_t tool, const Vec2& x, double most_gap, unsigned fixed) const {
  constexpr unsigned both = 3;
  if (fixed == both)
    return std::nullopt;
  const geometry::Pose pose = contact_->pose(tool, time_, x_);
  const Vec2 way = fixed == 1 ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0);
  Vec2 there = x;
  constexpr int most_steps = 20;
  constexpr double near = 1e-10, flat = 0.2;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 at = pose.to_tool(Vec3(there.x(), there.y(), 0.0));
    geometry::Projection foot;
    scene_.tools[tool].surface->project(std::span(&at, 1), side_, std::span(&foot, 1));
    if (!foot.found() || (step == 0 && foot.gap > most_gap))
      return std::nullopt;
    const Vec2 move = pose.to_space(foot.foot).head<2>() - there;
    if (fixed == 0)
      return Vec2(there + move);
    const double along = move.dot(way);
    if (std::abs(foot.gap) <= near * side_)
      return there;
    if (std::abs(along) < flat * std::abs(foot.gap))
      return std::nullopt;
    there += foot.gap * foot.gap / along * way; // to where the tangent plane of the foot is met
  }
  return std::nullopt;
}

geometry::Settle Process::onto_tools(const PartBoundary& boundary) const {
  if (!contact_)
    return {};
  auto stops = std::make_shared<const ContactStops>(boundary, scene_.contact_faces,
                                                    surface_->line_coordinates());
  return [this, &boundary, stops](std::int32_t part, const geometry::BoundaryPlace& place,
                                  const Vec2& x) -> Vec2 {
    const Attachment& attached = boundary.attachments[idx(part)];
    if (!attached.contact)
      return x;
    unsigned fixed = fixed_components(scene_, boundary, part, place);
    if (scene_.analysis == mechanics::Analysis::axisymmetric && x.x() == 0.0)
      fixed |= 1U;
    const double chord = chord_at(boundary, place);
    Vec2 result = x;
    for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
      if (!contact_->acts(t, time_))
        continue;
      // What lies off the tool stays there, but for what faces that touch it are off between
      // their points.
      const contact::PointSource source = stops->around(place);
      const bool closed = attached.tool == static_cast<int>(t) &&
                          contact_->closed_on(t, source.points[source.share < 0.5 ? 0 : 1]);
      if (const std::optional<Vec2> there = onto_tool(t, result, closed ? off * chord : 0.0, fixed))
        result = *there;
    }
    return result;
  };
}

void Process::restore_balance(RemeshReport& report) {
  // In next to no time rate laws neither flow nor relax.
  constexpr double share_of_increment = 1e-6;
  const double dt = share_of_increment * last_dt_;
  trial_x_ = x_;
  if (contact_)
    contact_->restart();
  const auto outcome = newton_->solve(terms_, prescribed(time_), time_ - dt, time_, x_, trial_x_);
  if (!newton_->records().empty())
    report.residual = newton_->records().front().residual;
  if (!outcome)
    return;
  const mechanics::Trial trial{time_ - dt, time_, x_, trial_x_};
  for (mechanics::ForceTerm* term : terms_)
    term->commit(trial);
  for (const Index i : prescribed(time_).unknowns)
    reactions_[idx(i)] = newton_->residual()[idx(i)];
  x_ = trial_x_;
  report.balanced = true;
  const std::vector<double> forces = forces_on_tools(contact_.get());
  for (std::size_t t = 0; t < forces.size(); ++t)
    report.forces[t].after = forces[t];
}

} // namespace billet::process
