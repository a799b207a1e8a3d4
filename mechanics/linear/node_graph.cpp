#include "mechanics/linear/node_graph.h"

#include <metis.h>
#include <signal.h>

#include <cstddef>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace billet::mechanics {

namespace {

static_assert(std::is_same_v<idx_t, Index>);

/// As long as this lives SIGTERM waits, if it is for the calling thread.
///
/// METIS takes it for its own while it works, and jumps out of whatever function it meets: with a
/// lock of the C library held, the next call of that function would wait for ever.
class TerminationWaits {
public:
  TerminationWaits() {
    sigset_t termination;
    sigemptyset(&termination);
    sigaddset(&termination, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &termination, &before_);
  }
  ~TerminationWaits() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  TerminationWaits(const TerminationWaits&) = delete;
  TerminationWaits& operator=(const TerminationWaits&) = delete;

private:
  sigset_t before_;
};

template <class Call> void run_metis(const Call& status_of_metis) {
  const TerminationWaits wait;
  const int status = status_of_metis();
  if (status == METIS_ERROR_MEMORY)
    throw std::bad_alloc();
  if (status != METIS_OK)
    throw std::runtime_error("METIS cannot order the unknowns");
}

} // namespace

NodeGraph node_graph(const BlockPattern& pattern) {
  NodeGraph graph{{0}, {}};
  for (Index a = 0; a < pattern.n_nodes(); ++a) {
    for (Index k = pattern.neighbour_start[idx(a)]; k < pattern.neighbour_start[idx(a) + 1]; ++k)
      if (pattern.neighbours[idx(k)] != a)
        graph.ends.push_back(pattern.neighbours[idx(k)]);
    graph.start.push_back(static_cast<Index>(graph.ends.size()));
  }
  return graph;
}

std::vector<Index> nested_dissection(NodeGraph graph) {
  auto n = static_cast<idx_t>(graph.start.size()) - 1;
  std::vector<idx_t> order(idx(n)), position(idx(n));
  if (n > 1)
    run_metis([&] {
      return METIS_NodeND(&n, graph.start.data(), graph.ends.data(), nullptr, nullptr, order.data(),
                          position.data());
    });
  return order;
}

std::vector<Index> partition(NodeGraph graph, int parts) {
  auto n = static_cast<idx_t>(graph.start.size()) - 1;
  std::vector<idx_t> part(idx(n), 0), weights;
  for (std::size_t a = 0; a < part.size(); ++a)
    weights.push_back(graph.start[a + 1] - graph.start[a] + 1);
  idx_t n_parts = parts, constraints = 1, cut = 0;
  if (parts > 1 && n > 1)
    run_metis([&] {
      return METIS_PartGraphKway(&n, &constraints, graph.start.data(), graph.ends.data(),
                                 weights.data(), nullptr, nullptr, &n_parts, nullptr, nullptr,
                                 nullptr, &cut, part.data());
    });
  return part;
}

} // namespace billet::mechanics
