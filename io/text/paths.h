// Where files that a user names may lie.

#pragma once

#include <filesystem>

namespace billet::io {

/// Whether `path` lies in `folder` or below, links followed.
[[nodiscard]] bool is_inside(const std::filesystem::path& path,
                             const std::filesystem::path& folder);

} // namespace billet::io
