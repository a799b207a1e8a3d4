#include "io/translate/deck_supports.h"

#include "io/case/toml_text.h"
#include "io/text/text.h"
#include "io/translate/deck_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace billet::io {

/// Those of a target's nodes that belong to the workpiece.
std::vector<DeckNumber> DeckSupports::own_nodes(const std::string& target) const {
  std::vector<DeckNumber> nodes = deck_.nodes_of(target);
  std::erase_if(nodes, [&](DeckNumber node) { return !part_.nodes.contains(node); });
  return nodes;
}

/// Makes a set of the mesh of these nodes, named as in the deck.
std::string DeckSupports::set_named(const std::string& wish, std::vector<DeckNumber> nodes) {
  const auto written = deck_.names.find(in_capitals(wish));
  std::string name = plain_name(written != deck_.names.end() ? written->second : wish);
  (*sets_)[name] = std::move(nodes);
  return name;
}

std::string DeckSupports::support_text(const std::string& set, const DeckMotion& motion) const {
  constexpr std::array names{"x", "y", "z"};
  std::vector<std::string> fix, move;
  for (const auto& [component, history] : motion.components) {
    if (component > dimension_)
      continue; // rotations of nodes without any, or out of the plane
    const char* const name = names[static_cast<std::size_t>(component - 1)];
    if (is_zero(history))
      fix.emplace_back(name);
    else
      move.push_back(fmt::format("{} = {}", name, toml_text(history)));
  }
  if (fix.empty() && move.empty())
    return "";
  std::string text = fmt::format("[[support]] # {}\nwhere = \"set:{}\"\n", motion.place, set);
  if (!fix.empty())
    text += "fix = " + toml_text(fix) + "\n";
  if (!move.empty())
    text += fmt::format("move = {{ {} }}\n", fmt::join(move, ", "));
  return text + "\n";
}

/// Nodes that are held one by one.
struct DeckSupports::SingleNodes {
  DeckMotion motion;
  std::vector<DeckNumber> nodes;
};

/// Of each component the nodes that move alike in it, and components of the same nodes together:
/// so a node in the middle of an edge goes with both of its ends, whatever else holds one of
/// them.
std::vector<DeckSupports::SingleNodes> DeckSupports::grouped(const std::vector<SingleNodes>& all) {
  std::map<std::pair<int, DeckHistory>, SingleNodes> by_component;
  for (const SingleNodes& one : all)
    for (const auto& [component, history] : one.motion.components) {
      SingleNodes& group = by_component[{component, history}];
      group.nodes.push_back(one.nodes.front());
      std::string& place = group.motion.place;
      place = place.empty() ? one.motion.place : std::min(place, one.motion.place);
    }
  std::map<std::vector<DeckNumber>, SingleNodes> by_nodes;
  for (auto& [key, group] : by_component) {
    std::sort(group.nodes.begin(), group.nodes.end());
    SingleNodes& together = by_nodes[group.nodes];
    together.nodes = group.nodes;
    together.motion.components[key.first] = key.second;
    together.motion.place = group.motion.place;
  }
  std::vector<SingleNodes> groups;
  groups.reserve(by_nodes.size());
  for (auto& [nodes, group] : by_nodes)
    groups.push_back(std::move(group));
  return groups;
}

std::string DeckSupports::text(NodeSets& sets) {
  sets_ = &sets;
  std::string text;
  std::vector<SingleNodes> single;
  for (const auto& [target, motion] : motions_) {
    std::vector<DeckNumber> nodes = own_nodes(target);
    if (nodes.empty())
      continue;
    if (deck_.node_sets.contains(target))
      text += support_text(set_named(target, std::move(nodes)), motion);
    else
      single.push_back({motion, {nodes.front()}});
  }
  int n_single = 0;
  for (SingleNodes& group : grouped(single)) {
    const std::string set = fmt::format("nodes-{}", ++n_single);
    (*sets_)[set] = std::move(group.nodes);
    text += support_text(set, group.motion);
  }
  for (const DeckRigidBody& rigid : deck_.rigid_bodies)
    text += clamped_nodes(rigid);
  return text;
}

/// Nodes of the workpiece that a rigid body takes along.
std::string DeckSupports::clamped_nodes(const DeckRigidBody& rigid) {
  if (rigid.nodes.empty())
    return "";
  std::vector<DeckNumber> nodes = own_nodes(rigid.nodes);
  if (nodes.empty() || nodes.size() == part_.nodes.size())
    return "";
  const DeckMotion motion = motion_of_node(deck_, motions_, rigid.reference);
  deck_.remarks.push_back(
      {rigid.place,
       fmt::format("*RIGID BODY: nodes of the workpiece in {} move as the reference node does, "
                   "without turning; components that nothing prescribes there are free",
                   rigid.nodes)});
  return support_text(set_named(rigid.nodes, std::move(nodes)), motion);
}

} // namespace billet::io
