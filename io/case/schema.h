// A shape as JSON Schema (draft 2020-12): what editors check and complete TOML files by.

#pragma once

#include "io/case/shape.h"

#include <string>
#include <string_view>

namespace billet::io {

/// The text of a schema.
///
/// @param title  what the files are, for people
[[nodiscard]] std::string json_schema(const Shape& shape, std::string_view title);

} // namespace billet::io
