// Keywords of a deck, one function each.

#include "geometry/base/error.h"
#include "io/deck/deck.h"
#include "io/deck/deck_lines.h"
#include "io/deck/deck_names.h"
#include "io/deck/read_amplitude.h"
#include "io/deck/read_loads.h"
#include "io/deck/read_materials.h"
#include "io/mesh/scanner.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

namespace billet::io {

namespace {

/// Requests of output and settings of the solver: of no use here.
constexpr std::array without_effect{
    "HEADING",       "PREPRINT",     "RESTART",       "OUTPUT",          "NODEOUTPUT",
    "ELEMENTOUTPUT", "NODEFILE",     "NODEPRINT",     "ELFILE",          "ELPRINT",
    "CONTACTFILE",   "CONTACTPRINT", "CONTACTOUTPUT", "ENERGYOUTPUT",    "ENDSTEP",
    "TIMEPOINTS",    "CONTROLS",     "MONITOR",       "FILEFORMAT",      "FILEOUTPUT",
    "SECTIONPRINT",  "NOANALYSIS",   "INCLUDE",       "SURFACEBEHAVIOR", "SECTIONCONTROLS"};

bool is_whole(const std::string& text) {
  std::int64_t value = 0;
  return parse_integer(text, value);
}

class DeckReader {
public:
  explicit DeckReader(Deck& deck) : deck_(deck) {}

  void take(const DeckKeyword& keyword) {
    struct Handler {
      const char* name;
      void (DeckReader::*read)(const DeckKeyword&);
    };
    static constexpr std::array handlers{
        Handler{"NODE", &DeckReader::nodes},
        Handler{"ELEMENT", &DeckReader::elements},
        Handler{"NSET", &DeckReader::set},
        Handler{"ELSET", &DeckReader::set},
        Handler{"SOLIDSECTION", &DeckReader::section},
        Handler{"SHELLSECTION", &DeckReader::section},
        Handler{"AMPLITUDE", &DeckReader::amplitude},
        Handler{"SURFACE", &DeckReader::surface},
        Handler{"RIGIDSURFACE", &DeckReader::surface},
        Handler{"RIGIDBODY", &DeckReader::rigid_body},
        Handler{"SURFACEINTERACTION", &DeckReader::interaction},
        Handler{"FRICTION", &DeckReader::friction},
        Handler{"CONTACTPAIR", &DeckReader::pair},
        Handler{"STEP", &DeckReader::step},
        Handler{"STATIC", &DeckReader::static_step},
        Handler{"PART", &DeckReader::refuse_parts},
        Handler{"INSTANCE", &DeckReader::refuse_parts},
    };
    if (keyword.name == "HEADING" && deck_.title.empty() && !keyword.data.empty())
      deck_.title = fmt::format("{}", fmt::join(keyword.data.front(), ", "));
    if (materials_.take(keyword) || loads_.take(keyword))
      return;
    for (const Handler& handler : handlers)
      if (keyword.name == handler.name)
        return (this->*handler.read)(keyword);
    if (std::find(without_effect.begin(), without_effect.end(), keyword.name) ==
        without_effect.end())
      remark(keyword, "not understood, and left out");
  }

  /// Looks for what lines name, when all are read.
  void finish() {
    require_nodes(deck_, awaited_);
    require_reference_nodes();
    note_missing(deck_, references_.all());
    note_missing_members(deck_, DeckThing::nodes, places_of_node_sets_);
    note_missing_members(deck_, DeckThing::elements, places_of_element_sets_);
    for (const Section& section : sections_)
      for (const DeckNumber element : deck_.elements_of(section.elements))
        deck_.material_of[element] = in_capitals(section.material);
    loads_.finish();
  }

private:
  struct Section {
    std::string elements, material;
  };

  /// A node that a rigid body names, by number or as a set.
  struct ReferenceNode {
    std::size_t body; ///< in deck_.rigid_bodies
    bool rotation;
    std::string name, keyword, place;
  };

  void remark(const DeckKeyword& keyword, const std::string& what) { note(deck_, keyword, what); }

  /// A set, which a keyword makes or adds to.
  std::vector<DeckNumber>& named(DeckSets& sets, const DeckKeyword& keyword) {
    const bool of_nodes = &sets == &deck_.node_sets;
    const std::string name = keyword.value(of_nodes ? "NSET" : "ELSET"), key = in_capitals(name);
    if (name.empty())
      throw Error(Fault::geometry, keyword.place,
                  fmt::format("*{}: the set has no name", keyword.written),
                  of_nodes ? "write NSET=name" : "write ELSET=name");
    deck_.names.try_emplace(key, name);
    (of_nodes ? places_of_node_sets_ : places_of_element_sets_).try_emplace(key, keyword.place);
    return sets[key];
  }

  void refuse_parts(const DeckKeyword& keyword) {
    throw Error(Fault::geometry, keyword.place,
                fmt::format("*{}: decks with parts and instances are not read", keyword.written),
                "write the deck flat; in Abaqus/CAE: Model, Edit Attributes, do not use parts and "
                "assemblies in input files");
  }

  // --- mesh --------------------------------------------------------------------------------------

  void nodes(const DeckKeyword& keyword) {
    if (!keyword.value("SYSTEM").empty() && in_capitals(keyword.value("SYSTEM")) != "R")
      throw Error(Fault::geometry, keyword.place, "nodes in other than rectangular coordinates",
                  "write all nodes with x, y, z");
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      Vec3 point = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        point[static_cast<Eigen::Index>(i)] = keyword.number(line, i + 1).value_or(0.0);
      const DeckNumber number = keyword.whole(line, 0);
      deck_.nodes[number] = point;
      if (keyword.has("NSET"))
        named(deck_.node_sets, keyword).push_back(number);
    }
  }

  /// Elements go on over several lines; a line that ends with a comma is followed by more.
  void elements(const DeckKeyword& keyword) {
    const std::string type = in_capitals(keyword.value("TYPE"));
    const std::size_t n_nodes = nodes_of_type(type);
    std::vector<DeckNumber> numbers;
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      for (std::size_t i = 0; i < keyword.data[line].size(); ++i)
        numbers.push_back(keyword.whole(line, i));
      if (n_nodes != 0 && numbers.size() < n_nodes + 1)
        continue;
      if (n_nodes != 0 && numbers.size() > n_nodes + 1)
        throw Error(Fault::geometry, keyword.places[line],
                    fmt::format("element {} has more than the {} nodes of {}", numbers.front(),
                                n_nodes, type));
      if (numbers.empty())
        continue;
      add_element(keyword, line, {type, {numbers.begin() + 1, numbers.end()}}, numbers.front());
      numbers.clear();
    }
    if (!numbers.empty())
      throw Error(
          Fault::geometry, keyword.places.back(),
          fmt::format("the last element has only {} of {} nodes", numbers.size() - 1, n_nodes));
  }

  void add_element(const DeckKeyword& keyword,
                   std::size_t line,
                   DeckElement element,
                   DeckNumber number) {
    const bool may_lack = element.type.starts_with("D"); // of networks: 0 where there is no node
    for (const DeckNumber node : element.nodes)
      if (!deck_.nodes.contains(node) && !(may_lack && node == 0))
        awaited_.push_back({number, node, keyword.places[line]});
    deck_.elements[number] = std::move(element);
    if (keyword.has("ELSET"))
      named(deck_.element_sets, keyword).push_back(number);
  }

  /// The number at the end of the letters; 0: not known, an element takes one line.
  static std::size_t nodes_of_type(const std::string& type) {
    for (const std::string_view family : {"C3D", "CPE", "CPS", "CAX", "R3D", "M3D", "RAX", "S"})
      if (type.starts_with(family)) {
        const std::string digits = type.substr(family.size());
        std::int64_t n = 0;
        if (parse_integer(digits.substr(0, digits.find_first_not_of("0123456789")), n))
          return static_cast<std::size_t>(n);
      }
    return 0;
  }

  void set(const DeckKeyword& keyword) {
    const bool of_nodes = keyword.name == "NSET";
    DeckSets& sets = of_nodes ? deck_.node_sets : deck_.element_sets;
    std::vector<DeckNumber> members;
    if (of_nodes && keyword.has("ELSET"))
      nodes_of_elements(keyword, members);
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      if (keyword.has("GENERATE")) {
        generate(keyword, line, members);
        continue;
      }
      for (std::size_t i = 0; i < keyword.data[line].size(); ++i) {
        if (is_whole(keyword.field(line, i))) {
          members.push_back(keyword.whole(line, i));
          continue;
        }
        const auto other = sets.find(in_capitals(keyword.field(line, i)));
        if (other == sets.end())
          throw Error(Fault::geometry, keyword.places[line],
                      fmt::format("\"{}\" is neither a number nor a set given before",
                                  keyword.field(line, i).substr(0, 40)));
        members.insert(members.end(), other->second.begin(), other->second.end());
      }
    }
    std::vector<DeckNumber>& own = named(sets, keyword);
    own.insert(own.end(), members.begin(), members.end());
  }

  /// *NSET, ELSET=...: every node of the elements once.
  void nodes_of_elements(const DeckKeyword& keyword, std::vector<DeckNumber>& members) {
    const auto elements = deck_.element_sets.find(in_capitals(keyword.value("ELSET")));
    if (elements == deck_.element_sets.end())
      throw Error(Fault::geometry, keyword.place,
                  fmt::format("*{}: ELSET={} is no set given before", keyword.written,
                              keyword.value("ELSET").substr(0, 80)));
    std::set<DeckNumber> nodes;
    for (const DeckNumber number : elements->second)
      if (const auto element = deck_.elements.find(number); element != deck_.elements.end())
        nodes.insert(element->second.nodes.begin(), element->second.nodes.end());
    members.insert(members.end(), nodes.begin(), nodes.end());
  }

  void generate(const DeckKeyword& keyword, std::size_t line, std::vector<DeckNumber>& members) {
    const DeckNumber first = keyword.whole(line, 0), last = keyword.whole(line, 1);
    const DeckNumber step = keyword.field(line, 2).empty() ? 1 : keyword.whole(line, 2);
    constexpr DeckNumber most = 50'000'000;
    if (step < 1 || last < first || (last - first) / step > most)
      throw Error(Fault::geometry, keyword.places[line], "a set that cannot be: first, last, step");
    for (DeckNumber number = first; number <= last; number += step)
      members.push_back(number);
  }

  // --- sections and amplitudes -------------------------------------------------------------------

  void section(const DeckKeyword& keyword) {
    references_.add(DeckThing::elements, keyword.value("ELSET"), keyword);
    references_.add(DeckThing::material, keyword.value("MATERIAL"), keyword);
    sections_.push_back({keyword.value("ELSET"), keyword.value("MATERIAL")});
    if (const auto thickness = keyword.number(0, 0); thickness && keyword.name == "SOLIDSECTION")
      deck_.thickness = *thickness;
  }

  void amplitude(const DeckKeyword& keyword) { read_amplitude(deck_, keyword); }

  // --- contact -----------------------------------------------------------------------------------

  void surface(const DeckKeyword& keyword) {
    const std::string name = keyword.value("NAME");
    DeckSurface& surface = deck_.surfaces[in_capitals(name)];
    surface = DeckSurface{name, keyword.word("TYPE"), {}, {}, {}, keyword.place};
    if (surface.type.empty())
      surface.type = "ELEMENT";
    const bool is_analytical = surface.type != "ELEMENT" && surface.type != "NODE";
    if (is_analytical && keyword.has("FILLETRADIUS"))
      remark(keyword, "the fillet radius is left out: corners of the profile stay sharp");
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      if (!is_analytical) {
        references_.add(surface.type == "NODE" ? DeckThing::nodes : DeckThing::elements, keyword,
                        line, 0);
        surface.members.emplace_back(keyword.field(line, 0), in_capitals(keyword.field(line, 1)));
        continue;
      }
      const std::string word = in_capitals(keyword.field(line, 0));
      const bool is_curve = !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
      std::vector<double> numbers;
      for (std::size_t i = is_curve ? 1 : 0; i < keyword.data[line].size(); ++i)
        numbers.push_back(keyword.number(line, i).value_or(0.0));
      if (is_curve)
        surface.curves.push_back({word, numbers});
      else
        surface.frame.insert(surface.frame.end(), numbers.begin(), numbers.end());
    }
    if (keyword.name == "RIGIDSURFACE" && keyword.has("REFNODE"))
      rigid_body_of_surface(name, keyword);
  }

  void rigid_body_of_surface(const std::string& name, const DeckKeyword& keyword) {
    DeckRigidBody body;
    body.surface = name;
    body.place = keyword.place;
    add_rigid_body(body, keyword);
  }

  void rigid_body(const DeckKeyword& keyword) {
    DeckRigidBody body;
    body.nodes = keyword.value("NSET");
    body.elements = keyword.value("ELSET");
    body.surface = keyword.value("ANALYTICALSURFACE");
    body.place = keyword.place;
    if (!body.nodes.empty())
      references_.add(DeckThing::nodes, body.nodes, keyword);
    if (!body.elements.empty())
      references_.add(DeckThing::elements, body.elements, keyword);
    if (!body.surface.empty())
      references_.add(DeckThing::surface, body.surface, keyword);
    if (keyword.has("PINNSET") || keyword.has("TIENSET"))
      remark(keyword, "PIN NSET and TIE NSET are not understood, and left out");
    add_rigid_body(body, keyword);
  }

  void add_rigid_body(const DeckRigidBody& body, const DeckKeyword& keyword) {
    deck_.rigid_bodies.push_back(body);
    for (const bool rotation : {false, true})
      if (const std::string name = keyword.value(rotation ? "ROTNODE" : "REFNODE"); !name.empty())
        reference_nodes_.push_back(
            {deck_.rigid_bodies.size() - 1, rotation, name, keyword.written, keyword.place});
  }

  /// A rigid body names its nodes by number, or as a set of which it takes the first.
  void require_reference_nodes() {
    for (const ReferenceNode& one : reference_nodes_) {
      const std::vector<DeckNumber> nodes = deck_.nodes_of(one.name);
      if (nodes.empty() || !deck_.nodes.contains(nodes.front()))
        throw Error(Fault::geometry, one.place,
                    fmt::format("*{}: {} NODE={} is not there", one.keyword,
                                one.rotation ? "ROT" : "REF", one.name.substr(0, 80)),
                    "name a node, or a set of one node");
      DeckRigidBody& body = deck_.rigid_bodies[one.body];
      (one.rotation ? body.rotation : body.reference) = nodes.front();
    }
  }

  void interaction(const DeckKeyword& keyword) {
    interaction_ = in_capitals(keyword.value("NAME"));
    deck_.interactions[interaction_] = {};
  }

  void friction(const DeckKeyword& keyword) {
    if (!deck_.interactions.contains(interaction_))
      return remark(keyword, "before the first *SURFACE INTERACTION, left out");
    if (!deck_.steps.empty())
      return remark(keyword, "a friction that changes in a step is not understood, and left out");
    DeckInteraction& interaction = deck_.interactions[interaction_];
    interaction.rough = keyword.has("ROUGH");
    interaction.mu = keyword.number(0, 0).value_or(0.0);
    if (!interaction.rough && (keyword.has("USER") || !keyword.number(0, 0)))
      remark(keyword, "without a coefficient: contact is without friction");
    double most = 0.0;
    if (parse_real(keyword.value("TAUMAX"), most) && most > 0.0)
      interaction.largest_shear = most;
    else if (keyword.has("TAUMAX"))
      remark(keyword, fmt::format("TAUMAX={} is not a positive number, left out",
                                  keyword.value("TAUMAX").substr(0, 30)));
    if (keyword.has("EXPONENTIALDECAY"))
      remark(keyword, fmt::format("EXPONENTIAL DECAY is not available: the static coefficient {:g} "
                                  "is taken for all speeds of sliding",
                                  interaction.mu));
    else if (keyword.data.size() > 1 || keyword.has("ANISOTROPIC"))
      remark(keyword, "the first coefficient is taken, the others are left out");
  }

  void pair(const DeckKeyword& keyword) {
    references_.add(DeckThing::interaction, keyword.value("INTERACTION"), keyword);
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      for (const std::size_t i : {0U, 1U})
        if (i == 0 || !keyword.field(line, i).empty()) // contact of a surface with itself
          references_.add(DeckThing::surface, keyword, line, i);
      deck_.pairs.push_back({in_capitals(keyword.value("INTERACTION")),
                             in_capitals(keyword.field(line, 0)),
                             in_capitals(keyword.field(line, 1)), keyword.places[line]});
    }
  }

  // --- steps -------------------------------------------------------------------------------------

  void step(const DeckKeyword& keyword) {
    DeckStep step;
    step.large_strain = keyword.has("NLGEOM") && keyword.word("NLGEOM") != "NO";
    step.steps_at_once = keyword.word("AMPLITUDE") == "STEP";
    deck_.steps.push_back(step);
    if (!step.large_strain && deck_.steps.size() == 1)
      remark(keyword, "without NLGEOM: strains are finite here all the same");
  }

  void static_step(const DeckKeyword& keyword) {
    if (deck_.steps.empty())
      return remark(keyword, "before the first *STEP");
    DeckStep& step = deck_.steps.back();
    step.direct = keyword.has("DIRECT");
    step.first = keyword.number(0, 0);
    step.period = keyword.number(0, 1).value_or(1.0);
    step.most = keyword.number(0, 3);
    if (!(step.period > 0.0))
      throw Error(Fault::geometry, keyword.place, "a step takes more than no time");
  }

  Deck& deck_;
  DeckReferences references_;
  DeckMaterials materials_{deck_};
  DeckLoads loads_{deck_, references_};
  std::string interaction_; ///< that *FRICTION belongs to
  std::vector<DeckElementNode> awaited_;
  std::vector<Section> sections_;
  std::vector<ReferenceNode> reference_nodes_;
  std::map<std::string, std::string> places_of_node_sets_, places_of_element_sets_;
};

std::vector<DeckNumber> members_of(const DeckSets& sets, const std::string& target) {
  const auto found = sets.find(in_capitals(target));
  return found == sets.end() ? std::vector<DeckNumber>() : found->second;
}

} // namespace

std::vector<DeckNumber> Deck::nodes_of(const std::string& target) const {
  std::int64_t number = 0;
  return parse_integer(target, number) ? std::vector<DeckNumber>{number}
                                       : members_of(node_sets, target);
}

std::vector<DeckNumber> Deck::elements_of(const std::string& target) const {
  std::int64_t number = 0;
  return parse_integer(target, number) ? std::vector<DeckNumber>{number}
                                       : members_of(element_sets, target);
}

Deck read_deck(const std::filesystem::path& file, const IncludeBounds& bounds) {
  Deck deck;
  DeckReader reader(deck);
  DeckLines lines(file, bounds);
  while (const std::optional<DeckKeyword> keyword = lines.next())
    reader.take(*keyword);
  if (deck.nodes.empty() || deck.elements.empty())
    throw Error(Fault::geometry, file.string(), "the deck has no nodes or no elements",
                "is it an input file of CalculiX or Abaqus?");
  reader.finish();
  return deck;
}

} // namespace billet::io
