// The ends of the part along the axes, and what holds them; a detail of io/advice.

#pragma once

#include "process/scene/scene.h"

#include <optional>
#include <vector>

namespace billet::io {

/// Which end of the part along an axis.
enum class End { low, high };

/// Nodes on an end, to 1e-6 of the part's size.
[[nodiscard]] std::vector<mechanics::Index> nodes_at(const process::Part& part, int axis, End end);

/// How the nodes of an end are held in a component.
///
/// @return the displacement that a support gives to all of them; null: some have none, or they
///         differ
[[nodiscard]] const TimeFunction*
hold_of(const process::Part& part, int axis, End end, int component);

/// Whether all nodes of an end rest in its normal, and may slide along it: a plane of symmetry, or
/// a plate without friction.
[[nodiscard]] bool is_mirror(const process::Part& part, int axis, End end);

/// Whether a displacement is zero at all times.
[[nodiscard]] bool rests(const TimeFunction& displacement);

/// Whether one function is `factor` times another.
[[nodiscard]] bool is_multiple(const TimeFunction& a, const TimeFunction& b, double factor);

} // namespace billet::io
