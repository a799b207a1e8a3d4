// A chart as a picture in SVG: what is shown without JavaScript, and printed.

#pragma once

#include "app/report/curves.h"

#include <string>

namespace billet::report {

[[nodiscard]] std::string svg_of(const NamedChart& named);

} // namespace billet::report
