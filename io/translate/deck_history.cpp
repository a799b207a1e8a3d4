#include "io/translate/deck_history.h"

#include <fmt/format.h>

#include <algorithm>

namespace billet::io {

namespace {

/// A step with its place in time.
struct TimedStep {
  const DeckStep* step;
  double begin;
  double end;
};

std::vector<TimedStep> timed_steps(const Deck& deck) {
  std::vector<TimedStep> steps;
  double time = 0.0;
  for (const DeckStep& step : deck.steps) {
    steps.push_back({&step, time, time + step.period});
    time += step.period;
  }
  if (steps.empty())
    steps.push_back({&deck.initial, 0.0, deck.initial.period});
  return steps;
}

void add_point(DeckHistory& history, double time, double value) {
  if (!history.empty() && !(time > history.back().first)) {
    history.back().second = value;
    return;
  }
  history.emplace_back(time, value);
}

double last_value(const DeckHistory& history) {
  return history.empty() ? 0.0 : history.back().second;
}

/// A value that is reached in a step: along its amplitude, at once, or evenly.
void add_step(const Deck& deck,
              const TimedStep& timed,
              double value,
              const std::string& amplitude_name,
              DeckHistory& history) {
  if (history.empty())
    history.emplace_back(timed.begin, 0.0);
  if (history.back().first < timed.begin)
    add_point(history, timed.begin, last_value(history));
  const auto amplitude = deck.amplitudes.find(in_capitals(amplitude_name));
  if (amplitude == deck.amplitudes.end()) {
    constexpr double at_once = 1e-3; // of the step
    if (timed.step->steps_at_once)
      add_point(history, timed.begin + at_once * (timed.end - timed.begin), value);
    add_point(history, timed.end, value);
    return;
  }
  const double offset = amplitude->second.total_time ? 0.0 : timed.begin;
  for (const auto& [time, factor] : amplitude->second.points)
    if (const double t = offset + time; t >= timed.begin && t <= timed.end)
      add_point(history, t, factor * value);
  if (history.back().first < timed.end)
    add_point(history, timed.end, last_value(history));
}

/// A velocity as the displacement that it makes.
void add_velocity(const Deck& deck,
                  const TimedStep& timed,
                  double value,
                  const std::string& amplitude_name,
                  DeckHistory& history) {
  DeckHistory velocity;
  add_step(deck, timed, value, amplitude_name, velocity);
  if (!deck.amplitudes.contains(in_capitals(amplitude_name)))
    velocity = {{timed.begin, value}, {timed.end, value}};
  if (history.empty())
    history.emplace_back(timed.begin, 0.0);
  constexpr int pieces = 8; // of a span in which the velocity changes
  for (std::size_t i = 1; i < velocity.size(); ++i) {
    const auto& [t0, v0] = velocity[i - 1];
    const auto& [t1, v1] = velocity[i];
    const double start = last_value(history);
    for (int k = 1; k <= (v0 == v1 ? 1 : pieces); ++k) {
      const double s = v0 == v1 ? 1.0 : static_cast<double>(k) / pieces;
      add_point(history, t0 + s * (t1 - t0),
                start + (t1 - t0) * (s * v0 + 0.5 * s * s * (v1 - v0)));
    }
  }
}

void add_condition(const Deck& deck,
                   const TimedStep& timed,
                   const DeckCondition& condition,
                   std::map<std::string, DeckMotion>& all) {
  DeckMotion& motion = all[in_capitals(condition.target)];
  if (motion.place.empty())
    motion.place = condition.place;
  for (int component = condition.first; component <= std::min(condition.last, 6); ++component) {
    DeckHistory& history = motion.components[component];
    if (condition.velocity)
      add_velocity(deck, timed, condition.value, condition.amplitude, history);
    else
      add_step(deck, timed, condition.value, condition.amplitude, history);
  }
}

/// Whether a step that replaces all conditions prescribes a target again.
bool is_repeated(const DeckStep& step, const std::string& target) {
  return std::any_of(step.boundary.begin(), step.boundary.end(),
                     [&](const DeckCondition& one) { return in_capitals(one.target) == target; });
}

} // namespace

double end_of(const Deck& deck) { return timed_steps(deck).back().end; }

bool is_zero(const DeckHistory& history) {
  return std::all_of(history.begin(), history.end(),
                     [](const auto& point) { return point.second == 0.0; });
}

std::map<std::string, DeckMotion> prescribed_motions(Deck& deck) {
  std::map<std::string, DeckMotion> all;
  const std::vector<TimedStep> steps = timed_steps(deck);
  if (!deck.steps.empty())
    for (const DeckCondition& condition : deck.initial.boundary)
      add_condition(deck, steps.front(), condition, all);
  for (const TimedStep& timed : steps) {
    if (timed.step->replaces_boundary)
      for (const auto& [target, motion] : all)
        if (!is_repeated(*timed.step, target))
          deck.remarks.push_back(
              {motion.place, fmt::format("*BOUNDARY: {} is released in a later step (OP=NEW): a "
                                         "support stays to the end here",
                                         target)});
    for (const DeckCondition& condition : timed.step->boundary)
      add_condition(deck, timed, condition, all);
  }
  return all;
}

std::map<std::string, DeckMotion> concentrated_forces(Deck& deck) {
  std::map<std::string, DeckMotion> all;
  for (const TimedStep& timed : timed_steps(deck))
    for (const DeckCondition& force : timed.step->forces)
      add_condition(deck, timed, force, all);
  return all;
}

std::vector<DeckPressureHistory> pressure_histories(Deck& deck) {
  std::vector<DeckPressureHistory> all;
  for (const TimedStep& timed : timed_steps(deck))
    for (const DeckPressure& pressure : timed.step->pressures) {
      const auto same = std::find_if(all.begin(), all.end(), [&](const DeckPressureHistory& one) {
        return one.pressure.surface == pressure.surface &&
               one.pressure.elements == pressure.elements && one.pressure.face == pressure.face;
      });
      DeckPressureHistory& entry =
          same != all.end() ? *same : all.emplace_back(DeckPressureHistory{pressure, {}});
      if (entry.history.empty() && timed.begin > 0.0)
        entry.history.emplace_back(0.0, 0.0);
      add_step(deck, timed, pressure.value, pressure.amplitude, entry.history);
    }
  return all;
}

DeckMotion
motion_of_node(const Deck& deck, const std::map<std::string, DeckMotion>& all, DeckNumber node) {
  DeckMotion motion;
  for (const auto& [target, one] : all) {
    const std::vector<DeckNumber> nodes = deck.nodes_of(target);
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end())
      continue;
    for (const auto& [component, history] : one.components)
      if (!motion.components.contains(component) || !is_zero(history))
        motion.components[component] = history;
    motion.place = one.place;
  }
  return motion;
}

} // namespace billet::io
