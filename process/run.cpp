#include "process/run.h"

#include "geometry/base/error.h"
#include "mechanics/mesh_check.h"
#include "process/passage_guard.h"
#include "process/touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace billet::process {

namespace {

std::size_t idx(Index i) { return static_cast<std::size_t>(i); }

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<Vec3> as_points(std::span<const double> x, int dim, std::size_t n_points) {
  std::vector<Vec3> points(n_points, Vec3::Zero());
  for (std::size_t i = 0; i < n_points * idx(dim); ++i)
    points[i / idx(dim)][static_cast<Index>(i % idx(dim))] = x[i];
  return points;
}

/// Size of a mesh: the diagonal of its box.
double size_of(const mechanics::Mesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.points)
    box.add(p);
  return box.size();
}

/// Steps as shares of a stage, when the case does not say.
constexpr double first_share = 1.0 / 100.0;
constexpr double largest_share = 1.0 / 50.0;
constexpr double smallest_share = 1e-7;

/// An increment with more plastic strain than this at a point is cut: the return map stays exact,
/// but the path of strain is lost.
constexpr double most_plastic_increment = 0.5;

/// Why an increment is too long for the tools; empty: it is not. A tool that moves farther than
/// this in one increment could pass the workpiece unseen.
std::string leap(const Scene& scene, const Stage& stage, double from, double to) {
  const double farthest = 0.5 * size_of(scene.mesh);
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const contact::Tool& tool = scene.tools[t];
    const double way = (tool.motion.translation(to) - tool.motion.translation(from)).norm();
    if (!stage.unload && stage.tools[t] != 0 && tool.active(to) && way > farthest)
      return fmt::format("tool '{}' moves by {:.3g}, more than half the size of the workpiece",
                         tool.name, way);
  }
  return "";
}

} // namespace

double EnergyBalance::error() const {
  const double inside = elastic + plastic + friction + contact + grounding;
  const double largest = std::max({std::abs(external), elastic, plastic, friction, contact});
  return largest > 0.0 ? std::abs(external - inside) / largest : 0.0;
}

Process::Process(Scene scene)
    : scene_(std::move(scene)), pattern_(mechanics::block_pattern(scene_.mesh)) {
  started_ = now();
  for (const Vec3& p : scene_.mesh.points)
    x0_.insert(x0_.end(), p.data(), p.data() + scene_.mesh.dimension());
  x_ = x0_;
  x_.resize(x0_.size() + contact::drive_unknowns(scene_.tools).size(), 0.0);
  trial_x_ = x_;
  velocity_.assign(x0_.size(), 0.0);
  reactions_.assign(x0_.size(), 0.0);
  make_terms();
  if (surface_)
    bring_to_touch(scene_, *surface_, x_);
  check_overlap();
  if (contact_) {
    contact_->start(x_, 0.0);
    check_drives();
  }
}

Process::~Process() = default;

void Process::make_terms() {
  bulk_ =
      std::make_unique<mechanics::Bulk>(scene_.mesh, scene_.analysis, scene_.material, pattern_);
  plastic_rate_.assign(bulk_->states().size(), 0.0);
  constexpr double strain_floor = 1e-7; // stresses below that share of E count as none
  newton_ = std::make_unique<mechanics::Newton>(
      pattern_, scene_.solver,
      mechanics::NewtonSettings{.tolerance = scene_.tolerance,
                                .force_floor =
                                    strain_floor * body_stiffness() * size_of(scene_.mesh),
                                .largest_correction = size_of(scene_.mesh)},
      contact::drive_unknowns(scene_.tools).size());
  terms_ = {bulk_.get()};
  make_loads();
  if (!scene_.tools.empty()) {
    surface_ = std::make_unique<contact::ContactSurface>(scene_.mesh, *bulk_, pattern_,
                                                         scene_.contact_faces, scene_.contact);
    contact_ = std::make_unique<contact::ContactTerm>(*surface_, *bulk_, pattern_, scene_.tools,
                                                      4.0 * size_of(scene_.mesh), drive_scale());
    terms_.push_back(contact_.get());
  }
  grounded_ = free_rigid_motions(scene_);
  if (grounded_ > 0 && scene_.tools.empty())
    throw Error(Fault::case_file, "",
                fmt::format("the workpiece can move freely: {} rigid motion(s) are held by no "
                            "support and there is no tool",
                            grounded_),
                "add a [[support]] that holds them");
  if (grounded_ > 0) {
    // Spread over all nodes it is a hundred-millionth of the body's own stiffness.
    constexpr double share = 1e-8;
    grounding_stiffness_ = share * body_stiffness() / scene_.mesh.n_points();
    grounding_ = mechanics::make_grounding(grounding_stiffness_, pattern_);
    terms_.push_back(grounding_.get());
  }
}

double Process::body_stiffness() const {
  const double young = scene_.material.elasticity.young;
  // Force per length: in plane strain it is that of a slice of unit thickness.
  return scene_.analysis == mechanics::Analysis::plane_strain ? young
                                                              : young * size_of(scene_.mesh);
}

void Process::make_loads() {
  for (const LoadSpec& spec : scene_.loads) {
    if (const auto* pressure = std::get_if<PressureOn>(&spec))
      loads_.push_back(mechanics::make_pressure(scene_.mesh, scene_.analysis, pattern_,
                                                pressure->faces, pressure->pressure));
    else
      loads_.push_back(mechanics::make_dead_load(std::get<DeadForces>(spec).forces,
                                                 std::get<DeadForces>(spec).amplitude));
    terms_.push_back(loads_.back().get());
  }
}

void Process::check_overlap() const {
  if (!contact_)
    return;
  for (const contact::Tool& tool : scene_.tools) {
    if (!tool.active(0.0))
      continue;
    const geometry::Pose pose = tool.motion.pose(0.0);
    for (Index f = 0; f < surface_->n_faces(); ++f) {
      std::vector<Vec3> points = surface_->samples(x_, f);
      for (Vec3& p : points)
        p = pose.to_tool(p);
      std::vector<geometry::Projection> feet(points.size());
      tool.surface->project(points, size_of(scene_.mesh), feet);
      // A chord of a curved face may lie a little inside a tool that touches its nodes.
      constexpr double allowed_share = 0.02;
      for (std::size_t i = 0; i < feet.size(); ++i)
        if (-feet[i].gap > allowed_share * surface_->depth(f)) {
          const Vec3 at = pose.to_space(points[i]);
          throw Error(Fault::geometry, "",
                      fmt::format("the workpiece overlaps tool '{}' before the start: {:.6g} deep "
                                  "at ({:.6g}, {:.6g}, {:.6g})",
                                  tool.name, -feet[i].gap, at[0], at[1], at[2]),
                      "move the tool or the workpiece apart, or give the tool touch = true");
        }
    }
  }
}

contact::DriveScale Process::drive_scale() const {
  // A hundred-millionth of the body's own stiffness: it carries rounding, never a load.
  constexpr double share = 1e-8;
  return {size_of(scene_.mesh), share * body_stiffness()};
}

void Process::check_drives() const {
  for (const contact::Tool& tool : scene_.tools) {
    if (!tool.motion.force || !tool.active(0.0))
      continue;
    const auto t = static_cast<std::size_t>(&tool - scene_.tools.data());
    if (!contact_->lies_on(t))
      throw Error(Fault::case_file, "",
                  fmt::format("tool '{}' is driven by a force but does not touch the workpiece: "
                              "nothing tells where it is",
                              tool.name),
                  "give it touch = true, or place it where it touches");
  }
}

void Process::start_stage(const Stage& stage) {
  last_step_.clear();
  if (contact_)
    contact_->enable(stage.unload ? std::vector<char>(scene_.tools.size(), 0) : stage.tools);
}

void Process::release_tools(double next_time, double gone_time) {
  if (!contact_)
    return;
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    if (!contact_->leaves(t, next_time))
      continue;
    // Its forces stay as they are and fade: equilibrium without them is reached on the way.
    const double stored = contact_->work().stored;
    std::vector<double> forces = contact_->release(t);
    tool_energy_ += stored - contact_->work().stored;
    fading_.push_back(mechanics::make_dead_load(std::move(forces),
                                                TimeFunction({{time_, 1.0}, {gone_time, 0.0}})));
    terms_.push_back(fading_.back().get());
    last_step_.clear();
  }
}

mechanics::Prescribed Process::prescribed(double time) const {
  std::map<Index, double> wanted;
  const int dim = scene_.mesh.dimension();
  for (const Support& support : scene_.supports)
    for (const Index node : support.nodes) {
      const Index i = node * dim + support.component;
      wanted[i] = x0_[idx(i)] + support.displacement(time);
    }
  mechanics::Prescribed result;
  for (const auto& [unknown, position] : wanted) {
    result.unknowns.push_back(unknown);
    result.positions.push_back(position);
  }
  return result;
}

int Process::spent() const {
  return static_cast<int>(std::count_if(newton_->records().begin(), newton_->records().end(),
                                        [](const auto& record) { return record.iteration > 0; }));
}

bool Process::try_increment(double dt, mechanics::Approach approach, std::string& why) {
  trial_x_ = x_;
  if (!last_step_.empty()) {
    const double factor = dt / last_dt_;
    for (std::size_t i = 0; i < x_.size(); ++i)
      trial_x_[i] += factor * last_step_[i];
  }
  if (passes_through(dt, why))
    return false;
  if (contact_)
    contact_->restart();
  const auto outcome =
      newton_->solve(terms_, prescribed(time_ + dt), time_, time_ + dt, x_, trial_x_, approach);
  if (!outcome)
    why = outcome.error().reason;
  else
    last_residual_ = outcome->residual;
  const bool solved = outcome && plausible(outcome->force_scale, why) && !passes_through(dt, why) &&
                      limit_penetration(dt, why);
  if (solved)
    last_iterations_ = spent();
  else
    wasted_iterations_ += spent();
  return solved;
}

bool Process::plausible(double force_scale, std::string& why) const {
  if (bulk_->largest_plastic_increment() > most_plastic_increment) {
    why = fmt::format("plastic strain increment {:.3g} is too large",
                      bulk_->largest_plastic_increment());
    return false;
  }
  for (std::size_t i = x0_.size(); i < x_.size(); ++i)
    if (std::abs(trial_x_[i] - x_[i]) > 0.5 * size_of(scene_.mesh)) {
      why = "a driven tool moves away: nothing holds it against its load";
      return false;
    }
  if (grounding_) {
    // The grounding may carry rounding, never a load.
    constexpr double most_share = 1e-3;
    double sum = 0.0;
    for (std::size_t i = 0; i < x0_.size(); ++i)
      sum += (trial_x_[i] - x_[i]) * (trial_x_[i] - x_[i]);
    if (grounding_stiffness_ * std::sqrt(sum) > most_share * force_scale) {
      why = "the workpiece moves away freely: neither supports nor contact hold it";
      return false;
    }
  }
  return true;
}

void Process::certify(double dt) {
  const double before = now();
  penetration_ = contact_->penetration({time_, time_ + dt, x_, trial_x_},
                                       scene_.contact.max_penetration.value_or(HUGE_VAL));
  times_.certificate += now() - before;
}

bool Process::too_deep() const {
  const contact::ContactSettings& settings = scene_.contact;
  if (settings.max_penetration)
    return penetration_.bound > *settings.max_penetration;
  constexpr double unasked = 1e-6; // of the element beneath
  return settings.method == contact::Method::augmented && penetration_.share_at_points > unasked;
}

bool Process::limit_penetration(double dt, std::string& why) {
  if (!contact_)
    return true;
  certify(dt);
  constexpr int most_rounds = 8;
  // Once contact points are so much less deep than is allowed, what is too deep lies between them.
  constexpr double negligible = 0.01;
  double gain = HUGE_VAL; // of the last round, at contact points
  for (int round = 0; too_deep(); ++round) {
    const auto& limit = scene_.contact.max_penetration;
    if (round == most_rounds || (limit && penetration_.at_points <= negligible * *limit)) {
      why = penetration_failure(round);
      refused_as_too_deep_ = true;
      return false;
    }
    press_harder(gain);
    const double before = penetration_.at_points;
    const auto again = newton_->solve(terms_, prescribed(time_ + dt), time_, time_ + dt, x_,
                                      trial_x_, mechanics::Approach::from_solution);
    if (!again) {
      why = penetration_failure(round) + "; when pressed harder: " + again.error().reason;
      return false;
    }
    last_residual_ = again->residual;
    certify(dt);
    gain = before / penetration_.at_points;
  }
  return true;
}

/// (P.7) A multiplier gains the ratio of the penalty to the body's own stiffness a round: where the
/// penalty is soft that is little, and the penalty is raised as well.
void Process::press_harder(double gain) {
  constexpr double enough = 4.0;
  const contact::ContactSettings& settings = scene_.contact;
  if (settings.method == contact::Method::augmented) {
    contact_->augment();
    if (gain < enough)
      contact_->stiffen(10.0);
    return;
  }
  // Pressing lifts the contact points; what lies deeper between them comes along with them.
  constexpr double aim = 0.5; // of the room that is left to the contact points
  const double between = penetration_.bound - penetration_.at_points;
  const double room = *settings.max_penetration - between;
  constexpr double least = 2.0, most = 100.0;
  contact_->stiffen(room > 0.0 ? std::clamp(penetration_.at_points / (aim * room), least, most)
                               : most);
}

std::string Process::penetration_failure(int rounds) const {
  const Vec3& at = penetration_.position;
  const std::string deep =
      fmt::format("a face lies {:.4g} inside tool '{}' near ({:.6g}, {:.6g}, {:.6g})",
                  penetration_.bound, scene_.tools[penetration_.tool].name, at[0], at[1], at[2]);
  if (!scene_.contact.max_penetration)
    return deep + fmt::format(" after {} augmentations", rounds);
  const double limit = *scene_.contact.max_penetration;
  if (penetration_.at_points <= limit)
    return deep + fmt::format(", more than max_penetration = {:.4g}, though no contact point is "
                              "deeper than {:.2g}: the tool passes between them, and no pressure "
                              "keeps it out. A finer mesh there lessens it, on quad8 and hex20 "
                              "form = \"compatible\" may; else allow more",
                              limit, penetration_.at_points);
  return deep +
         fmt::format(", more than max_penetration = {:.4g}, and contact points {:.2g}, after "
                     "pressing harder {} times: start with a larger contact.penalty, or "
                     "allow more",
                     limit, penetration_.at_points, rounds);
}

bool Process::passes_through(double dt, std::string& why) const {
  if (contact_)
    why = passage_complaint(scene_.tools, *surface_, *contact_, {time_, time_ + dt, x_, trial_x_});
  return contact_ && !why.empty();
}

void Process::accept(double dt) {
  const mechanics::Trial trial{time_, time_ + dt, x_, trial_x_};
  std::vector<double> strain_old(bulk_->states().size());
  for (std::size_t k = 0; k < strain_old.size(); ++k)
    strain_old[k] = bulk_->states()[k].plastic_strain;
  for (mechanics::ForceTerm* term : terms_)
    term->commit(trial);
  for (std::size_t k = 0; k < strain_old.size(); ++k)
    plastic_rate_[k] = (bulk_->states()[k].plastic_strain - strain_old[k]) / dt;
  for (const Index i : prescribed(time_ + dt).unknowns) {
    const double reaction = newton_->residual()[idx(i)];
    support_work_ += 0.5 * (reactions_[idx(i)] + reaction) * (trial_x_[idx(i)] - x_[idx(i)]);
    reactions_[idx(i)] = reaction;
  }
  last_step_.resize(x_.size());
  for (std::size_t i = 0; i < x_.size(); ++i) {
    last_step_[i] = trial_x_[i] - x_[i];
    if (i < velocity_.size())
      velocity_[i] = last_step_[i] / dt;
  }
  last_dt_ = dt;
  x_ = trial_x_;
  time_ += dt;
  ++increment_;
  iterations_ += last_iterations_;
  update_energy();
}

void Process::update_energy() {
  energy_.elastic = bulk_->elastic_energy(x_);
  energy_.plastic = bulk_->plastic_work();
  energy_.external = support_work_ - tool_energy_;
  for (const auto& load : loads_)
    energy_.external += load->work();
  for (const auto& load : fading_)
    energy_.external += load->work();
  if (contact_) {
    energy_.external += contact_->work().external + contact_->work().enforcement;
    energy_.friction = contact_->work().friction;
    energy_.contact = contact_->work().stored;
  }
  if (grounding_)
    for (std::size_t i = 0; i < x0_.size(); ++i)
      energy_.grounding += grounding_stiffness_ * last_step_[i] * last_step_[i];
}

IncrementReport Process::report(double dt, int cutbacks) const {
  IncrementReport r;
  r.increment = increment_;
  r.time = time_;
  r.dt = dt;
  r.iterations = last_iterations_;
  r.residual = last_residual_;
  r.cutbacks = cutbacks;
  r.volume = bulk_->volume(x_);
  if (contact_) {
    r.max_penetration = penetration_.bound;
    r.penetration_share = penetration_.share;
    r.penetration = penetration_;
    r.contact_area = contact_->area();
  }
  for (const auto& state : bulk_->states())
    r.max_plastic_strain = std::max(r.max_plastic_strain, state.plastic_strain);
  const auto qualities = mechanics::element_qualities(
      scene_.mesh, as_points(x_, scene_.mesh.dimension(), scene_.mesh.points.size()));
  r.min_quality = *std::min_element(qualities.begin(), qualities.end());
  r.wall_time = now() - started_;
  r.energy = energy_;
  r.records = newton_->records();
  return r;
}

PostMortem
Process::post_mortem(double dt, const std::string& why, std::vector<std::string> tried) const {
  PostMortem post{time_ + dt,        dt, why, -1, penetration_.position, std::move(tried),
                  newton_->records()};
  if (!refused_as_too_deep_) {
    post.worst_node = newton_->worst_unknown() / scene_.mesh.dimension();
    post.worst_position =
        as_points(x_, scene_.mesh.dimension(), scene_.mesh.points.size())[idx(post.worst_node)];
  }
  return post;
}

double Process::next_landing(double stage_end) const {
  // Times closer than rounding count as reached.
  const double slack = 1e-9 * stage_end;
  for (const double t : scene_.landing_times)
    if (t > time_ + slack && t < stage_end - slack)
      return t;
  return stage_end;
}

void Process::notify(const std::vector<Observer*>& observers, const IncrementReport& report) {
  const double before = now();
  for (Observer* observer : observers)
    observer->incremented(*this, report);
  times_.output += now() - before;
}

RunStatus
Process::run_stage(const Stage& stage, double start, const std::vector<Observer*>& observers) {
  const double length = stage.end - start;
  const double smallest = scene_.increments.min.value_or(smallest_share * length);
  const double largest = scene_.increments.max.value_or(largest_share * length);
  double dt = std::clamp(scene_.increments.first.value_or(first_share * length),
                         std::min(smallest, largest), largest);
  start_stage(stage);
  constexpr double fade_share = 0.05; // of a stage that goes on without the tool
  constexpr int most_refusals = 3;    // for penetration: shorter increments seldom mend it
  std::vector<std::string> tried;
  int failures = 0;
  int refusals = 0;
  while (time_ < stage.end) {
    const double landing = next_landing(stage.end);
    // Two equal steps to a landing rather than a long and a tiny one.
    double step = std::min(dt, landing - time_);
    if (step < landing - time_ && step > 0.5 * (landing - time_))
      step = 0.5 * (landing - time_);
    const bool lands = step == landing - time_;
    const double gone = stage.unload ? stage.end : std::min(time_ + fade_share * length, stage.end);
    release_tools(time_ + step, gone);
    std::string why = leap(scene_, stage, time_, time_ + step);
    refused_as_too_deep_ = false;
    // After a failure a second try goes by way of a softer friction: it finds the neutral point of
    // a roll.
    if (why.empty() && (try_increment(step, mechanics::Approach::directly, why) ||
                        (contact_ && failures > 0 && !refused_as_too_deep_ &&
                         try_increment(step, mechanics::Approach::softly, why)))) {
      accept(step);
      if (lands)
        time_ = landing;
      notify(observers, report(step, failures));
      if (last_iterations_ <= 5)
        dt = std::min(std::max(dt, step) * 1.5, largest);
      else if (last_iterations_ > 9)
        dt = std::max(0.7 * step, smallest);
      failures = refusals = 0;
      tried.clear();
      for (const Observer* observer : observers)
        if (observer->stop_requested())
          return RunStatus::stopped;
      continue;
    }
    ++failures;
    ++cutbacks_;
    tried.push_back(fmt::format("dt = {:.4g}: {}", step, why));
    // The last step remains the better guess for a shorter one, but for a start that fails again.
    constexpr int tries_with_last_step = 3;
    if (failures >= tries_with_last_step)
      last_step_.clear();
    refusals += refused_as_too_deep_ ? 1 : 0;
    dt = 0.5 * step;
    if (dt < smallest || refusals == most_refusals) {
      const PostMortem post = post_mortem(step, why, tried);
      for (Observer* observer : observers)
        observer->failed(*this, post);
      return RunStatus::not_converged;
    }
  }
  return RunStatus::done;
}

RunStatus Process::run(const std::vector<Observer*>& observers) {
  const double begun = now();
  for (Observer* observer : observers)
    observer->started(*this);
  RunStatus status = RunStatus::done;
  double start = 0.0;
  for (const Stage& stage : scene_.stages) {
    status = run_stage(stage, start, observers);
    if (status != RunStatus::done)
      break;
    start = stage.end;
  }
  times_.assembly = newton_->times().assembly;
  times_.solve = newton_->times().solve;
  times_.total = now() - begun;
  for (Observer* observer : observers)
    observer->finished(*this);
  return status;
}

} // namespace billet::process
