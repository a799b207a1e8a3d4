// VTK's threads: a frame has dozens of small arrays, and VTK asks the system for the number of
// processors, and wakes its threads, once for each of them.

#pragma once

namespace billet::io {

/// What VTK does from now on it does in the calling thread.
void keep_vtk_to_one_thread();

} // namespace billet::io
