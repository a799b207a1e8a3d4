#include "geometry/base/error.h"

#include <utility>

namespace billet {

std::string Complaint::text() const {
  std::string text = place.empty() ? "" : place + ": ";
  text += message;
  if (!remedy.empty())
    text += " (" + remedy + ")";
  if (!code.empty())
    text.append(" [").append(code).append("]");
  return text;
}

std::string_view code_of(Fault fault) {
  switch (fault) {
  case Fault::usage:
    return error_code::usage;
  case Fault::case_file:
    return error_code::case_refused;
  case Fault::geometry:
    return error_code::geometry;
  case Fault::not_converged:
    return "exit-5";
  case Fault::input_output:
    return error_code::file;
  case Fault::limit:
    return error_code::limit;
  case Fault::failed_check:
    return "exit-8";
  }
  return {};
}

Error::Error(Fault fault, std::vector<Complaint> complaints)
    : fault_(fault), complaints_(std::move(complaints)) {
  for (Complaint& complaint : complaints_) {
    if (complaint.code.empty())
      complaint.code = code_of(fault);
    if (!text_.empty())
      text_ += '\n';
    text_ += complaint.text();
  }
}

Error::Error(Fault fault,
             std::string place,
             std::string message,
             std::string remedy,
             std::string_view code)
    : Error(fault, {Complaint{std::move(place), std::move(message), std::move(remedy), code}}) {}

} // namespace billet
