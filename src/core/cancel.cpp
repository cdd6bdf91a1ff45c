#include "core/cancel.h"

#include <utility>

namespace hexwall {
namespace {
thread_local const std::function<bool()>* asked = nullptr;
}  // namespace

CancelScope::CancelScope(std::function<bool()> is_cancelled)
    : is_cancelled_(std::move(is_cancelled)), outer_(std::exchange(asked, &is_cancelled_)) {}

CancelScope::~CancelScope() {
  asked = outer_;
}

void throw_if_cancelled() {
  if (asked != nullptr && (*asked)()) throw Cancelled();
}

}  // namespace hexwall
