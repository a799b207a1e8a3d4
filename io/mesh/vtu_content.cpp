#include "io/mesh/vtu_content.h"

#include "geometry/base/late_library.h"

namespace billet::io {

VtuContent vtu_content(const std::filesystem::path& path) {
  using Read = void(const char*, VtuContent&);
  static Read* const read = late_function<Read>("billet_vtk.so", "billet_read_vtu");
  VtuContent content;
  read(path.c_str(), content);
  return content;
}

} // namespace billet::io
