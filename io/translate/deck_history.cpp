#include "io/translate/deck_history.h"

#include "geometry/base/time_function.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// Adds a point after the last one, or gives the last another value.
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

/// A value that a line of the deck prescribes.
struct GivenValue {
  double value;
  std::string amplitude; ///< empty: none
  std::string what;      ///< for a remark: "*BOUNDARY: component 2 of TOP"
  std::string place;
  double factor = 1.0; ///< on it, and on an amplitude of absolute values
};

/// A value along its amplitude: before the first point as there, after the last point as there.
class ValueCurve {
public:
  ValueCurve(const DeckAmplitude& amplitude, const GivenValue& given, double step_begin)
      : function_(points_of_curve(amplitude, given, step_begin)) {}

  [[nodiscard]] double operator()(double time) const { return function_(time); }
  [[nodiscard]] const DeckHistory& points() const { return function_.points(); }

private:
  static DeckHistory
  points_of_curve(const DeckAmplitude& amplitude, const GivenValue& given, double step_begin) {
    constexpr double no_minus = 0.0; // makes 0 of -0
    DeckHistory points;
    for (const auto& [time, factor] : amplitude.points)
      points.emplace_back(time + (amplitude.total_time ? 0.0 : step_begin),
                          given.factor * (amplitude.absolute ? factor : factor * given.value) +
                              no_minus);
    return points;
  }

  TimeFunction function_;
};

/// Adds to histories what holds from a step on.
class HistoryMaker {
public:
  explicit HistoryMaker(Deck& deck) : deck_(deck), steps_(timed_steps(deck)) {}

  [[nodiscard]] const std::vector<TimedStep>& steps() const { return steps_; }

  /// A value that is reached in a step: along its amplitude, at once, or evenly. An amplitude over
  /// the time of the run goes on after the step.
  void add_value(const TimedStep& timed, const GivenValue& given, DeckHistory& history) {
    begin_step(timed, history);
    const DeckAmplitude* const amplitude = amplitude_of(given);
    if (amplitude == nullptr) {
      if (timed.step->steps_at_once)
        add_point(history, timed.begin + soon(timed), given.factor * given.value);
      add_point(history, timed.end, given.factor * given.value);
      return;
    }
    const ValueCurve curve(*amplitude, given, timed.begin);
    const double from = begin_curve(timed, given, curve, history);
    add_curve(curve, from, amplitude->total_time ? steps_.back().end : timed.end, history);
  }

  /// A velocity as the displacement that it makes; it goes on after the step.
  void add_velocity(const TimedStep& timed, const GivenValue& given, DeckHistory& history) {
    begin_step(timed, history);
    constexpr int pieces = 8; // of a span in which the velocity changes
    const DeckHistory velocity = velocity_from(timed, given);
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

private:
  static double soon(const TimedStep& timed) { return 1e-3 * (timed.end - timed.begin); }
  /// Times that are less apart are the same.
  static double same_time(const TimedStep& timed) { return 1e-9 * (timed.end - timed.begin); }

  [[nodiscard]] const DeckAmplitude* amplitude_of(const GivenValue& given) const {
    const auto found = deck_.amplitudes.find(in_capitals(given.amplitude));
    return found == deck_.amplitudes.end() ? nullptr : &found->second;
  }

  /// Ends what was prescribed before at the begin of a step, with the value that it has there.
  static void begin_step(const TimedStep& timed, DeckHistory& history) {
    if (history.empty())
      history.emplace_back(0.0, 0.0);
    const double value = TimeFunction(history)(timed.begin);
    while (history.size() > 1 && history.back().first > timed.begin - same_time(timed))
      history.pop_back();
    add_point(history, timed.begin, value);
  }

  /// Goes to where a curve begins; where the run begins it is there, else soon after the step does.
  /// @returns the time from which on the curve holds
  double begin_curve(const TimedStep& timed,
                     const GivenValue& given,
                     const ValueCurve& curve,
                     DeckHistory& history) {
    constexpr double rounding = 1e-9;
    const double last = last_value(history), first = curve(timed.begin);
    if (timed.begin == 0.0) {
      add_point(history, timed.begin, first);
    } else if (std::abs(first - last) > rounding * std::max(std::abs(first), std::abs(last))) {
      deck_.remarks.push_back(
          {given.place,
           fmt::format("{} jumps at time {:g} from {:g} to {:g}, where its amplitude begins: it "
                       "gets there in a thousandth of the step",
                       given.what, timed.begin, last, first)});
      const double from = timed.begin + soon(timed);
      add_point(history, from, curve(from));
      return from;
    }
    return timed.begin;
  }

  static void add_curve(const ValueCurve& curve, double from, double until, DeckHistory& history) {
    const double apart = 1e-9 * (until - from);
    for (const auto& [time, value] : curve.points())
      if (time > from + apart && time < until - apart)
        add_point(history, time, value);
    add_point(history, until, curve(until));
  }

  /// The velocity from the begin of a step to the end of the run.
  [[nodiscard]] DeckHistory velocity_from(const TimedStep& timed, const GivenValue& given) const {
    const double end = steps_.back().end;
    const DeckAmplitude* const amplitude = amplitude_of(given);
    if (amplitude == nullptr)
      return {{timed.begin, given.factor * given.value}, {end, given.factor * given.value}};
    const ValueCurve curve(*amplitude, given, timed.begin);
    DeckHistory velocity{{timed.begin, curve(timed.begin)}};
    add_curve(curve, timed.begin, amplitude->total_time ? end : timed.end, velocity);
    if (end > velocity.back().first)
      velocity.emplace_back(end, last_value(velocity));
    return velocity;
  }

  Deck& deck_;
  std::vector<TimedStep> steps_;
};

void add_condition(HistoryMaker& maker,
                   const TimedStep& timed,
                   const DeckCondition& condition,
                   const char* keyword,
                   std::map<std::string, DeckMotion>& all) {
  DeckMotion& motion = all[in_capitals(condition.target)];
  if (motion.place.empty())
    motion.place = condition.place;
  for (int component = condition.first; component <= std::min(condition.last, 6); ++component) {
    DeckHistory& history = motion.components[component];
    const GivenValue given{
        condition.value, condition.amplitude,
        fmt::format("{}: component {} of {}", keyword, component, condition.target),
        condition.place, component <= 3 ? condition.unit : 1.0};
    if (condition.velocity)
      maker.add_velocity(timed, given, history);
    else
      maker.add_value(timed, given, history);
  }
}

/// Takes forces back that a step does not repeat.
void release_forces(HistoryMaker& maker,
                    const TimedStep& timed,
                    std::map<std::string, DeckMotion>& all) {
  const auto is_repeated = [&](const std::string& target, int component) {
    return std::any_of(timed.step->forces.begin(), timed.step->forces.end(),
                       [&](const DeckCondition& one) {
                         return in_capitals(one.target) == target && one.first == component;
                       });
  };
  for (auto& [target, force] : all)
    for (auto& [component, history] : force.components)
      if (!is_repeated(target, component))
        maker.add_value(timed, {}, history);
}

bool acts_at_same_place(const DeckPressure& a, const DeckPressure& b) {
  return in_capitals(a.surface) == in_capitals(b.surface) &&
         in_capitals(a.elements) == in_capitals(b.elements) && a.face == b.face &&
         a.component == b.component;
}

/// Takes pressures back that a step does not repeat.
void release_pressures(HistoryMaker& maker,
                       const TimedStep& timed,
                       std::vector<DeckPressureHistory>& all) {
  for (DeckPressureHistory& one : all)
    if (std::none_of(
            timed.step->pressures.begin(), timed.step->pressures.end(),
            [&](const DeckPressure& next) { return acts_at_same_place(next, one.pressure); }))
      maker.add_value(timed, {}, one.history);
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
  HistoryMaker maker(deck);
  if (!deck.steps.empty())
    for (const DeckCondition& condition : deck.initial.boundary)
      add_condition(maker, maker.steps().front(), condition, "*BOUNDARY", all);
  for (const TimedStep& timed : maker.steps()) {
    if (timed.step->replaces_boundary)
      for (const auto& [target, motion] : all)
        if (!is_repeated(*timed.step, target))
          deck.remarks.push_back(
              {motion.place, fmt::format("*BOUNDARY: {} is released in a later step (OP=NEW): a "
                                         "support stays to the end here",
                                         target)});
    for (const DeckCondition& condition : timed.step->boundary)
      add_condition(maker, timed, condition, "*BOUNDARY", all);
  }
  return all;
}

std::map<std::string, DeckMotion> concentrated_forces(Deck& deck) {
  std::map<std::string, DeckMotion> all;
  HistoryMaker maker(deck);
  for (const TimedStep& timed : maker.steps()) {
    if (timed.step->replaces_forces)
      release_forces(maker, timed, all);
    for (const DeckCondition& force : timed.step->forces)
      add_condition(maker, timed, force, "*CLOAD", all);
  }
  return all;
}

std::vector<DeckPressureHistory> pressure_histories(Deck& deck) {
  std::vector<DeckPressureHistory> all;
  HistoryMaker maker(deck);
  for (const TimedStep& timed : maker.steps()) {
    if (timed.step->replaces_pressures)
      release_pressures(maker, timed, all);
    for (const DeckPressure& pressure : timed.step->pressures) {
      const auto same = std::find_if(all.begin(), all.end(), [&](const DeckPressureHistory& one) {
        return acts_at_same_place(one.pressure, pressure);
      });
      DeckPressureHistory& entry =
          same != all.end() ? *same : all.emplace_back(DeckPressureHistory{pressure, {}});
      const std::string& on = pressure.surface.empty() ? pressure.elements : pressure.surface;
      maker.add_value(timed,
                      {pressure.value, pressure.amplitude,
                       (pressure.component == 0 ? "the pressure on " : "the traction on ") + on,
                       pressure.place, pressure.share * pressure.unit},
                      entry.history);
    }
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
