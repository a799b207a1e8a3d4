// Which tools act: a stage's choice, one flag a tool. Tools that act may be made to stand still.

#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace billet::contact {

class ToolActivity {
public:
  ToolActivity() = default;
  explicit ToolActivity(std::size_t n_tools)
      : enabled_(n_tools, 1), held_(n_tools, 0), rests_(n_tools, 0) {}

  /// Tools that may act now, one flag a tool.
  void enable(std::vector<char> enabled) { enabled_ = std::move(enabled); }
  /// Whether a tool that a force drives stays where it is, whatever acts on it.
  void hold(std::size_t tool, bool held) { held_[tool] = held ? 1 : 0; }
  /// Whether a tool neither travels nor turns, whatever acts on it and whatever drives it.
  void rest(std::size_t tool, bool rests) { rests_[tool] = rests ? 1 : 0; }
  /// As on the mesh before; what rests there does not rest here.
  void go_on_from(const ToolActivity& before) {
    enabled_ = before.enabled_;
    held_ = before.held_;
  }

  [[nodiscard]] bool enabled(std::size_t tool) const { return enabled_[tool] != 0; }
  [[nodiscard]] bool held(std::size_t tool) const { return held_[tool] != 0; }
  [[nodiscard]] bool rests(std::size_t tool) const { return rests_[tool] != 0; }

  template <class Archive> void fields(Archive& archive) { archive(enabled_, held_, rests_); }

private:
  std::vector<char> enabled_, held_, rests_;
};

} // namespace billet::contact
