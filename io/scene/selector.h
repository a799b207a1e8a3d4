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
  /// @param boundary  the faces that may be meant
  Selector(const mechanics::Mesh& mesh, const std::vector<mechanics::Face>& boundary);

  [[nodiscard]] std::vector<mechanics::Index> nodes(const Where& where);
  /// Faces all of whose nodes are meant.
  [[nodiscard]] std::vector<mechanics::Face> faces(const Where& where);

  /// Throws an Error of all that was wrong, if anything was.
  void throw_if_any() const;

private:
  [[nodiscard]] std::vector<mechanics::Index> set(const Where& where, const std::string& name);
  void complain(const Where& where, const std::string& message, std::string remedy);

  const mechanics::Mesh& mesh_;
  const std::vector<mechanics::Face>& boundary_;
  double size_;
  std::vector<Complaint> complaints_;
};

} // namespace billet::io
