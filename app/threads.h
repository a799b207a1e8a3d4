// How many threads the program takes.

#pragma once

namespace billet::app {

/// Limits loops over elements and contact points to so many threads, to the end of the program.
void limit_threads(int threads);

} // namespace billet::app
