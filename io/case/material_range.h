// Whether metal is where the data of its flow law are.

#pragma once

#include "io/case/case.h"
#include "mechanics/bulk/bulk.h"

#include <optional>
#include <string>

namespace billet::io {

/// A warning where the temperature of the case lies outside the data of a library's flow law.
///
/// @param temperature  of the workpiece at the start [degC]
[[nodiscard]] std::optional<std::string> outside_range(const Material& material,
                                                       double temperature);

/// A warning where more than a twentieth of the part has been strained or heated beyond the data of
/// a library's flow law or of a table.
[[nodiscard]] std::optional<std::string> left_range(const Material& material,
                                                    const mechanics::Bulk& bulk);

} // namespace billet::io
