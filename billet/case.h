// A case in memory: what a case file says, with changes, always one that can be read.
//
//     billet::Case forging = billet::Case::load("case.toml");
//     forging.set("tool.punch.friction.m", "0.2");
//     billet::Run run(forging);
//
// Keys and values are those of `billet run --set KEY=VALUE`. Included by billet/run.h.

#pragma once

#if __cplusplus < 202002L
#error "billet/case.h needs C++20: compile with -std=c++20"
#endif

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace billet {

/// What cannot be run, and why: every complaint on a line of its own, with file, line, key and
/// remedy.
class RunError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// What `billet check` says of a case that can be run.
struct CaseReport {
  std::vector<std::string> warnings; ///< of what is legal and hardly ever meant
  std::vector<std::string> advice;   ///< on what it could do without, or leaves out
};

/// A case file's text and changes to it.
///
/// A change that the reader of case files refuses is not made: a case can always be run.
class Case {
public:
  /// Reads a case file.
  /// @param file           its name, relative to the current folder
  /// @param overrides      changes to begin with, "key=value"
  /// @param allow_outside  the case may name files outside of its folder
  /// @throws RunError
  [[nodiscard]] static Case load(const std::filesystem::path& file,
                                 const std::vector<std::string>& overrides = {},
                                 bool allow_outside = false);
  /// The same of a text.
  /// @param text           of a case file
  /// @param folder         that paths in the text are relative to
  /// @param allow_outside  the case may name files outside of that folder
  /// @throws RunError
  [[nodiscard]] static Case from_text(std::string text,
                                      const std::filesystem::path& folder = ".",
                                      bool allow_outside = false);
  ~Case();
  /// Both may be changed then.
  Case(const Case& other);
  /// As by copying.
  Case& operator=(const Case& other);
  /// A case that has been moved from may only be assigned to or destroyed.
  Case(Case&& other) noexcept;
  /// As by moving.
  Case& operator=(Case&& other) noexcept;

  /// Changes a value, or adds it.
  /// @param key    dotted; a tool or a stage by its name, another list item by its index
  /// @param value  as TOML; text that is no TOML stands for itself
  /// @throws RunError if the case could not be read with it; then it is as before
  void set(std::string_view key, std::string_view value);
  /// Several changes at once, "key=value", which make sense together only.
  /// @throws RunError as `set`
  void set(const std::vector<std::string>& assignments);
  /// Removes a value, a table or a list item.
  /// @throws RunError as `set`
  void erase(std::string_view key);

  /// As a case file: the text that was read, or, once it has been changed, the same without
  /// comments.
  [[nodiscard]] std::string text() const;
  /// As a case file with every default filled in, as case.resolved.toml of results.
  [[nodiscard]] std::string resolved_text() const;
  /// Writes `text` to a file, from which it can be read again.
  /// @throws RunError  also if the files that the case names are not to be found from there
  void save(const std::filesystem::path& file) const;

  /// What messages call it: the case file.
  [[nodiscard]] const std::string& name() const;
  /// Folder that paths in the case are relative to.
  [[nodiscard]] const std::filesystem::path& folder() const;

  /// Builds the scene, as `billet check` does, and says what it thinks of it.
  /// @throws RunError
  [[nodiscard]] CaseReport check() const;

private:
  friend class Run;
  struct Inside;
  explicit Case(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

} // namespace billet
