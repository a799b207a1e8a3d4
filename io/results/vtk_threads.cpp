// Compiled as C++17: vtkSMPTools.h of VTK 9.1 is not valid C++20.

#include "io/results/vtk_threads.h"

#include <vtkSMPTools.h>

namespace billet::io {

namespace {

bool choose_one_thread() {
  // Arrays ask the backend of threads even where another one is in use.
  if (vtkSMPTools::SetBackend("STDThread"))
    vtkSMPTools::Initialize(1);
  return vtkSMPTools::SetBackend("Sequential");
}

} // namespace

void keep_vtk_to_one_thread() { [[maybe_unused]] static const bool chosen = choose_one_thread(); }

} // namespace billet::io
