#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace hexwall {

/// Calls body(i) for i in [0, count), in parallel. Bodies must write to places of their own only:
/// the result is then the same for any number of threads.
template <class Body>
void parallel_for(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

/// The same for few, long tasks of unequal length.
template <class Body>
void parallel_tasks(std::size_t count, const Body& body) {
  tbb::parallel_for(std::size_t{0}, count, body);
}

}  // namespace hexwall
