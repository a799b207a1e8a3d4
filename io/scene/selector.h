// The nodes and faces of the workpiece that a `where` of a case means.

#pragma once

#include "geometry/base/error.h"
#include "io/case/case_common.h"
#include "mechanics/mesh/mesh.h"

#include <string>
#include <vector>

namespace billet::io {

/// Which nodes a `where` means, and which faces. What is wrong with one is collected, and it means
/// nothing then.
class Selector {
public:
  /// @param surface   all faces that have an element on one side alone
  /// @param boundary  those of them that may be meant
  Selector(const mechanics::Mesh& mesh,
           const std::vector<mechanics::Face>& surface,
           const std::vector<mechanics::Face>& boundary);

  [[nodiscard]] std::vector<mechanics::Index> nodes(const Where& where);
  /// Faces all of whose nodes are meant.
  [[nodiscard]] std::vector<mechanics::Face> faces(const Where& where);

  /// Throws an Error of all that was wrong, if anything was.
  void throw_if_any() const;
  /// Warnings of nodes that seem to have been left out unawares.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

private:
  [[nodiscard]] std::vector<mechanics::Index> set(const Where& where, const std::string& name);
  void warn_of_missed(const Where& where, const std::vector<mechanics::Index>& found);
  void complain(const Where& where, const std::string& message, std::string remedy);

  const mechanics::Mesh& mesh_;
  const std::vector<mechanics::Face>& surface_;
  const std::vector<mechanics::Face>& boundary_;
  double size_;
  std::vector<Complaint> complaints_;
  std::vector<std::string> warnings_;
};

} // namespace billet::io
