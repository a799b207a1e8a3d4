#include "geometry/base/error.h"

#include <utility>

namespace billet {

std::string Complaint::text() const {
  std::string text = place.empty() ? "" : place + ": ";
  text += message;
  if (!remedy.empty())
    text += " (" + remedy + ")";
  return text;
}

Error::Error(Fault fault, std::vector<Complaint> complaints)
    : fault_(fault), complaints_(std::move(complaints)) {
  for (const Complaint& complaint : complaints_) {
    if (!text_.empty())
      text_ += '\n';
    text_ += complaint.text();
  }
}

Error::Error(Fault fault, std::string place, std::string message, std::string remedy)
    : Error(fault, {Complaint{std::move(place), std::move(message), std::move(remedy)}}) {}

} // namespace billet
