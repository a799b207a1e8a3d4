// TOML text of what a study file holds.

#pragma once

#include "io/case/document.h"

#include <string>

namespace billet::study {

/// A value, a list or a table on one line, as `--set` takes it.
[[nodiscard]] std::string toml_text(const io::Node& node);

} // namespace billet::study
