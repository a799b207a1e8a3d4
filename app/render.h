// The program billet-render, which is in the same folder as this one and draws.

#pragma once

#include "app/command_line.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/conduct.h"

namespace billet::app {

/// This program.
[[nodiscard]] std::filesystem::path own_file();

/// How the runs of a study are made by this program, results in a folder.
[[nodiscard]] study::Conduct conduct_of(const Arguments& arguments,
                                        const std::filesystem::path& folder);

/// Draws a chart, as `billet render` does; what goes wrong is said, and stops nothing.
void draw_curves(const std::vector<std::string>& arguments,
                 const std::function<void(const std::string&)>& say);

} // namespace billet::app
