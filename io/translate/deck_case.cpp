#include "io/translate/deck_case.h"

#include "geometry/base/error.h"
#include "io/case/toml_text.h"
#include "io/text/text.h"
#include "io/translate/deck_forces.h"
#include "io/translate/deck_history.h"
#include "io/translate/deck_mesh.h"
#include "io/translate/deck_supports.h"
#include "io/translate/deck_tool_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace billet::io {

namespace {

bool deforms(const Deck& deck, const DeckBody& body) {
  const std::string& type = deck.elements.at(body.elements.front()).type;
  return body.rigid == nullptr && (type.starts_with("C3D") || type.starts_with("CPE") ||
                                   type.starts_with("CPS") || type.starts_with("CAX"));
}

const DeckMaterial* material_of(const Deck& deck, const DeckBody& body) {
  const auto found = deck.materials.find(body.material);
  return found == deck.materials.end() ? nullptr : &found->second;
}

/// How much a body looks like the workpiece: plastic first, then the softer, then the larger.
std::array<double, 3> rank_of(const Deck& deck, const DeckBody& body) {
  const DeckMaterial* const material = material_of(deck, body);
  const bool plastic = material != nullptr && material->is_plastic();
  const double young =
      material != nullptr && material->elastic ? (*material->elastic)[0] : HUGE_VAL;
  return {plastic ? 1.0 : 0.0, -young, static_cast<double>(body.elements.size())};
}

class CaseMaker {
public:
  CaseMaker(Deck& deck, const DeckUnits& units)
      : deck_(deck), units_(units), bodies_(deck_bodies(deck)) {
    choose_workpiece();
    note_elements_left_out();
    note_other_materials();
    motions_ = prescribed_motions(deck_);
    forces_ = concentrated_forces(deck_);
    tool_motions_.emplace(deck_, motions_, forces_, in_space_);
  }

  DeckCase make(const std::string& name) {
    std::string text = head(name) + material_text() + supports_text() + loads_text() +
                       tools_text() + contact_text() + time_text();
    const std::string mesh = mesh_text(); // knows by now which sets are asked for
    note_unused_forces();
    note_unused_motions();
    DeckCase result;
    result.files.push_back({"case.toml", remarks_text(name) + text});
    result.files.push_back({"part.inp", mesh});
    for (DeckFile& file : files_)
      result.files.push_back(std::move(file));
    result.remarks = deck_.remarks;
    return result;
  }

private:
  void remark(const std::string& text, const std::string& place = {}) {
    deck_.remarks.push_back({place, text});
  }

  // --- workpiece ---------------------------------------------------------------------------------

  void choose_workpiece() {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (deforms(deck_, bodies_[i]) &&
          (workpiece_ == bodies_.size() + 1 ||
           rank_of(deck_, bodies_[i]) > rank_of(deck_, bodies_[workpiece_])))
        workpiece_ = i;
    if (workpiece_ > bodies_.size())
      throw Error(Fault::geometry, "", "the deck has no body of solid elements that deforms",
                  "C3D, CPE or CAX elements with a *SOLID SECTION make the workpiece");
    const DeckElement& first = deck_.elements.at(part().elements.front());
    in_space_ = !is_plane_type(first.type);
    axisymmetric_ = first.type.starts_with("CAX");
    mesh_ = mesh_of(deck_, part());
    if (!mesh_.remark.empty())
      remark(mesh_.remark);
    if (first.type.starts_with("CPS"))
      remark("plane stress is not available: the case is in plane strain, forces are higher");
    if (!in_space_ && !axisymmetric_ && deck_.thickness.value_or(1.0) != 1.0)
      remark(fmt::format("forces of the case are per unit of thickness, the deck's of {:g}",
                         *deck_.thickness));
    for (const DeckNumber node : part().nodes)
      around_.points.push_back(deck_point(deck_, node));
    around_.in_space = in_space_;
    around_.unit = units_.length;
  }

  /// Beams, springs, masses and what else is not part of a body.
  void note_elements_left_out() {
    std::map<std::string, std::pair<std::size_t, DeckNumber>> by_type;
    for (const auto& [number, element] : deck_.elements)
      if (!has_faces(element))
        ++by_type.try_emplace(element.type, 0, number).first->second.first;
    for (const auto& [type, found] : by_type)
      remark(fmt::format("*ELEMENT, TYPE={}: left out, {} elements from number {}", type,
                         found.first, found.second));
  }

  void note_other_materials() {
    const auto is_other = [&](DeckNumber element) {
      const auto found = deck_.material_of.find(element);
      return found == deck_.material_of.end() || found->second != part().material;
    };
    const auto n = std::count_if(part().elements.begin(), part().elements.end(), is_other);
    if (n > 0 && !part().material.empty())
      remark(
          fmt::format("{} elements of the workpiece are of another material, or of none: all are "
                      "of {}",
                      n, part().material));
  }

  [[nodiscard]] const DeckBody& part() const { return bodies_[workpiece_]; }
  [[nodiscard]] int dimension() const { return in_space_ ? 3 : 2; }

  /// A deck without a heading has the name of its file as the title.
  [[nodiscard]] std::string head(const std::string& name) const {
    return fmt::format("title = {}\nunits = \"{}\"\nanalysis = \"{}\"\n{}\n[workpiece]\nelement = "
                       "\"{}\"\nmaterial = \"workpiece\"\nmesh = {{ file = \"part.inp\" }}\n\n",
                       toml_text(std::string_view(deck_.title.empty() ? name : deck_.title)),
                       units_.system,
                       in_space_       ? "3d"
                       : axisymmetric_ ? "axisymmetric"
                                       : "plane-strain",
                       temperature_text(), mesh_.element);
  }

  [[nodiscard]] std::string temperature_text() const {
    const DeckMaterial* const material = material_of(deck_, part());
    if (material == nullptr || !material->johnson_cook || !material->johnson_cook->temperatures)
      return "";
    return fmt::format("temperature = {:.10g}\n", (*material->johnson_cook->temperatures)[0]);
  }

  std::string material_text() {
    const DeckMaterial* const material = material_of(deck_, part());
    if (material == nullptr || !material->elastic) {
      remark("the workpiece has no *ELASTIC: its material is missing in the case");
      return "[material.workpiece] # missing in the deck\n\n";
    }
    std::string text =
        fmt::format("[material.workpiece] # {}\nelastic = {{ young = {:.10g}, "
                    "poisson = {:.10g} }}\n",
                    plain_name(material->name), (*material->elastic)[0], (*material->elastic)[1]);
    if (material->johnson_cook)
      text += johnson_cook_text(*material->johnson_cook);
    else if (material->plastic.size() == 1)
      text += fmt::format("flow = {{ law = \"perfect\", yield = {:.10g} }}\n",
                          material->plastic.front().second);
    else if (!material->plastic.empty())
      text +=
          fmt::format("flow = {{ law = \"table\", points = {} }}\n", toml_text(material->plastic));
    if (material->density)
      text += fmt::format("density = {:.10g}\n", *material->density);
    return text + "\n";
  }

  /// Without temperatures the law is Ludwik's.
  std::string johnson_cook_text(const DeckJohnsonCook& law) {
    if (!law.temperatures) {
      if (law.rate)
        remark("the Johnson-Cook law has no temperatures: its dependence on the rate is left out",
               law.place);
      return fmt::format(
          "flow = {{ law = \"ludwik\", yield = {:.10g}, K = {:.10g}, n = {:.10g} }}\n", law.A,
          law.B, law.n);
    }
    const auto& [room, melting] = *law.temperatures;
    const auto [C, rate0] = law.rate.value_or(std::array{0.0, 1.0});
    remark(fmt::format("the workpiece has the temperature {:g}, at which the Johnson-Cook law has "
                       "its full strength: set `temperature` if the deck begins at another",
                       room),
           law.place);
    return fmt::format(
        "flow = {{ law = \"johnson-cook\", A = {:.10g}, B = {:.10g}, n = {:.10g}, C = "
        "{:.10g}, rate0 = {:.10g}, m = {:.10g}, T_room = {:.10g}, T_melt = {:.10g} "
        "}}\n",
        law.A, law.B, law.n, C, rate0, law.m, room, melting);
  }

  // --- supports and loads ------------------------------------------------------------------------

  std::string supports_text() {
    return DeckSupports(deck_, part(), motions_, dimension()).text(sets_);
  }

  std::string loads_text() {
    const DeckMaterial* const material = material_of(deck_, part());
    return DeckForces(deck_, part(), mesh_, {in_space_, axisymmetric_})
        .text(material == nullptr ? std::nullopt : material->density, sets_);
  }

  /// Whether what is prescribed of a node can move anything: the workpiece or a tool.
  [[nodiscard]] bool moves_something(DeckNumber node) const {
    return std::any_of(bodies_.begin(), bodies_.end(),
                       [&](const DeckBody& body) { return body.nodes.contains(node); }) ||
           std::any_of(deck_.rigid_bodies.begin(), deck_.rigid_bodies.end(),
                       [&](const DeckRigidBody& rigid) {
                         return rigid.reference == node || rigid.rotation == node;
                       });
  }

  void note_unused_motions() {
    for (const auto& [target, motion] : motions_) {
      std::vector<DeckNumber> nodes = deck_.nodes_of(target);
      std::erase_if(nodes, [&](DeckNumber node) { return !deck_.nodes.contains(node); });
      if (!nodes.empty() && std::none_of(nodes.begin(), nodes.end(),
                                         [&](DeckNumber node) { return moves_something(node); }))
        remark(fmt::format("*BOUNDARY on {}: its nodes belong to no body, left out", target),
               motion.place);
    }
  }

  void note_unused_forces() {
    for (const auto& [target, force] : forces_)
      if (!tool_motions_->uses_force_on(target))
        remark(fmt::format("*CLOAD on {}: a case has no forces on single nodes, left out", target),
               force.place);
  }

  // --- tools -------------------------------------------------------------------------------------

  std::string tools_text() {
    std::string text;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (i != workpiece_)
        text += body_tool(bodies_[i]);
    for (const DeckRigidBody& rigid : deck_.rigid_bodies)
      if (const auto surface = deck_.surfaces.find(in_capitals(rigid.surface));
          !rigid.surface.empty() && surface != deck_.surfaces.end())
        text += profile_tool(rigid, surface->second);
    return text;
  }

  /// The motion of a body: that of its reference node, or of all nodes that something holds.
  DeckMotion motion_of(const DeckBody& body) {
    if (body.rigid != nullptr)
      return motion_of_node(deck_, motions_, body.rigid->reference);
    DeckMotion motion;
    for (const auto& [target, one] : motions_) {
      const std::vector<DeckNumber> nodes = deck_.nodes_of(target);
      if (std::none_of(nodes.begin(), nodes.end(),
                       [&](DeckNumber node) { return body.nodes.contains(node); }))
        continue;
      for (const auto& [component, history] : one.components) {
        DeckHistory& own = motion.components[component];
        if (!own.empty() && own != history && !is_zero(own) && !is_zero(history))
          remark(fmt::format("nodes of {} move in different ways: as a rigid tool it goes with the "
                             "last of them",
                             body.name),
                 one.place);
        if (own.empty() || !is_zero(history))
          own = history;
      }
      motion.place = one.place;
    }
    return motion;
  }

  std::string body_tool(const DeckBody& body) {
    const std::string name = tool_name(body.name);
    const std::optional<DeckInteraction> pair = interaction_with(body);
    if (!pair) {
      remark(
          fmt::format("the body {} is in no contact pair with the workpiece: left out", body.name));
      return "";
    }
    if (in_space_ && body.two_sided)
      remark(fmt::format("the body {} is in contact with both of its sides: the tool has the side "
                         "SPOS only",
                         body.name));
    const DeckMaterial* const material = material_of(deck_, body);
    if (body.rigid == nullptr)
      remark(fmt::format("the body {} becomes a rigid tool{}", body.name,
                         material != nullptr && material->is_plastic()
                             ? ": it is plastic in the deck, its own deformation is lost"
                             : ": in the deck it is elastic"));
    return tool_text(name, surface_of_body(deck_, body, name, around_), motion_of(body), *pair,
                     body.rigid);
  }

  std::string profile_tool(const DeckRigidBody& rigid, const DeckSurface& surface) {
    const std::string name = tool_name(surface.name);
    const auto pair =
        std::find_if(deck_.pairs.begin(), deck_.pairs.end(), [&](const DeckPair& one) {
          return one.master == in_capitals(surface.name) || one.slave == in_capitals(surface.name);
        });
    if (pair == deck_.pairs.end())
      remark(fmt::format("the surface {} is in no contact pair: it is a tool without friction",
                         surface.name),
             surface.place);
    return tool_text(name, surface_of_profile(surface, name, around_),
                     motion_of_node(deck_, motions_, rigid.reference),
                     pair == deck_.pairs.end() ? DeckInteraction{} : interaction_of(*pair), &rigid);
  }

  /// One that is not there is without friction, and said already.
  [[nodiscard]] DeckInteraction interaction_of(const DeckPair& pair) const {
    const auto found = deck_.interactions.find(pair.interaction);
    return found == deck_.interactions.end() ? DeckInteraction{} : found->second;
  }

  std::string tool_name(const std::string& wish) {
    std::string name = plain_name(wish);
    while (!tool_names_.insert(name).second)
      name += "-2";
    return name;
  }

  std::string tool_text(const std::string& name,
                        DeckToolSurface surface,
                        const DeckMotion& motion,
                        const DeckInteraction& pair,
                        const DeckRigidBody* rigid) {
    for (const std::string& text : surface.remarks)
      remark(fmt::format("tool {}: {}", name, text));
    if (surface.text.empty()) {
      remark(fmt::format("tool {}: left out", name));
      return "";
    }
    for (DeckFile& file : surface.files)
      files_.push_back(std::move(file));
    std::string text = fmt::format("[[tool]]\nname = \"{}\"\nsurface = {}\n", name, surface.text);
    text += tool_motions_->text(name, motion, rigid);
    if (pair.rough)
      text += "friction = { law = \"sticking\" }\n";
    else if (pair.mu > 0.0)
      text += fmt::format("friction = {{ law = \"coulomb\", mu = {:.10g}{} }}\n", pair.mu,
                          pair.largest_shear ? fmt::format(", cap = {:.10g}", *pair.largest_shear)
                                             : "");
    return text + "\n";
  }

  /// How the workpiece and a body touch, if a contact pair says so.
  [[nodiscard]] std::optional<DeckInteraction> interaction_with(const DeckBody& body) const {
    for (const DeckPair& pair : deck_.pairs)
      if ((touches(pair.slave, body) && touches(pair.master, part())) ||
          (touches(pair.master, body) && touches(pair.slave, part())))
        return interaction_of(pair);
    return std::nullopt;
  }

  [[nodiscard]] bool touches(const std::string& surface, const DeckBody& body) const {
    const auto found = deck_.surfaces.find(surface);
    if (found == deck_.surfaces.end())
      return false;
    for (const auto& [set, label] : found->second.members) {
      const bool of_nodes = found->second.type == "NODE";
      const std::vector<DeckNumber> members =
          of_nodes ? deck_.nodes_of(set) : deck_.elements_of(set);
      if (!members.empty() && (of_nodes ? body.nodes.contains(members.front())
                                        : std::binary_search(body.elements.begin(),
                                                             body.elements.end(), members.front())))
        return true;
    }
    return false;
  }

  /// The outline of a mesh that was linear has corners, which tools meet first: more points of a
  /// face are near them.
  [[nodiscard]] std::string contact_text() const {
    return mesh_.added.empty() ? "" : "[contact]\nform = \"compatible\"\n\n";
  }

  // --- time, mesh, remarks -----------------------------------------------------------------------

  std::string time_text() {
    if (deck_.steps.empty())
      remark("the deck has no *STEP: the case ends at time 1, and what the deck prescribes is "
             "reached evenly until then");
    std::string text = fmt::format("[time]\nend = {:.10g}\n", end_of(deck_));
    double most = HUGE_VAL;
    for (const DeckStep& step : deck_.steps)
      if (step.most && *step.most < step.period)
        most = std::min(most, *step.most);
      else if (step.direct && step.first)
        most = std::min(most, *step.first);
    if (std::isfinite(most))
      text += fmt::format("increments = {{ max = {:.10g} }}\n", most);
    return text;
  }

  std::string mesh_text() {
    std::string text = "*NODE\n";
    for (const auto& [node, p] : mesh_.nodes)
      text += fmt::format("{}, {:.17g}, {:.17g}, {:.17g}\n", node, p[0], p[1], p[2]);
    text += fmt::format("*ELEMENT, TYPE={}\n", mesh_.type);
    for (const auto& [number, nodes] : mesh_.elements)
      text += numbers_text({number}, nodes);
    for (const auto& [name, nodes] : sets_)
      text += fmt::format("*NSET, NSET={}\n{}", name, numbers_text({}, mesh_.set_of(nodes)));
    return text;
  }

  static std::string numbers_text(std::vector<DeckNumber> numbers,
                                  const std::vector<DeckNumber>& more) {
    constexpr std::size_t a_line = 16;
    numbers.insert(numbers.end(), more.begin(), more.end());
    std::string text;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      text += fmt::format("{}{}", numbers[i],
                          i + 1 == numbers.size() ? "\n"
                          : (i + 1) % a_line == 0 ? ",\n"
                                                  : ", ");
    return text;
  }

  [[nodiscard]] std::string remarks_text(const std::string& name) const {
    std::string text =
        fmt::format("# From {} by billet import; its numbers were taken to be in {}{}.\n", name,
                    units_.name, units_.is_of_case() ? "" : ", and are converted");
    if (!deck_.remarks.empty())
      text += "#\n# Left out, or otherwise than in the deck:\n";
    for (const DeckRemark& one : deck_.remarks)
      text += fmt::format("# - {}{}{}\n", one.place, one.place.empty() ? "" : ": ", one.text);
    return text + "\n";
  }

  Deck& deck_;
  const DeckUnits& units_;
  std::vector<DeckBody> bodies_;
  std::size_t workpiece_ = bodies_.size() + 1;
  bool in_space_ = false;
  bool axisymmetric_ = false;
  DeckMesh mesh_;
  DeckSurroundings around_;
  std::map<std::string, DeckMotion> motions_, forces_;
  std::optional<DeckToolMotions> tool_motions_;
  std::map<std::string, std::vector<DeckNumber>> sets_; ///< of the mesh
  std::set<std::string> tool_names_;
  std::vector<DeckFile> files_;
};

} // namespace

DeckCase case_of(Deck deck, const DeckUnits& units, const std::string& name) {
  to_units_of_case(deck, units);
  return CaseMaker(deck, units).make(name);
}

} // namespace billet::io
