// Keywords of a deck, one function each.

#include "geometry/base/error.h"
#include "io/deck/deck.h"
#include "io/deck/deck_lines.h"
#include "io/mesh/scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

DeckNumber whole(const DeckKeyword& keyword, std::size_t line, std::size_t i) {
  std::int64_t value = 0;
  if (!parse_integer(keyword.field(line, i), value))
    throw Error(Fault::geometry, keyword.places[line],
                fmt::format("\"{}\" is not a whole number", keyword.field(line, i).substr(0, 30)));
  return value;
}

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
        Handler{"MATERIAL", &DeckReader::material},
        Handler{"ELASTIC", &DeckReader::elastic},
        Handler{"PLASTIC", &DeckReader::plastic},
        Handler{"DENSITY", &DeckReader::density},
        Handler{"SOLIDSECTION", &DeckReader::section},
        Handler{"SHELLSECTION", &DeckReader::section},
        Handler{"AMPLITUDE", &DeckReader::amplitude},
        Handler{"BOUNDARY", &DeckReader::boundary},
        Handler{"CLOAD", &DeckReader::forces},
        Handler{"DLOAD", &DeckReader::pressures},
        Handler{"DSLOAD", &DeckReader::pressures},
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
    for (const Handler& handler : handlers)
      if (keyword.name == handler.name)
        return (this->*handler.read)(keyword);
    if (std::find(without_effect.begin(), without_effect.end(), keyword.name) ==
        without_effect.end())
      remark(keyword, "not understood, and left out");
  }

private:
  void remark(const DeckKeyword& keyword, const std::string& what) {
    deck_.remarks.push_back({keyword.place, fmt::format("*{}: {}", keyword.name, what)});
  }

  [[nodiscard]] DeckStep& now() { return deck_.steps.empty() ? deck_.initial : deck_.steps.back(); }

  std::vector<DeckNumber>& named(DeckSets& sets, const std::string& name) {
    deck_.names.try_emplace(in_capitals(name), name);
    return sets[in_capitals(name)];
  }

  void refuse_parts(const DeckKeyword& keyword) {
    throw Error(Fault::geometry, keyword.place,
                fmt::format("*{}: decks with parts and instances are not read", keyword.name),
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
      const DeckNumber number = whole(keyword, line, 0);
      deck_.nodes[number] = point;
      if (keyword.has("NSET"))
        named(deck_.node_sets, keyword.value("NSET")).push_back(number);
    }
  }

  /// Elements go on over several lines; a line that ends with a comma is followed by more.
  void elements(const DeckKeyword& keyword) {
    const std::string type = in_capitals(keyword.value("TYPE"));
    const std::size_t n_nodes = nodes_of_type(type);
    std::vector<DeckNumber> numbers;
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      for (std::size_t i = 0; i < keyword.data[line].size(); ++i)
        numbers.push_back(whole(keyword, line, i));
      if (n_nodes != 0 && numbers.size() < n_nodes + 1)
        continue;
      if (n_nodes != 0 && numbers.size() > n_nodes + 1)
        throw Error(Fault::geometry, keyword.places[line],
                    fmt::format("element {} has more than the {} nodes of {}", numbers.front(),
                                n_nodes, type));
      const DeckNumber number = numbers.front();
      deck_.elements[number] = {type, {numbers.begin() + 1, numbers.end()}};
      if (keyword.has("ELSET"))
        named(deck_.element_sets, keyword.value("ELSET")).push_back(number);
      numbers.clear();
    }
    if (!numbers.empty())
      throw Error(
          Fault::geometry, keyword.places.back(),
          fmt::format("the last element has only {} of {} nodes", numbers.size() - 1, n_nodes));
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
    const std::string name = keyword.value(of_nodes ? "NSET" : "ELSET");
    DeckSets& sets = of_nodes ? deck_.node_sets : deck_.element_sets;
    std::vector<DeckNumber> members;
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      if (keyword.has("GENERATE")) {
        generate(keyword, line, members);
        continue;
      }
      for (std::size_t i = 0; i < keyword.data[line].size(); ++i) {
        if (is_whole(keyword.field(line, i))) {
          members.push_back(whole(keyword, line, i));
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
    std::vector<DeckNumber>& own = named(sets, name);
    own.insert(own.end(), members.begin(), members.end());
  }

  void generate(const DeckKeyword& keyword, std::size_t line, std::vector<DeckNumber>& members) {
    const DeckNumber first = whole(keyword, line, 0), last = whole(keyword, line, 1);
    const DeckNumber step = keyword.field(line, 2).empty() ? 1 : whole(keyword, line, 2);
    constexpr DeckNumber most = 50'000'000;
    if (step < 1 || last < first || (last - first) / step > most)
      throw Error(Fault::geometry, keyword.places[line], "a set that cannot be: first, last, step");
    for (DeckNumber number = first; number <= last; number += step)
      members.push_back(number);
  }

  // --- materials ---------------------------------------------------------------------------------

  void material(const DeckKeyword& keyword) {
    material_ = in_capitals(keyword.value("NAME"));
    deck_.materials[material_].name = keyword.value("NAME");
  }

  void elastic(const DeckKeyword& keyword) {
    const std::string type = in_capitals(keyword.value("TYPE"));
    if (!type.empty() && type != "ISO" && type != "ISOTROPIC")
      return remark(keyword,
                    fmt::format("TYPE={} is not available: elasticity is isotropic", type));
    const auto young = keyword.number(0, 0), poisson = keyword.number(0, 1);
    if (!young)
      return remark(keyword, "without a modulus");
    deck_.materials[material_].elastic = {*young, poisson.value_or(0.0)};
    if (keyword.data.size() > 1)
      remark(keyword, fmt::format("the values of the first temperature are taken, {} more are left "
                                  "out",
                                  keyword.data.size() - 1));
  }

  void plastic(const DeckKeyword& keyword) {
    const std::string hardening = in_capitals(keyword.value("HARDENING"));
    if (!hardening.empty() && hardening != "ISOTROPIC")
      remark(keyword, fmt::format("HARDENING={} is taken as isotropic", hardening));
    DeckMaterial& material = deck_.materials[material_];
    const std::string temperature = keyword.field(0, 2);
    std::size_t others = 0;
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      if (keyword.field(line, 2) != temperature) {
        ++others;
        continue;
      }
      const double strain = keyword.number(line, 1).value_or(0.0);
      const double stress = keyword.number(line, 0).value_or(0.0);
      if (material.plastic.empty() || strain > material.plastic.back().first)
        material.plastic.emplace_back(strain, stress);
    }
    if (others > 0)
      remark(keyword,
             fmt::format("the curve of temperature {} is taken, {} rows of others are left "
                         "out",
                         temperature.empty() ? "0" : temperature, others));
  }

  void density(const DeckKeyword& keyword) {
    deck_.materials[material_].density = keyword.number(0, 0);
  }

  void section(const DeckKeyword& keyword) {
    for (const DeckNumber element : deck_.elements_of(keyword.value("ELSET")))
      deck_.material_of[element] = in_capitals(keyword.value("MATERIAL"));
    if (const auto thickness = keyword.number(0, 0); thickness && keyword.name == "SOLIDSECTION")
      deck_.thickness = *thickness;
  }

  // --- loads -------------------------------------------------------------------------------------

  void amplitude(const DeckKeyword& keyword) {
    DeckAmplitude& amplitude = deck_.amplitudes[in_capitals(keyword.value("NAME"))];
    amplitude.total_time = in_capitals(keyword.value("TIME")).starts_with("TOTAL");
    std::vector<double> numbers;
    for (std::size_t line = 0; line < keyword.data.size(); ++line)
      for (std::size_t i = 0; i < keyword.data[line].size(); ++i)
        if (const auto number = keyword.number(line, i))
          numbers.push_back(*number);
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
      amplitude.points.emplace_back(numbers[i], numbers[i + 1]);
    if (const std::string kind = in_capitals(keyword.value("DEFINITION"));
        !kind.empty() && kind != "TABULAR")
      remark(keyword, fmt::format("DEFINITION={} is taken as a table", kind));
  }

  /// Names for several components at once.
  static bool named_support(const std::string& word, DeckCondition& condition) {
    constexpr std::array<std::pair<const char*, int>, 3> planes{
        {{"XSYMM", 1}, {"YSYMM", 2}, {"ZSYMM", 3}}};
    for (const auto& [name, component] : planes)
      if (word == name)
        condition.first = condition.last = component;
    if (word == "ENCASTRE" || word == "PINNED")
      condition.last = 3;
    return word.ends_with("SYMM") || word == "ENCASTRE" || word == "PINNED";
  }

  void boundary(const DeckKeyword& keyword) {
    if (in_capitals(keyword.value("OP")) == "NEW") {
      now().replaces_boundary = true;
      now().boundary.clear();
    }
    const std::string type = in_capitals(keyword.value("TYPE"));
    if (type == "ACCELERATION" || keyword.has("FIXED") || keyword.has("SUBMODEL"))
      return remark(keyword, "this form is not understood, and left out");
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      DeckCondition condition{
          keyword.field(line, 0), 1, 1, 0.0, keyword.value("AMPLITUDE"), type == "VELOCITY",
          keyword.places[line]};
      if (!named_support(in_capitals(keyword.field(line, 1)), condition)) {
        condition.first = static_cast<int>(whole(keyword, line, 1));
        condition.last = keyword.field(line, 2).empty() ? condition.first
                                                        : static_cast<int>(whole(keyword, line, 2));
        condition.value = keyword.number(line, 3).value_or(0.0);
      }
      if (condition.first > 6)
        deck_.remarks.push_back({condition.place, "*BOUNDARY: no displacement or rotation (degree "
                                                  "of freedom above 6), left out"});
      else
        now().boundary.push_back(condition);
    }
  }

  void forces(const DeckKeyword& keyword) {
    if (in_capitals(keyword.value("OP")) == "NEW")
      now().replaces_forces = true;
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      const int component = static_cast<int>(whole(keyword, line, 1));
      now().forces.push_back({keyword.field(line, 0), component, component,
                              keyword.number(line, 2).value_or(0.0), keyword.value("AMPLITUDE"),
                              false, keyword.places[line]});
    }
  }

  void pressures(const DeckKeyword& keyword) {
    if (in_capitals(keyword.value("OP")) == "NEW")
      now().replaces_pressures = true;
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      const std::string label = in_capitals(keyword.field(line, 1));
      const double value = keyword.number(line, 2).value_or(0.0);
      DeckPressure pressure{"", "", "", value, keyword.value("AMPLITUDE"), keyword.places[line]};
      if (label == "GRAV") {
        deck_.gravity = DeckGravity{value,
                                    {keyword.number(line, 3).value_or(0.0),
                                     keyword.number(line, 4).value_or(0.0),
                                     keyword.number(line, 5).value_or(0.0)}};
      } else if (keyword.name == "DSLOAD" && label == "P") {
        pressure.surface = keyword.field(line, 0);
        now().pressures.push_back(pressure);
      } else if (keyword.name == "DLOAD" && label.size() == 2 && label[0] == 'P') {
        pressure.elements = keyword.field(line, 0);
        pressure.face = "S" + label.substr(1);
        now().pressures.push_back(pressure);
      } else {
        deck_.remarks.push_back(
            {keyword.places[line],
             fmt::format("*{}: a load {} is not understood, and left out", keyword.name, label)});
      }
    }
  }

  // --- contact -----------------------------------------------------------------------------------

  void surface(const DeckKeyword& keyword) {
    const std::string name = keyword.value("NAME");
    DeckSurface& surface = deck_.surfaces[in_capitals(name)];
    surface = DeckSurface{name, in_capitals(keyword.value("TYPE")), {}, {}, {}, keyword.place};
    if (surface.type.empty())
      surface.type = "ELEMENT";
    const bool is_analytical = surface.type != "ELEMENT" && surface.type != "NODE";
    if (is_analytical && keyword.has("FILLETRADIUS"))
      remark(keyword, "the fillet radius is left out: corners of the profile stay sharp");
    for (std::size_t line = 0; line < keyword.data.size(); ++line) {
      if (!is_analytical) {
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
    body.reference = reference_node(keyword, "REFNODE");
    body.place = keyword.place;
    deck_.rigid_bodies.push_back(body);
  }

  /// A node by its number, or the one of a set.
  DeckNumber reference_node(const DeckKeyword& keyword, const char* parameter) {
    const std::vector<DeckNumber> nodes = deck_.nodes_of(keyword.value(parameter));
    return nodes.empty() ? 0 : nodes.front();
  }

  void rigid_body(const DeckKeyword& keyword) {
    DeckRigidBody body;
    body.nodes = keyword.value("NSET");
    body.elements = keyword.value("ELSET");
    body.surface = keyword.value("ANALYTICALSURFACE");
    body.reference = reference_node(keyword, "REFNODE");
    body.rotation = reference_node(keyword, "ROTNODE");
    body.place = keyword.place;
    deck_.rigid_bodies.push_back(body);
  }

  void interaction(const DeckKeyword& keyword) {
    interaction_ = in_capitals(keyword.value("NAME"));
    deck_.interactions[interaction_] = {};
  }

  void friction(const DeckKeyword& keyword) {
    DeckInteraction& interaction = deck_.interactions[interaction_];
    interaction.rough = keyword.has("ROUGH");
    interaction.mu = keyword.number(0, 0).value_or(0.0);
    double most = 0.0;
    if (parse_real(keyword.value("TAUMAX"), most) && most > 0.0)
      interaction.largest_shear = most;
    if (keyword.data.size() > 1)
      remark(keyword, "the first coefficient is taken, the others are left out");
  }

  void pair(const DeckKeyword& keyword) {
    for (std::size_t line = 0; line < keyword.data.size(); ++line)
      deck_.pairs.push_back({in_capitals(keyword.value("INTERACTION")),
                             in_capitals(keyword.field(line, 0)),
                             in_capitals(keyword.field(line, 1))});
  }

  // --- steps -------------------------------------------------------------------------------------

  void step(const DeckKeyword& keyword) {
    DeckStep step;
    const std::string large = in_capitals(keyword.value("NLGEOM"));
    step.large_strain = keyword.has("NLGEOM") && large != "NO";
    step.steps_at_once = in_capitals(keyword.value("AMPLITUDE")) == "STEP";
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
  std::string material_;
  std::string interaction_;
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
  return deck;
}

} // namespace billet::io
