// What a deck of CalculiX or Abaqus says, by its own numbers and names, before a case is made of
// it.
//
// Names are kept as written, and found whatever their case. What is not understood is a remark,
// with the file and the line of its keyword; nothing is passed over in silence but requests of
// output.

#pragma once

#include "geometry/base/vector.h"
#include "io/mesh/included_lines.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace billet::io {

using DeckNumber = std::int64_t; ///< of a node or an element

struct DeckRemark {
  std::string place; ///< "job.inp:12"; empty: of the deck as a whole
  std::string text;
};

struct DeckElement {
  std::string type; ///< in capitals: "C3D8R"
  std::vector<DeckNumber> nodes;
};

using DeckSets = std::map<std::string, std::vector<DeckNumber>>; ///< by name in capitals

/// *PLASTIC, HARDENING=JOHNSON COOK, with *RATE DEPENDENT, TYPE=JOHNSON COOK.
struct DeckJohnsonCook {
  double A = 0.0, B = 0.0, n = 0.0, m = 0.0;
  std::optional<std::array<double, 2>> temperatures; ///< of full strength, of melting
  std::optional<std::array<double, 2>> rate;         ///< C, the rate of reference
  std::string place;
};

struct DeckMaterial {
  std::string name;
  std::optional<std::array<double, 2>> elastic;   ///< young, poisson
  std::vector<std::pair<double, double>> plastic; ///< strain, stress
  std::optional<DeckJohnsonCook> johnson_cook;    ///< in place of the table
  std::optional<double> density;

  [[nodiscard]] bool is_plastic() const { return !plastic.empty() || johnson_cook.has_value(); }
};

struct DeckAmplitude {
  std::vector<std::pair<double, double>> points; ///< time, factor; at least one, times increase
  bool total_time = false;                       ///< times of the run, not of a step
  bool absolute = false; ///< factors are the values themselves, whatever a line that names it says
};

/// A displacement, or a force, of a node or a set.
struct DeckCondition {
  std::string target; ///< a set, or the number of a node
  int first = 1;      ///< components, 1 to 6
  int last = 1;
  double value = 0.0;
  std::string amplitude;
  bool velocity = false;
  std::string place;
  double unit = 1.0; ///< factor on it to the units of the case
};

/// A pressure on a surface, or on faces of elements; or one component of a traction.
struct DeckPressure {
  std::string surface; ///< name of a surface; empty: faces of elements
  std::string elements;
  std::string face; ///< "S1"
  double value = 0.0;
  std::string amplitude;
  std::string place;
  int component = 0;  ///< of a traction, 1 to 3; 0: a pressure
  double share = 1.0; ///< of the value in that component
  double unit = 1.0;  ///< factor on it to the units of the case
};

/// A force per volume along an axis: "BX", "BY", "BZ" or, along the radius, "BR".
struct DeckBodyForce {
  double value = 0.0;
  std::string elements; ///< a set or a number
  std::string amplitude;
  std::size_t step = 0; ///< the one that begins it, from 1; 0: none
  std::string place;
};

struct DeckGravity {
  double value = 0.0;
  Vec3 direction = Vec3::Zero();
  std::string elements; ///< a set or a number; empty: all
  std::string amplitude;
  std::size_t step = 0; ///< the one that begins it, from 1; 0: none
  std::string place;
};

/// "START", "LINE", "CIRCL" or "PARAB" with its numbers.
struct DeckCurve {
  std::string word;
  std::vector<double> numbers;
};

struct DeckSurface {
  std::string name;
  std::string type; ///< "ELEMENT", "NODE", "SEGMENTS", "CYLINDER", "REVOLUTION"
  std::vector<std::pair<std::string, std::string>> members; ///< set or number, face
  std::vector<double> frame;                                ///< of an analytical one
  std::vector<DeckCurve> curves;
  std::string place;
};

struct DeckRigidBody {
  std::string nodes, elements, surface; ///< names of sets and of an analytical surface
  DeckNumber reference = 0;             ///< node that it moves with; 0: none
  DeckNumber rotation = 0;              ///< node whose displacement is the rotation; 0: none
  std::string place;
};

struct DeckInteraction {
  double mu = 0.0;
  std::optional<double> largest_shear;
  bool rough = false;
};

struct DeckPair {
  std::string interaction, slave, master; ///< in capitals
  std::string place;
};

struct DeckStep {
  double period = 1.0;
  std::optional<double> first, most; ///< increments
  bool direct = false;
  bool large_strain = false;
  bool steps_at_once = false; ///< loads are there at once, *STEP, AMPLITUDE=STEP
  bool replaces_boundary = false, replaces_forces = false, replaces_pressures = false;
  std::vector<DeckCondition> boundary, forces;
  std::vector<DeckPressure> pressures;
};

/// What `read_deck` makes: the nodes of all elements are there, and those that a rigid body names.
struct Deck {
  std::string title;
  std::map<DeckNumber, Vec3> nodes;
  std::map<DeckNumber, DeckElement> elements;
  DeckSets node_sets, element_sets;
  std::map<std::string, std::string> names; ///< of sets, as written
  std::map<std::string, DeckMaterial> materials;
  std::map<DeckNumber, std::string> material_of; ///< of elements, in capitals
  std::optional<double> thickness;               ///< of a solid section
  std::map<std::string, DeckAmplitude> amplitudes;
  std::map<std::string, DeckSurface> surfaces;
  std::vector<DeckRigidBody> rigid_bodies;
  std::map<std::string, DeckInteraction> interactions;
  std::vector<DeckPair> pairs;
  DeckStep initial; ///< conditions before the first step
  std::vector<DeckStep> steps;
  std::optional<DeckGravity> gravity;
  std::map<std::string, DeckBodyForce> body_forces; ///< by label
  std::vector<DeckRemark> remarks;

  /// The nodes of a set, or the one of a number; empty: there are none.
  [[nodiscard]] std::vector<DeckNumber> nodes_of(const std::string& target) const;
  [[nodiscard]] std::vector<DeckNumber> elements_of(const std::string& target) const;
};

/// @throws Error (Fault::geometry) at "file:line" for what cannot be a deck
[[nodiscard]] Deck read_deck(const std::filesystem::path& file, const IncludeBounds& bounds);

} // namespace billet::io
