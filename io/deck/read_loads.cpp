#include "io/deck/read_loads.h"

#include "geometry/base/error.h"
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace billet::io {

namespace {

/// Components, first and last, that a name of a support holds; none: it is no such name.
std::vector<std::pair<int, int>> named_support(const std::string& word) {
  static const std::map<std::string, std::vector<std::pair<int, int>>> supports{
      {"XSYMM", {{1, 1}}},    {"YSYMM", {{2, 2}}},          {"ZSYMM", {{3, 3}}},
      {"XASYMM", {{2, 3}}},   {"YASYMM", {{1, 1}, {3, 3}}}, {"ZASYMM", {{1, 2}}},
      {"ENCASTRE", {{1, 3}}}, {"PINNED", {{1, 3}}},
  };
  const auto found = supports.find(word);
  return found == supports.end() ? std::vector<std::pair<int, int>>() : found->second;
}

/// Along an axis, per volume.
bool is_body_force(const std::string& label) {
  return label == "BX" || label == "BY" || label == "BZ" || label == "BR";
}

} // namespace

bool DeckLoads::take(const DeckKeyword& keyword) {
  struct Reader {
    const char* name;
    void (DeckLoads::*read)(const DeckKeyword&);
  };
  static constexpr std::array readers{
      Reader{"BOUNDARY", &DeckLoads::boundary},
      Reader{"CLOAD", &DeckLoads::forces},
      Reader{"DLOAD", &DeckLoads::pressures},
      Reader{"DSLOAD", &DeckLoads::pressures},
  };
  for (const Reader& reader : readers)
    if (keyword.name == reader.name) {
      (this->*reader.read)(keyword);
      return true;
    }
  return false;
}

DeckStep& DeckLoads::now() { return deck_.steps.empty() ? deck_.initial : deck_.steps.back(); }

void DeckLoads::refer_to_amplitude(const DeckKeyword& keyword) {
  if (keyword.has("AMPLITUDE"))
    references_.add(DeckThing::amplitude, keyword.value("AMPLITUDE"), keyword);
}

void DeckLoads::boundary(const DeckKeyword& keyword) {
  if (keyword.word("OP") == "NEW")
    now().replaces_boundary = true;
  if (keyword.word("TYPE") == "ACCELERATION" || keyword.has("FIXED") || keyword.has("SUBMODEL"))
    return note(deck_, keyword, "this form is not understood, and left out");
  refer_to_amplitude(keyword);
  for (std::size_t line = 0; line < keyword.data.size(); ++line) {
    references_.add(DeckThing::nodes, keyword, line, 0);
    DeckCondition condition{keyword.field(line, 0),
                            1,
                            1,
                            0.0,
                            keyword.value("AMPLITUDE"),
                            keyword.word("TYPE") == "VELOCITY",
                            keyword.places[line]};
    const auto held = named_support(in_capitals(keyword.field(line, 1)));
    for (const auto& [first, last] : held) {
      condition.first = first;
      condition.last = last;
      now().boundary.push_back(condition);
    }
    if (held.empty())
      boundary_by_number(keyword, line, condition);
  }
}

void DeckLoads::boundary_by_number(const DeckKeyword& keyword,
                                   std::size_t line,
                                   DeckCondition condition) {
  const DeckNumber first = keyword.whole(line, 1);
  const DeckNumber last = keyword.field(line, 2).empty() ? first : keyword.whole(line, 2);
  if (first < 0 || last < first)
    throw Error(Fault::geometry, keyword.places[line],
                fmt::format("*{}: degrees of freedom from {} to {}", keyword.written, first, last),
                "they are 1 to 6, the first not above the last");
  if (first == 0 || last > 6)
    deck_.remarks.push_back(
        {keyword.places[line], fmt::format("*{}: no displacement or rotation (a degree of freedom "
                                           "other than 1 to 6), left out",
                                           keyword.written)});
  if (first > 6 || last == 0)
    return;
  condition.first = static_cast<int>(std::max<DeckNumber>(first, 1));
  condition.last = static_cast<int>(std::min<DeckNumber>(last, 6));
  condition.value = keyword.number(line, 3).value_or(0.0);
  now().boundary.push_back(condition);
}

void DeckLoads::forces(const DeckKeyword& keyword) {
  if (keyword.word("OP") == "NEW")
    now().replaces_forces = true;
  refer_to_amplitude(keyword);
  for (std::size_t line = 0; line < keyword.data.size(); ++line) {
    references_.add(DeckThing::nodes, keyword, line, 0);
    const DeckNumber component = keyword.whole(line, 1);
    if (component < 1 || component > 3) {
      deck_.remarks.push_back(
          {keyword.places[line], fmt::format("*{}: no force along an axis (degree of freedom {}), "
                                             "left out",
                                             keyword.written, component)});
      continue;
    }
    const int axis = static_cast<int>(component);
    now().forces.push_back({keyword.field(line, 0), axis, axis,
                            keyword.number(line, 2).value_or(0.0), keyword.value("AMPLITUDE"),
                            false, keyword.places[line]});
  }
}

void DeckLoads::pressures(const DeckKeyword& keyword) {
  if (keyword.word("OP") == "NEW")
    now().replaces_pressures = true;
  refer_to_amplitude(keyword);
  bool has_gravity = false, has_body_force = false, has_traction = false;
  for (std::size_t line = 0; line < keyword.data.size(); ++line) {
    const std::string label = in_capitals(keyword.field(line, 1));
    DeckPressure pressure{"",
                          "",
                          "",
                          keyword.number(line, 2).value_or(0.0),
                          keyword.value("AMPLITUDE"),
                          keyword.places[line]};
    const bool on_surface = keyword.name == "DSLOAD";
    const std::string kind = on_surface ? label : label.substr(0, label.size() - 1);
    if (label == "GRAV") {
      has_gravity = true;
      gravity(keyword, line);
    } else if (!on_surface && is_body_force(label)) {
      has_body_force = true;
      body_force(keyword, line, label);
    } else if (kind == "P" || (kind == "TRVEC" && !keyword.has("ORIENTATION"))) {
      references_.add(on_surface ? DeckThing::surface : DeckThing::elements, keyword, line, 0);
      (on_surface ? pressure.surface : pressure.elements) = keyword.field(line, 0);
      pressure.face = on_surface ? "" : "S" + label.substr(label.size() - 1);
      if (kind == "P")
        now().pressures.push_back(pressure);
      else
        has_traction = traction(keyword, line, pressure) || has_traction;
    } else {
      deck_.remarks.push_back(
          {keyword.places[line],
           fmt::format("*{}: a load {} is not understood, and left out", keyword.written, label)});
    }
  }
  if (keyword.word("OP") == "NEW" && deck_.gravity && !has_gravity)
    note(deck_, keyword, "OP=NEW: gravity acts to the end here");
  if (keyword.word("OP") == "NEW" && !deck_.body_forces.empty() && !has_body_force)
    note(deck_, keyword, "OP=NEW: body forces act to the end here");
  if (has_traction &&
      (keyword.word("FOLLOWER") != "NO" || keyword.word("CONSTANTRESULTANT") != "YES"))
    note(deck_, keyword,
         "TRVEC: the traction keeps its direction, and its force on the area of the part as it was "
         "at the start (FOLLOWER=NO, CONSTANT RESULTANT=YES)");
}

bool DeckLoads::traction(const DeckKeyword& keyword, std::size_t line, DeckPressure given) {
  Vec3 direction = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    direction[static_cast<Eigen::Index>(i)] = keyword.number(line, 3 + i).value_or(0.0);
  if (direction.isZero()) {
    deck_.remarks.push_back(
        {keyword.places[line],
         fmt::format("*{}: TRVEC without a direction, left out", keyword.written)});
    return false;
  }
  direction.normalize();
  for (int i = 0; i < 3; ++i) {
    given.component = i + 1;
    given.share = direction[i];
    now().pressures.push_back(given);
  }
  return true;
}

void DeckLoads::body_force(const DeckKeyword& keyword, std::size_t line, const std::string& label) {
  references_.add(DeckThing::elements, keyword, line, 0);
  const DeckBodyForce force{keyword.number(line, 2).value_or(0.0), keyword.field(line, 0),
                            keyword.value("AMPLITUDE"), deck_.steps.size(), keyword.places[line]};
  const auto [known, is_first] = deck_.body_forces.try_emplace(label, force);
  if (!is_first && (known->second.value != force.value ||
                    in_capitals(known->second.elements) != in_capitals(force.elements)))
    deck_.remarks.push_back(
        {force.place, fmt::format("*{}: {} is another than at {}: that one "
                                  "acts all the time",
                                  keyword.written, label, known->second.place)});
}

void DeckLoads::gravity(const DeckKeyword& keyword, std::size_t line) {
  if (!keyword.field(line, 0).empty())
    references_.add(DeckThing::elements, keyword, line, 0);
  const auto number = [&](std::size_t i) { return keyword.number(line, i).value_or(0.0); };
  const DeckGravity gravity{number(2),
                            {number(3), number(4), number(5)},
                            keyword.field(line, 0),
                            keyword.value("AMPLITUDE"),
                            deck_.steps.size(),
                            keyword.places[line]};
  if (!deck_.gravity) {
    deck_.gravity = gravity;
  } else if (deck_.gravity->value != gravity.value ||
             deck_.gravity->direction != gravity.direction) {
    deck_.remarks.push_back({gravity.place, fmt::format("*{}: gravity is another than at {}: "
                                                        "that one acts all the time",
                                                        keyword.written, deck_.gravity->place)});
  }
}

void DeckLoads::finish() {
  if (deck_.steps.empty())
    return;
  for (const DeckCondition& force : deck_.initial.forces)
    deck_.remarks.push_back({force.place, "*CLOAD: before the first *STEP, left out"});
  for (const DeckPressure& pressure : deck_.initial.pressures)
    deck_.remarks.push_back({pressure.place, "a pressure before the first *STEP, left out"});
}

} // namespace billet::io
