// The style sheet of the page; `web/src/report.css` has that of the view and the curves.

#pragma once

#include <string_view>

namespace billet::report {

extern const std::string_view page_style;

} // namespace billet::report
