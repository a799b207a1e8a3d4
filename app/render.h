// The program billet-render, which stands beside this one and draws.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace billet::app {

/// This program.
[[nodiscard]] std::filesystem::path own_file();

/// Draws a chart, as `billet render` does; what goes wrong is said, and stops nothing.
void draw_curves(const std::vector<std::string>& arguments,
                 const std::function<void(const std::string&)>& say);

} // namespace billet::app
