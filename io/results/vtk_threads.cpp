#include "io/results/vtk_threads.h"

#include <vtkSMPTools.h>

namespace billet::io {

void keep_vtk_to_one_thread() {
  // Arrays ask the backend of threads for their number even where another one is in use.
  if (vtkSMPTools::SetBackend("STDThread"))
    vtkSMPTools::Initialize(1);
  vtkSMPTools::SetBackend("Sequential");
}

} // namespace billet::io
