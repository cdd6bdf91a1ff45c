#pragma once

#include <functional>
#include <stdexcept>

namespace hexwall {

/// Thrown where work ends because whoever asked for it no longer wants it. No `Error`: nothing is
/// wrong with the input.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Makes the work of this thread cancellable while it lives: the stages of the pipeline, the
/// preparation of surfaces, generated shapes and all that they call ask `is_cancelled` in all their
/// long loops, and throw `Cancelled` once it says true. It is asked on this thread only, very
/// often: where its answer takes long, let it look at the time first. It may throw an exception of
/// its own, which comes out instead.
///
///   std::stop_source stop;  // stop.request_stop() on any thread
///   const CancelScope scope([&] { return stop.stop_requested(); });
///   run_pipeline(prepared, options);
///
/// Scopes nest; the inner one is asked alone. Limit: a step of CGAL or CHOLMOD, or the reading of a
/// file, runs to its end.
class CancelScope {
 public:
  explicit CancelScope(std::function<bool()> is_cancelled);
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  std::function<bool()> is_cancelled_;
  const std::function<bool()>* outer_;
};

/// To be called in every loop that may take long; does nothing outside of a `CancelScope`.
/// \throws Cancelled
void throw_if_cancelled();

}  // namespace hexwall
