#include "io/translate/deck_units.h"

#include <algorithm>

namespace billet::io {

namespace {

constexpr double inch = 25.4;                   // [mm]
constexpr double pound_force = 4.4482216152605; // exact by definition [N]

void convert_material(DeckMaterial& material, const DeckUnits& units) {
  const double length = units.length_factor;
  const double stress = units.force_factor / (length * length);
  if (material.elastic)
    (*material.elastic)[0] *= stress;
  for (auto& [strain, yield] : material.plastic)
    yield *= stress;
  if (material.density)
    *material.density *= stress / (length * length);
  if (!material.johnson_cook)
    return;
  material.johnson_cook->A *= stress;
  material.johnson_cook->B *= stress;
  if (units.fahrenheit && material.johnson_cook->temperatures)
    for (double& temperature : *material.johnson_cook->temperatures)
      temperature = (temperature - 32.0) / 1.8;
}

void convert_step(DeckStep& step, const DeckUnits& units) {
  const double length = units.length_factor;
  for (DeckCondition& one : step.boundary)
    one.unit = length;
  for (DeckCondition& one : step.forces)
    one.unit = units.force_factor;
  for (DeckPressure& one : step.pressures)
    one.unit = units.force_factor / (length * length);
}

/// Whether a condition moves the ROT NODE of a rigid body: its displacements are angles.
bool turns(const Deck& deck, const DeckCondition& one) {
  const std::vector<DeckNumber> nodes = deck.nodes_of(one.target);
  return !nodes.empty() && std::all_of(nodes.begin(), nodes.end(), [&](DeckNumber node) {
    return std::any_of(deck.rigid_bodies.begin(), deck.rigid_bodies.end(),
                       [&](const DeckRigidBody& body) { return body.rotation == node; });
  });
}

void convert_surface(DeckSurface& surface, double length) {
  for (double& number : surface.frame)
    number *= length;
  for (DeckCurve& curve : surface.curves)
    for (double& number : curve.numbers)
      number *= length;
}

} // namespace

const std::vector<DeckUnits>& deck_units() {
  static const std::vector<DeckUnits> all{
      {"mm-t-s-N", "mm-N-s-MPa-degC", "mm"},
      {"m-kg-s-N", "m-N-s-Pa-degC", "m"},
      {"in-lbf-s-psi", "mm-N-s-MPa-degC", "mm", inch, pound_force, true}};
  return all;
}

void to_units_of_case(Deck& deck, const DeckUnits& units) {
  if (units.is_of_case())
    return;
  const double length = units.length_factor, force = units.force_factor;
  for (auto& [number, point] : deck.nodes)
    point *= length;
  for (auto& [name, material] : deck.materials)
    convert_material(material, units);
  if (deck.thickness)
    *deck.thickness *= length;
  for (auto& [name, surface] : deck.surfaces)
    convert_surface(surface, length);
  for (auto& [name, interaction] : deck.interactions)
    if (interaction.largest_shear)
      *interaction.largest_shear *= force / (length * length);
  convert_step(deck.initial, units);
  for (DeckStep& step : deck.steps) {
    convert_step(step, units);
    for (DeckCondition& one : step.boundary)
      if (turns(deck, one))
        one.unit = 1.0;
  }
  if (deck.gravity)
    deck.gravity->value *= length;
  for (auto& [label, one] : deck.body_forces)
    one.value *= force / (length * length * length);
}

} // namespace billet::io
