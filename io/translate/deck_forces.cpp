#include "io/translate/deck_forces.h"

#include "io/case/toml_text.h"
#include "io/text/text.h"
#include "io/translate/deck_history.h"
#include "io/translate/deck_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace billet::io {

void DeckForces::remark(const std::string& text, const std::string& place) {
  deck_.remarks.push_back({place, text});
}

std::vector<std::set<DeckNumber>> DeckForces::loaded_faces(const DeckPressure& pressure) const {
  std::vector<std::pair<std::string, std::string>> members{{pressure.elements, pressure.face}};
  if (const auto surface = deck_.surfaces.find(in_capitals(pressure.surface));
      surface != deck_.surfaces.end())
    members = surface->second.members;
  std::vector<std::set<DeckNumber>> faces;
  for (const auto& [set, label] : members)
    for (const DeckNumber number : deck_.elements_of(set))
      if (const auto element = deck_.elements.find(number); element != deck_.elements.end())
        for (const DeckFace& face : faces_of(deck_, element->second, label)) {
          std::set<DeckNumber> corners(face.corners.begin(), face.corners.end());
          if (std::all_of(corners.begin(), corners.end(),
                          [&](DeckNumber node) { return part_.nodes.contains(node); }))
            faces.push_back(std::move(corners));
        }
  return faces;
}

std::string DeckForces::text(const std::optional<double>& density, NodeSets& sets) {
  sets_ = &sets;
  std::string text;
  for (const DeckPressureHistory& one : pressure_histories(deck_)) {
    const int component = one.pressure.component;
    if (component != 0 && is_zero(one.history))
      continue; // a traction along other axes
    if (component > (space_.in_space ? 3 : 2)) {
      remark("TRVEC: its component along z is left out", one.pressure.place);
      continue;
    }
    const std::vector<std::vector<DeckNumber>> groups =
        mesh_.sets_of_faces(loaded_faces(one.pressure));
    if (groups.empty())
      remark(fmt::format("the {} does not act on the workpiece: left out",
                         component == 0 ? "pressure" : "traction"),
             one.pressure.place);
    for (const std::vector<DeckNumber>& nodes : groups) {
      const std::string set =
          component == 0 ? fmt::format("pressure-{}", ++n_pressures_) : set_of_traction(nodes);
      sets[set] = nodes;
      text += fmt::format(
          "[[load]] # {}\nwhere = \"set:{}\"\n{}{}\n\n", one.pressure.place, set,
          component == 0 ? "pressure = "
                         : fmt::format("traction = {}\namplitude = ",
                                       vector_text(Vec3::Unit(component - 1), space_.in_space)),
          toml_text(one.history));
    }
  }
  return text + gravity_text(density) + body_force_text();
}

std::string DeckForces::set_of_traction(const std::vector<DeckNumber>& nodes) {
  for (int i = 1; i <= n_tractions_; ++i)
    if (std::string set = fmt::format("traction-{}", i); sets_->at(set) == nodes)
      return set;
  return fmt::format("traction-{}", ++n_tractions_);
}

std::optional<int> DeckForces::axis_of(const std::string& label) const {
  if (space_.axisymmetric)
    return label == "BR" ? std::optional(0) : label == "BZ" ? std::optional(1) : std::nullopt;
  const int dimension = space_.in_space ? 3 : 2;
  const int axis = label == "BX" ? 0 : label == "BY" ? 1 : label == "BZ" ? 2 : dimension;
  return axis < dimension ? std::optional(axis) : std::nullopt;
}

std::string DeckForces::body_force_text() {
  Vec3 sum = Vec3::Zero();
  for (const auto& [label, force] : deck_.body_forces) {
    const std::optional<int> axis = axis_of(label);
    const std::vector<DeckNumber> elements = deck_.elements_of(force.elements);
    const bool acts = std::any_of(elements.begin(), elements.end(), [&](DeckNumber number) {
      return std::binary_search(part_.elements.begin(), part_.elements.end(), number);
    });
    if (!axis || !acts) {
      remark(fmt::format("{}: {}, left out", label,
                         acts ? "no axis of the case" : "it does not act on the workpiece"),
             force.place);
      continue;
    }
    note_whole_time(label, force.amplitude, force.step, force.place);
    note_whole_part(label, force.elements, force.place);
    sum[*axis] += force.value;
  }
  return sum.isZero() ? ""
                      : fmt::format("[[load]] # body forces\nwhere = \"all\"\nbody_force = {}\n\n",
                                    vector_text(sum, space_.in_space));
}

std::string DeckForces::gravity_text(const std::optional<double>& density) {
  if (!deck_.gravity)
    return "";
  const DeckGravity& gravity = *deck_.gravity;
  if (!density) {
    remark("GRAV: the workpiece has no *DENSITY, left out", gravity.place);
    return "";
  }
  if (gravity.direction.isZero()) {
    remark("GRAV: without a direction, left out", gravity.place);
    return "";
  }
  note_whole_time("GRAV", gravity.amplitude, gravity.step, gravity.place);
  if (!gravity.elements.empty())
    note_whole_part("GRAV", gravity.elements, gravity.place);
  const Vec3 force = *density * gravity.value * gravity.direction.normalized();
  return fmt::format("[[load]] # gravity\nwhere = \"all\"\nbody_force = {}\n\n",
                     vector_text(force, space_.in_space));
}

void DeckForces::note_whole_time(const std::string& label,
                                 const std::string& amplitude,
                                 std::size_t step,
                                 const std::string& place) {
  if (!amplitude.empty() || step > 1)
    remark(label + ": it acts in full from the begin of the run to its end", place);
}

void DeckForces::note_whole_part(const std::string& label,
                                 const std::string& set,
                                 const std::string& place) {
  std::vector<DeckNumber> elements = deck_.elements_of(set);
  std::sort(elements.begin(), elements.end());
  if (!std::includes(elements.begin(), elements.end(), part_.elements.begin(),
                     part_.elements.end()))
    remark(fmt::format("{} on {}: it acts on the whole workpiece", label, set), place);
}

} // namespace billet::io
