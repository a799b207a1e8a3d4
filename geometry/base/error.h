// What is reported to the user when a run cannot go on through no fault of the program.
//
// One exception type, thrown where a mistake of the user (case file, mesh, STL, disk) is found and
// caught once, in app/. It carries any number of complaints so that all errors of a file are
// reported together. Numerical non-success is not an error: see outcome.h.

#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace billet {

/// What went wrong; the value is the program's exit status.
enum class Fault {
  usage = 2,         ///< command line
  case_file = 3,     ///< case file: missing, unreadable, wrong keys or values
  geometry = 4,      ///< mesh, STL or tool geometry
  not_converged = 5, ///< an increment could not be solved
  input_output = 6,  ///< file system
  limit = 7,         ///< memory or another limit
  failed_check = 8,  ///< a run has come to its end with a result that fails a check
};

/// Codes of complaints, each with an entry of `billet explain`.
namespace error_code {
inline constexpr std::string_view usage = "usage";             // the command line
inline constexpr std::string_view toml_syntax = "toml-syntax"; // the text of a case
inline constexpr std::string_view key_unknown = "key-unknown";
inline constexpr std::string_view key_missing = "key-missing";
inline constexpr std::string_view value_refused = "value-refused"; // of one key
inline constexpr std::string_view case_refused = "case-refused";   // of the case as a whole
inline constexpr std::string_view mesh_file = "mesh-file";         // its text
inline constexpr std::string_view mesh_elements = "mesh-elements"; // what it holds
inline constexpr std::string_view surface_file = "surface-file";   // STL or STEP
inline constexpr std::string_view geometry = "geometry";           // anything else of shapes
inline constexpr std::string_view results_unreadable = "results-unreadable";
inline constexpr std::string_view no_checkpoint = "no-checkpoint";
inline constexpr std::string_view folder_in_use = "folder-in-use";
inline constexpr std::string_view not_written = "not-written";
inline constexpr std::string_view file = "file";   // anything else of files
inline constexpr std::string_view limit = "limit"; // memory or another one
} // namespace error_code

/// One thing that is wrong, with everything needed to repair it.
struct Complaint {
  std::string place;       ///< "file:line:column", "file:line", "file" or empty
  std::string message;     ///< the key or item, what was found, what is allowed
  std::string remedy;      ///< what to do ("did you mean ...?"); may be empty
  std::string_view code{}; ///< for `billet explain`; empty: that of the error's fault

  [[nodiscard]] std::string text() const;
};

/// The general code of a kind of fault.
[[nodiscard]] std::string_view code_of(Fault fault);

/// Thrown for a user's mistake; `what()` holds all complaints, one per line, each with its code.
class Error : public std::exception {
public:
  Error(Fault fault, std::vector<Complaint> complaints);
  /// @param code  one of `error_code`; empty: that of the fault
  Error(Fault fault,
        std::string place,
        std::string message,
        std::string remedy = {},
        std::string_view code = {});

  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }
  [[nodiscard]] Fault fault() const noexcept { return fault_; }
  [[nodiscard]] const std::vector<Complaint>& complaints() const noexcept { return complaints_; }

private:
  Fault fault_;
  std::vector<Complaint> complaints_;
  std::string text_;
};

} // namespace billet
