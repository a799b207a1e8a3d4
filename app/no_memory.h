// The end of the program where memory has run out, by ways that need none.
//
// As a rule std::bad_alloc goes up to `main`, which reports it. But no exception can be thrown
// where there is no memory for one, out of a function that promises not to throw, or through
// libraries that go on without: OpenBLAS asks for its buffer for ever, TBB and OpenBLAS need
// threads that cannot be started, GMP aborts, VTK uses what it could not allocate. There this file
// ends the program, with the same words and the same status. Linking it is enough: it takes effect
// before the first library is initialized.

#pragma once

namespace billet::app {

/// Says on standard error that memory does not suffice.
/// @return the status to end with
int report_no_memory() noexcept;

} // namespace billet::app
