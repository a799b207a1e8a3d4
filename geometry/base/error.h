// What is reported to the user when a run cannot go on through no fault of the program.
//
// One exception type, thrown where a mistake of the user (case file, mesh, STL, disk) is found and
// caught once, in app/. It carries any number of complaints so that all errors of a file are
// reported in one go. Numerical non-success is not an error: see outcome.h.

#pragma once

#include <exception>
#include <string>
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

/// One thing that is wrong, with everything needed to mend it.
struct Complaint {
  std::string place;   ///< "file:line:column", "file:line", "file" or empty
  std::string message; ///< the key or item, what was found, what is allowed
  std::string remedy;  ///< what to do ("did you mean ...?"); may be empty

  [[nodiscard]] std::string text() const;
};

/// Thrown for a user's mistake; `what()` holds all complaints, one a line.
class Error : public std::exception {
public:
  Error(Fault fault, std::vector<Complaint> complaints);
  Error(Fault fault, std::string place, std::string message, std::string remedy = {});

  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }
  [[nodiscard]] Fault fault() const noexcept { return fault_; }
  [[nodiscard]] const std::vector<Complaint>& complaints() const noexcept { return complaints_; }

private:
  Fault fault_;
  std::vector<Complaint> complaints_;
  std::string text_;
};

} // namespace billet
