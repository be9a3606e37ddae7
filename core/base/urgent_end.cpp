#include "core/base/urgent_end.h"

#include <atomic>

namespace scantrove {
namespace {

std::atomic<bool> g_is_urgent{false};

}  // namespace

void setEndUrgent(bool is_urgent) { g_is_urgent = is_urgent; }

bool isEndUrgent() { return g_is_urgent; }

}  // namespace scantrove
