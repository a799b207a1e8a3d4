// How many threads VTK may use.

#pragma once

namespace billet::io {

/// Has VTK work in the calling thread. Unless told, it asks the system for the number of processors
/// anew for each array that it writes, which takes longer than to write a small one.
void keep_vtk_to_one_thread();

} // namespace billet::io
