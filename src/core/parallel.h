#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/cancel.h"

namespace hexwall {

/// Calls body(i) for i in [0, count), in parallel. Bodies must write to places of their own only:
/// the result is then the same for any number of threads. \throws Cancelled
template <class Body>
void parallel_for(std::size_t count, const Body& body) {
  throw_if_cancelled();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
    throw_if_cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

/// The same for few, long tasks of unequal length.
template <class Body>
void parallel_tasks(std::size_t count, const Body& body) {
  throw_if_cancelled();
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    throw_if_cancelled();
    body(i);
  });
}

}  // namespace hexwall
