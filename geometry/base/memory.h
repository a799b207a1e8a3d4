// Memory that this program may still take.

#pragma once

#include <optional>

namespace billet {

/// What the machine has left, or the group of processes that this one belongs to, whichever is less
/// [byte]; none where the system does not tell.
[[nodiscard]] std::optional<double> available_memory();

} // namespace billet
