#include "process/run.h"

#include "geometry/base/stopwatch.h"
#include "mechanics/elements/mesh_check.h"
#include "process/bent_increment.h"
#include "process/increment_control.h"
#include "process/passage_guard.h"
#include "process/remeshing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace billet::process {

namespace {

/// Of an increment in which a tool lets go of the part too fast for its work: what is tried next.
constexpr double share_that_lets_go = 0.25;

/// Why an increment is too long for the tools; empty: it is not. A tool that moves farther than
/// this in one increment could pass the workpiece unseen.
std::string leap(const Scene& scene, const Stage& stage, double from, double to) {
  const double farthest = 0.5 * body_size(scene.mesh);
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

void Process::start_stage(const Stage& stage) {
  state_.last_step.clear();
  state_.snapshots.clear();
  if (stabilization_ && stabilization_->share() > 1.0)
    stabilization_->set_share(1.0); // it held what forces that faded could turn over
  if (contact_ && stage.unload)
    draw_tools_back(stage.end);
  else if (contact_)
    contact_->activity().enable(stage.tools);
}

mechanics::Prescribed Process::prescribed(double time) const {
  std::map<Index, double> wanted;
  const int dim = scene_.mesh.dimension();
  for (const Support& support : scene_.supports)
    for (const Index node : support.nodes) {
      const Index i = node * dim + support.component;
      wanted[i] = state_.origins[idx(i)] + support.displacement(time);
    }
  mechanics::Prescribed result;
  for (const auto& [unknown, position] : wanted) {
    result.unknowns.push_back(unknown);
    result.positions.push_back(position);
  }
  return result;
}

int Process::spent() const { return static_cast<int>(solver_work().systems - systems_before_try_); }

std::vector<double> Process::predicted(double dt) const {
  std::vector<double> x = trial_x_; // driven tools go on only if they have moved in this stage
  for (std::size_t i = 0; i < state_.velocity.size(); ++i)
    x[i] = state_.x[i] + dt * state_.velocity[i];
  return x;
}

bool Process::try_increment(double dt, mechanics::Continuation continuation, std::string& why) {
  if (contact_)
    contact_->restart();
  if (solve_increment(dt, continuation, why))
    return true;
  if (!stabilization_)
    return false;
  const auto solved_with = [&](double share) {
    stabilization_->set_share(share);
    if (contact_)
      contact_->restart();
    return solve_increment(dt, continuation, why);
  };
  const double share = stabilization_->share();
  if (share != 1.0 && solved_with(1.0)) // what held the part so far may have gone
    return true;
  // Forces that fade keep their directions: a bent sheet between them may be about to turn over.
  if (state_.time < state_.leaving.fading_until && !touched())
    for (const double stiffer : {10.0, 100.0, 1e3})
      if (stiffer > share && solved_with(stiffer))
        return true;
  stabilization_->set_share(1.0);
  return false;
}

bool Process::touched() const {
  if (contact_)
    for (std::size_t t = 0; t < scene_.tools.size(); ++t)
      if (contact::lies_on(*contact_, t))
        return true;
  return false;
}

bool Process::solve_increment(double dt, mechanics::Continuation continuation, std::string& why) {
  between_increments_ = false;
  systems_before_try_ = solver_work().systems;
  trial_x_ = state_.x;
  if (!state_.last_step.empty() && continuation != mechanics::Continuation::penalty_and_friction) {
    const double factor = dt / state_.last_dt;
    for (std::size_t i = 0; i < state_.x.size(); ++i)
      trial_x_[i] += factor * state_.last_step[i];
  }
  if (passes_through(dt, why))
    return false;
  if (contact_)
    contact_->predict(predicted(dt));
  newton_->set_force_floor(force_floor(state_.time + dt));
  draw_back_to(state_.time + dt);
  auto outcome = newton_->solve(terms_, prescribed(state_.time + dt), state_.time, state_.time + dt,
                                state_.x, trial_x_, continuation);
  if (outcome && stabilization_)
    outcome = with_light_stabilization(dt, *outcome);
  if (!outcome)
    why = outcome.error().reason + chattering_points();
  else
    state_.counters.last_residual = outcome->residual;
  bool solved = outcome && plausible(dt, outcome->force_scale, why) && !passes_through(dt, why) &&
                limit_penetration(dt, why);
  refused_inside_out_ = solved && turns_inside_out(why);
  solved = solved && !refused_inside_out_;
  if (solved)
    state_.counters.last_iterations = spent();
  else
    state_.counters.wasted_iterations += spent();
  return solved;
}

bool Process::try_softened(double dt, bool more_iterations, std::string& why) {
  const auto may_help = [this] { // what has been solved and refused has the same solution again
    return contact_ && !refused_as_too_deep_ && !refused_inside_out_;
  };
  // A part that is free but for a touch goes to and fro between points that are off by rounding.
  if (may_help() && may_hardly_touch(state_.time + dt)) {
    hardly_touches_ = true;
    const bool solved = try_increment(dt, mechanics::Continuation::none, why);
    hardly_touches_ = false;
    if (solved)
      return true;
  }
  // A softer friction finds the neutral point of a roll; a softer penalty where a sheet lifts off
  // a tool that it lay on: a stiff one opens little more than a point an iteration.
  for (const mechanics::Continuation continuation :
       {mechanics::Continuation::friction, mechanics::Continuation::penalty_and_friction})
    if (may_help() && try_increment(dt, continuation, why))
      return true;
  if (may_help() && try_friction_limited(dt, mechanics::Continuation::none, why))
    return true;
  // Metal that snaps off an edge has far to go in any increment.
  return more_iterations && may_help() &&
         (try_increment(dt, mechanics::Continuation::more_iterations, why) ||
          try_friction_limited(dt, mechanics::Continuation::more_iterations, why));
}

bool Process::try_friction_limited(double dt,
                                   mechanics::Continuation continuation,
                                   std::string& why) {
  // Where a steep cone of friction goes from stick to slip and back, one that is as high as wide
  // does not.
  constexpr int most_rounds = 4; // calm points may leave others chattering
  for (int round = 0; round < most_rounds && contact_->restart_friction_limited(); ++round) {
    if (solve_increment(dt, continuation, why))
      return true;
    if (refused_as_too_deep_ || refused_inside_out_)
      break;
  }
  return false;
}

std::string Process::chattering_points() {
  if (!contact_)
    return {};
  const std::vector<contact::ChatteringPoint> points = contact::chattering(*contact_);
  if (points.empty())
    return {};
  chattering_ = points;
  const auto& worst = points.front();
  return fmt::format("; {} contact point(s) kept changing between open, stick and slip, most of "
                     "all one on tool '{}' at ({:.6g}, {:.6g}, {:.6g}): {} times",
                     points.size(), scene_.tools[worst.tool].name, worst.position[0],
                     worst.position[1], worst.position[2], worst.changes);
}

void Process::accept(double dt) {
  if (scene_.remesh) {
    take_snapshot();
    note_forces();
  }
  const bool fades = state_.time < state_.leaving.fading_until;
  chattering_.clear();
  commit(dt);
  if (!state_.record.refusal_event.empty())
    state_.record.events.push_back(std::exchange(state_.record.refusal_event, {}));
  if (!state_.record.penalty_event.empty())
    state_.record.events.push_back(std::exchange(state_.record.penalty_event, {}));
  ++state_.increment;
  state_.counters.iterations += state_.counters.last_iterations;
  if (state_.increment == state_.mesh.increment + 1)
    state_.mesh.share = state_.record.penetration.share;
  note_deepest_tool();
  const double external = state_.energy.external;
  const double plastic = state_.energy.plastic;
  update_energy();
  if (fades && contact::bearing_area(*contact_) == 0.0)
    state_.leaving.flow_in_fading += state_.energy.plastic - plastic;
  state_.springs_back = state_.energy.external < external;
  account_contact(dt);
  between_increments_ = true;
}

void Process::commit(double dt) {
  const mechanics::Trial trial{state_.time, state_.time + dt, state_.x, trial_x_};
  std::vector<double> strain_old(bulk_->states().size());
  for (std::size_t k = 0; k < strain_old.size(); ++k)
    strain_old[k] = bulk_->states()[k].plastic_strain;
  for (mechanics::ForceTerm* term : terms_)
    term->commit(trial);
  state_.record.events = blows_ ? blows_->commit(trial) : std::vector<std::string>();
  for (std::size_t k = 0; k < strain_old.size(); ++k)
    state_.plastic_rate[k] = (bulk_->states()[k].plastic_strain - strain_old[k]) / dt;
  state_.works.supports += work_of_supports(dt);
  double of_stabilization = 0.0;
  if (stabilization_) {
    state_.energy.stabilization += stabilization_->work_in(trial);
    of_stabilization = stabilization_->force_in(trial);
  }
  for (const Index i : prescribed(state_.time + dt).unknowns)
    state_.reactions[idx(i)] = newton_->residual()[idx(i)];
  state_.last_step.resize(state_.x.size());
  for (std::size_t i = 0; i < state_.x.size(); ++i) {
    state_.last_step[i] = trial_x_[i] - state_.x[i];
    if (i < state_.velocity.size())
      state_.velocity[i] = state_.last_step[i] / dt;
  }
  state_.last_dt = dt;
  state_.x = trial_x_;
  state_.time += dt;
  note_largest_force(of_stabilization);
}

void Process::account_contact(double dt) {
  if (!contact_)
    return;
  std::vector<double> strain;
  strain.reserve(bulk_->states().size());
  for (const auto& state : bulk_->states())
    strain.push_back(state.plastic_strain);
  state_.record.window.add(contact_->closed(),
                           {surface_->bulk_points(), strain, state_.plastic_rate}, dt);
  if (wear_)
    wear_->add(*contact_, state_.x, state_.time);
}

IncrementReport Process::report(double dt, int cutbacks) const {
  IncrementReport r;
  r.increment = state_.increment;
  r.time = state_.time;
  r.dt = dt;
  r.iterations = state_.counters.last_iterations;
  r.residual = state_.counters.last_residual;
  r.cutbacks = cutbacks;
  r.volume = bulk_->volume(state_.x);
  if (contact_) {
    r.max_penetration = state_.record.penetration.bound;
    r.penetration_share = state_.record.penetration.share;
    r.penetration = state_.record.penetration;
    r.contact_area = contact_->area();
  }
  for (const auto& state : bulk_->states())
    r.max_plastic_strain = std::max(r.max_plastic_strain, state.plastic_strain);
  r.min_quality = state_.record.trial_quality;
  r.wall_time = times_before_ + seconds_now() - started_;
  r.energy = state_.energy;
  r.records = newton_->records();
  r.events = state_.record.events;
  return r;
}

PostMortem
Process::post_mortem(double dt, const std::string& why, std::vector<std::string> tried) const {
  PostMortem post{.time = state_.time + dt,
                  .dt = dt,
                  .reason = why,
                  .worst_position = state_.record.penetration.position,
                  .tried = std::move(tried),
                  .drives = drive_states(state_.time + dt),
                  .chattering = chattering_,
                  .inside_out = refused_inside_out_,
                  .too_deep = refused_as_too_deep_,
                  .records = newton_->records()};
  if (!refused_as_too_deep_) {
    post.worst_node = newton_->worst_unknown() / scene_.mesh.dimension();
    post.worst_position =
        mechanics::node_position(state_.x, scene_.mesh.dimension(), post.worst_node);
  }
  return post;
}

double Process::next_landing(double stage_end) const {
  // Times closer than rounding count as reached.
  const double slack = 1e-9 * stage_end;
  for (const double t : scene_.landing_times)
    if (t > state_.time + slack && t < stage_end - slack)
      return t;
  return stage_end;
}

void Process::notify(const std::vector<Observer*>& observers, const IncrementReport& report) {
  const Stopwatch timed(times_.output);
  for (Observer* observer : observers)
    observer->incremented(*this, report);
}

namespace {

bool stop_requested(const std::vector<Observer*>& observers) {
  return std::any_of(observers.begin(), observers.end(),
                     [](const Observer* observer) { return observer->stop_requested(); });
}

} // namespace

std::string Process::begin_stage(const Stage& stage, double start) {
  StageProgress& progress = state_.progress;
  const std::size_t number = progress.stage;
  progress = {};
  progress.stage = number;
  progress.begun = true;
  start_stage(stage);
  if (std::string why = begin_blows(stage); !why.empty())
    return why;
  begin_increments(stage, start);
  return "";
}

void Process::begin_increments(const Stage& stage, double start) {
  StageProgress& progress = state_.progress;
  progress.start = start;
  progress.length = stage.end - start;
  progress.limits = limits(progress.length);
  progress.control = IncrementControl(progress.limits);
  state_.longest = progress.limits.max;
}

RunStatus
Process::run_stage(const Stage& stage, double start, const std::vector<Observer*>& observers) {
  StageProgress& progress = state_.progress;
  if (!progress.begun) // a run that is resumed is in the midst of it
    if (const std::string why = begin_stage(stage, start); !why.empty()) {
      for (Observer* observer : observers)
        observer->failed(*this, post_mortem(0.0, why, {}));
      return RunStatus::not_converged;
    }
  const double& began = progress.start;
  const double& length = progress.length;
  const IncrementControl::Limits& limit = progress.limits;
  IncrementControl& control = progress.control;
  std::vector<std::string>& tried = progress.tried;
  std::string& unmeshed = progress.unmeshed;
  int &failures = progress.failures, &refusals = progress.refusals;
  int &in_rows = progress.in_rows, &wary = progress.wary;
  bool& rested = progress.rested;
  constexpr int most_refusals = 3; // for penetration: shorter increments seldom mend it
  constexpr int most_turned = 3;   // tries that end with an element inside out, on one mesh
  // Shorter increments have been in vain, or there are none. Once in between: it takes long.
  const auto is_last_way = [&](int in_vain, double step) {
    constexpr int many = 6;
    return in_vain == many || 0.5 * step < limit.min;
  };
  constexpr int long_to_wait = 3;  // tries of an increment, for a signal
  constexpr int many_failures = 2; // of an increment: then a driven tool is held in places (P.32)
  // An increment has been refused lately: for so many more they end before touches.
  constexpr int increments_wary = 20;
  const auto parts_in_rows = [&] { return in_rows > 0 && !retreating_.empty(); };
  while (state_.time < stage.end) {
    if (between_increments_)
      write_checkpoint(observers, CheckpointReason::due);
    // The linear solver, which forgets where the run is stored, would go another way from between
    // the tries of an increment than without a stop. One that is refused again and again takes
    // long.
    if ((between_increments_ || failures >= long_to_wait) && stop_requested(observers))
      return RunStatus::stopped;
    if (failures == 0 && flies(stage, length)) {
      if (fly(stage, observers) && state_.time < stage.end) { // as if the stage began here
        begin_increments(stage, state_.time);
      }
      continue;
    }
    if (failures == 0 && !rested && rests(stage)) {
      state_.energy_used_up = &stage == &scene_.stages.back();
      if (state_.energy_used_up)
        break;
      control.set_next(length);
      rested = true; // an increment that is refused all the same gets shorter
    }
    const double landing = next_landing(stage.end);
    const double whole =
        control.in_parts()
            ? part_towards(landing - state_.time, control.next())
            : step_towards(landing - state_.time, std::min(control.next(), longest_for_blows()));
    const bool ends_before_touches = failures == 0 && wary > 0 && !control.in_parts();
    const double step =
        ends_before_touches ? std::max(up_to_touch(whole), std::min(whole, limit.min)) : whole;
    const bool lands = step == landing - state_.time;
    const double gone =
        stage.unload ? stage.end : std::min(state_.time + fade_share * length, stage.end);
    release_tools(state_.time + step, gone);
    activate_tools(stage, state_.time + step);
    std::string why = leap(scene_, stage, state_.time, state_.time + step);
    refused_as_too_deep_ = refused_inside_out_ = false;
    if (why.empty() && (try_increment(step, mechanics::Continuation::none, why) ||
                        ((failures > 0 || parts_in_rows() || is_last_way(failures, step)) &&
                         try_softened(step, is_last_way(failures, step), why)) ||
                        (failures >= many_failures && try_held_tool(step, why)))) {
      if (const std::optional<double> sooner = step_to_stop(step)) {
        state_.counters.wasted_iterations += state_.counters.last_iterations;
        control.set_next(*sooner);
        continue;
      }
      if (lets_go_too_fast(step)) {
        state_.counters.wasted_iterations += state_.counters.last_iterations;
        control.set_next(share_that_lets_go * step);
        continue;
      }
      const std::optional<Bend> bend = bend_within(step, length, limit.min);
      if (const std::string missed = bend ? std::string() : misses_too_much(step, length);
          !missed.empty() && 0.5 * step >= limit.min) {
        state_.counters.wasted_iterations += state_.counters.last_iterations;
        ++state_.counters.cutbacks;
        tried.push_back(fmt::format("dt = {:.4g}: {}", step, missed));
        control.failed(step);
        continue;
      }
      if (const FirstTouch touch = poor_first_touch(step); !touch.cause.empty()) {
        state_.counters.wasted_iterations += state_.counters.last_iterations;
        unmeshed = remesh(touch.cause, observers, touch.sizes);
        if (!unmeshed.empty())
          state_.record.refusal_event =
              fmt::format("  no new mesh ({}): {}", touch.cause, unmeshed);
        continue;
      }
      if (bend) {
        state_.counters.wasted_iterations += state_.counters.last_iterations;
        ++state_.counters.cutbacks;
        tried.push_back(fmt::format("dt = {:.4g}: {}", step, bend->why));
        control.split(step, bend->share, state_.counters.last_iterations);
        continue;
      }
      const EnergyBalance before = state_.energy;
      accept(step);
      if (lands)
        state_.time = landing;
      for (const std::string& line : tried)
        state_.record.events.push_back("  cut back from " + line);
      notify(observers, report(step, static_cast<int>(tried.size())));
      const bool easy =
          failures == 0 && state_.counters.last_iterations <= IncrementControl::easy_iterations;
      adapt_penalty(easy ? Progress::easy : Progress::laboured);
      control.accepted(step, state_.counters.last_iterations,
                       missed_since(before, (state_.time - began) / length));
      constexpr int remembered = 3;
      in_rows = failures > 0 ? remembered : std::max(0, in_rows - 1);
      wary = failures > 0 ? increments_wary : std::max(0, wary - 1);
      failures = refusals = 0;
      tried.clear();
      // While forces fade no mesh is made, so one that is due then comes before tools return.
      const bool goes_on =
          state_.time < stage.end || (stage.unload && &stage != &scene_.stages.back());
      if (const std::string cause = remeshing_due(stage.end - state_.time);
          !cause.empty() && goes_on) {
        unmeshed = remesh(cause, observers);
        if (!unmeshed.empty())
          state_.record.refusal_event = fmt::format("  no new mesh ({}): {}", cause, unmeshed);
      }
      continue;
    }
    ++failures;
    adapt_penalty(failures > 1 ? Progress::none : Progress::laboured);
    ++state_.counters.cutbacks;
    tried.push_back(fmt::format("dt = {:.4g}: {}", step, why));
    // The last step remains the better guess for a shorter one, but for a start that fails again.
    constexpr int tries_with_last_step = 3;
    if (failures >= tries_with_last_step)
      state_.last_step.clear();
    refusals += refused_as_too_deep_ ? 1 : 0;
    state_.mesh.turned_inside_out += refused_inside_out_ ? 1 : 0;
    control.failed(step);
    constexpr int tries_of_a_mesh = 3;
    if ((failures >= tries_of_a_mesh || refusals == most_refusals) && may_remesh()) {
      unmeshed = remesh("failed increments", observers);
      if (unmeshed.empty()) {
        failures = refusals = 0;
        control.set_next(tries_of_a_mesh * step);
        continue;
      }
    }
    if (control.exhausted() && !retreating_.empty()) {
      // What keeps them from drawing back is left to their forces, which fade.
      state_.record.refusal_event =
          "  tools leave their forces behind, which fade: drawn back further they do not "
          "hold the part";
      put_tools_back();
      contact_->activity().enable(std::vector<char>(scene_.tools.size(), 0));
      state_.leaving.fading_until = state_.time;
      control = IncrementControl(limit);
      failures = refusals = 0;
      continue;
    }
    if (control.exhausted() || refusals == most_refusals ||
        state_.mesh.turned_inside_out >= most_turned) {
      why += initial_penetrations_now();
      if (!refused_as_too_deep_ && !refused_inside_out_)
        why += unbalanced_loads(state_.time + step);
      if (!unmeshed.empty())
        why += "; the part could not be meshed anew: " + unmeshed;
      const PostMortem post = post_mortem(step, why, tried);
      for (Observer* observer : observers)
        observer->failed(*this, post);
      return RunStatus::not_converged;
    }
  }
  put_tools_back();
  return RunStatus::done;
}

void Process::take_times() {
  const mechanics::SolverWork& work = newton_->solver_work();
  const double search = contact_ ? contact_->times().search : 0.0;
  const double contact = contact_ ? contact_->times().elements : 0.0;
  const double elements = bulk_->assembly_time();
  times_.search = earlier_times_.search + search;
  times_.contact = earlier_times_.contact + contact;
  times_.elements = earlier_times_.elements + elements;
  times_.assembly =
      earlier_times_.assembly + newton_->times().assembly - elements - search - contact;
  times_.analysis = earlier_times_.analysis + work.analysis;
  times_.factorization = earlier_times_.factorization + work.factorization;
  times_.solve = earlier_times_.solve + newton_->times().solve - work.factorization -
                 (work.analysis - analysis_before_run_);
}

RunStatus Process::run(const std::vector<Observer*>& observers) {
  analysis_before_run_ = newton_->solver_work().analysis;
  for (Observer* observer : observers)
    resumed_ ? observer->resumed(*this) : observer->started(*this);
  RunStatus status = RunStatus::done;
  StageProgress& progress = state_.progress;
  for (; progress.stage < scene_.stages.size(); ++progress.stage) {
    const double start = progress.stage > 0 ? scene_.stages[progress.stage - 1].end : 0.0;
    status = run_stage(scene_.stages[progress.stage], start, observers);
    const bool last = &scene_.stages[progress.stage] == &scene_.stages.back();
    write_checkpoint(observers, status == RunStatus::stopped         ? CheckpointReason::stopped
                                : status == RunStatus::not_converged ? CheckpointReason::failed
                                : last                               ? CheckpointReason::end
                                                                     : CheckpointReason::new_stage);
    if (status != RunStatus::done || last)
      break;
    progress.begun = false;
  }
  take_times();
  times_.total = times_before_ + seconds_now() - started_;
  for (Observer* observer : observers)
    observer->finished(*this);
  return status;
}

} // namespace billet::process
