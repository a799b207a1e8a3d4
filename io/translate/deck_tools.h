// Tools of a deck: bodies that do not deform, and analytical rigid surfaces, as surfaces of a case.

#pragma once

#include "io/translate/deck_bodies.h"

#include <string>
#include <vector>

namespace billet::io {

/// A file that a case names.
struct DeckFile {
  std::string name;
  std::string content;
};

/// The surface of a tool as text of a case, and the files it needs.
struct DeckToolSurface {
  std::string text; ///< value of `surface`; empty: it cannot be said
  std::vector<DeckFile> files;
  std::vector<std::string> remarks;
};

/// What the workpiece looks like, to know on which side of a tool it lies.
struct DeckSurroundings {
  std::vector<Vec3> points; ///< nodes of the workpiece
  bool in_space = false;
  std::string unit; ///< of lengths
};

/// The skin of a body: STL in space, a chain of points in the plane.
[[nodiscard]] DeckToolSurface surface_of_body(const Deck& deck,
                                              const DeckBody& body,
                                              const std::string& name,
                                              const DeckSurroundings& around);

/// An analytical rigid surface: its free side is on the left of the direction of its segments.
[[nodiscard]] DeckToolSurface surface_of_profile(const DeckSurface& surface,
                                                 const std::string& name,
                                                 const DeckSurroundings& around);

/// A name that a file and a tool may have.
[[nodiscard]] std::string plain_name(const std::string& name);

/// "[1, 2.5]": the first components of a vector.
[[nodiscard]] std::string vector_text(const Vec3& vector, bool in_space);

} // namespace billet::io
