#include "io/translate/deck_tool_motions.h"

#include "io/case/toml_text.h"
#include "io/translate/deck_tools.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace billet::io {

namespace {

/// The speed of an angle: constant between its points.
std::string speed_text(const DeckHistory& angle) {
  constexpr double jump = 1e-6; // of a span, in which the speed changes
  std::vector<std::pair<double, double>> speed;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    const double span = angle[i].first - angle[i - 1].first;
    const double value = (angle[i].second - angle[i - 1].second) / span;
    speed.emplace_back(angle[i - 1].first + (i > 1 ? jump * span : 0.0), value);
    speed.emplace_back(angle[i].first, value);
  }
  const bool is_constant = std::all_of(speed.begin(), speed.end(), [&](const auto& point) {
    return point.second == speed.front().second;
  });
  return is_constant ? fmt::format("{:.10g}", speed.front().second) : toml_text(speed);
}

} // namespace

std::string DeckToolMotions::text(const std::string& tool,
                                  const DeckMotion& motion,
                                  const DeckRigidBody* rigid) {
  std::vector<std::string> parts;
  if (const std::string text = translation_text(tool, motion, rigid); !text.empty())
    parts.push_back(text);
  if (rigid != nullptr)
    if (const std::string text = rotation_text(tool, motion, *rigid); !text.empty())
      parts.push_back(text);
  return parts.empty() ? "" : fmt::format("motion = {{ {} }}\n", fmt::join(parts, ", "));
}

std::string DeckToolMotions::translation_text(const std::string& tool,
                                              const DeckMotion& motion,
                                              const DeckRigidBody* rigid) {
  if (std::string force = force_text(tool, rigid); !force.empty())
    return force;
  std::set<double> times{0.0};
  bool moves = false;
  for (int c = 1; c <= dimension(); ++c)
    if (const auto found = motion.components.find(c); found != motion.components.end()) {
      moves = moves || !is_zero(found->second);
      for (const auto& [time, value] : found->second)
        times.insert(time);
    } else {
      remark(fmt::format("tool {}: nothing holds or moves it in {}: it stays", tool, "xyz"[c - 1]));
    }
  if (!moves)
    return "";
  std::string rows;
  for (const double time : times) {
    rows += fmt::format("{}[{:.10g}", rows.empty() ? "" : ", ", time);
    for (int c = 1; c <= dimension(); ++c) {
      const auto found = motion.components.find(c);
      rows += fmt::format(
          ", {:.10g}", found == motion.components.end() ? 0.0 : TimeFunction(found->second)(time));
    }
    rows += "]";
  }
  return "displacement = [" + rows + "]";
}

std::string DeckToolMotions::force_text(const std::string& tool, const DeckRigidBody* rigid) {
  if (rigid == nullptr)
    return "";
  for (const auto& [target, force] : forces_) {
    const std::vector<DeckNumber> nodes = deck_.nodes_of(target);
    if (nodes.size() != 1 || nodes.front() != rigid->reference)
      continue;
    const auto& [component, history] = *force.components.begin();
    if (component > dimension())
      continue;
    used_forces_.insert(target);
    if (force.components.size() > 1)
      remark(fmt::format("tool {}: the force along {} is taken, the others are left out", tool,
                         "xyz"[component - 1]),
             force.place);
    Vec3 direction = Vec3::Zero();
    direction[component - 1] = 1.0;
    return fmt::format("force = {{ direction = {}, value = {} }}",
                       vector_text(direction, in_space_), toml_text(history));
  }
  return "";
}

std::string DeckToolMotions::rotation_text(const std::string& tool,
                                           const DeckMotion& motion,
                                           const DeckRigidBody& rigid) {
  std::map<int, DeckHistory> angles;
  for (const auto& [component, history] : motion.components)
    if (component > 3 && !is_zero(history))
      angles[component - 3] = history;
  if (rigid.rotation != 0)
    for (const auto& [component, history] :
         motion_of_node(deck_, motions_, rigid.rotation).components)
      if (component <= 3 && !is_zero(history))
        angles[component] = history;
  if (!in_space_ && std::erase_if(angles, [](const auto& one) { return one.first != 3; }) > 0)
    remark(
        fmt::format("tool {}: in the plane it turns about z only, other axes are left out", tool));
  if (angles.empty())
    return "";
  if (rigid.reference == 0) {
    remark(fmt::format("tool {}: it turns, but has no REF NODE to turn about: left out", tool),
           rigid.place);
    return "";
  }
  if (angles.size() > 1)
    remark(fmt::format("tool {}: it turns about one axis only, the others are left out", tool));
  const auto& [axis, history] = *angles.begin();
  Vec3 direction = Vec3::Zero();
  direction[axis - 1] = 1.0;
  return fmt::format("rotation = {{ point = {}{}, speed = {} }}",
                     vector_text(deck_point(deck_, rigid.reference), in_space_),
                     in_space_ ? ", axis = " + vector_text(direction, true) : "",
                     speed_text(history));
}

} // namespace billet::io
