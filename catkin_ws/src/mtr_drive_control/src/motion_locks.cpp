/// @file
/// Reasons to stand still, and the silence of their owners.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/motion_locks.hpp"

#include <algorithm>
#include <cmath>

#include "problems.hpp"

namespace mtr_drive_control {
namespace {

using mtr_core::Samples;
using mtr_core::Slot;

const std::map<std::string, Slot> kOwnerSlots{{"dispatcher", mtr_core::kDispatcher},
                                              {"state_machine", mtr_core::kStateMachine},
                                              {"controller_input", mtr_core::kControllerInput}};

}  // namespace

bool is_fresh(std::int64_t stamp_ns, std::int64_t tick_ns, double timeout_s) {
  return std::abs(static_cast<double>(tick_ns - stamp_ns)) <= timeout_s * 1e9;
}

MotionLocks::MotionLocks(const std::vector<std::string>& required_owners, double timeout_s,
                         const std::optional<mtr_core::Waiting>& waiting)
    : timeout_s_(timeout_s) {
  for (const std::string& owner : required_owners) {
    const auto slot = kOwnerSlots.find(owner);
    if (slot != kOwnerSlots.end()) {
      locks_.emplace(owner, Samples<Lock>(slot->second, mtr_core::kClockStep.period_ns, waiting));
    } else {
      locks_.emplace(owner, Samples<Lock>(mtr_core::kClockStep));
    }
  }
}

bool MotionLocks::take(const std::string& owner, const Lock& lock) {
  locks_.try_emplace(owner, mtr_core::kClockStep).first->second.add(lock.stamp_ns, lock);
  if (!lock.engaged) {
    engaged_owners_.erase(owner);
    return false;
  }
  return engaged_owners_.insert(owner).second;
}

std::vector<EngagedLock> MotionLocks::engaged_at(std::int64_t tick_ns) {
  std::vector<EngagedLock> engaged;
  age_s_ = 0.0;
  for (auto& [owner, samples] : locks_) {
    const std::optional<Lock> lock = samples.at(tick_ns);
    age_s_ = lock ? std::max(age_s_, static_cast<double>(tick_ns - lock->stamp_ns) * 1e-9) : age_s_;
    if (!lock) {
      engaged.push_back({owner, problems::kWaitingForLock({{"owner", owner}})});
    } else if (!is_fresh(lock->stamp_ns, tick_ns, timeout_s_)) {
      engaged.push_back({owner, problems::kLockSilent({{"owner", owner}})});
    } else if (lock->engaged) {
      engaged.push_back({owner, lock->reason});
    }
  }
  return engaged;
}

}  // namespace mtr_drive_control
