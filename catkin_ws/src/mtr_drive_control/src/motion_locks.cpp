/// @file
/// Motion locks, and the silence of their owners.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/motion_locks.hpp"

#include <algorithm>
#include <cstdlib>

#include "mtr_core/steady_time.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

using mtr_core::Samples;
using mtr_core::Slot;

const std::map<std::string, Slot> kOwnerSlots{{"dispatcher", mtr_core::kDispatcher},
                                              {"state_machine", mtr_core::kStateMachine},
                                              {"controller_input", mtr_core::kControllerInput}};

}  // namespace

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

bool MotionLocks::take(const std::string& owner, Lock lock) {
  const auto before = words_.find(owner);
  const bool was_engaged = before != words_.end() && (before->second.engaged || before->second.latched);
  const Word word{lock.stamp_ns, lock.engaged, is_latched(owner, lock)};
  words_[owner] = word;
  if (word.latched && !lock.engaged) {
    lock.engaged = true;
    lock.reason = problems::kEmergencyNotReleased({{"owner", owner}});
  }
  locks_.try_emplace(owner, mtr_core::kClockStep).first->second.add(lock.stamp_ns, lock);
  return lock.engaged && !was_engaged && is_first_in_period(lock.stamp_ns);
}

bool MotionLocks::is_first_in_period(std::int64_t stamp_ns) {
  if (engaged_ns_ && std::abs(stamp_ns - *engaged_ns_) < mtr_core::kDriveControl.period_ns) {
    return false;
  }
  engaged_ns_ = stamp_ns;
  return true;
}

bool MotionLocks::is_latched(const std::string& owner, const Lock& lock) const {
  const auto before = words_.find(owner);
  if (lock.engaged || before == words_.end() || !before->second.latched) {
    return lock.engaged && lock.emergency;
  }
  const bool was_seen =
      before->second.engaged && mtr_core::is_fresh(before->second.stamp_ns, lock.stamp_ns, timeout_s_);
  return !was_seen;
}

std::vector<EngagedLock> MotionLocks::engaged_at(std::int64_t tick_ns) {
  std::vector<EngagedLock> engaged;
  age_s_ = 0.0;
  for (auto& [owner, samples] : locks_) {
    const std::optional<Lock> lock = samples.at(tick_ns);
    age_s_ = lock ? std::max(age_s_, static_cast<double>(tick_ns - lock->stamp_ns) * 1e-9) : age_s_;
    if (!lock) {
      engaged.push_back({owner, problems::kWaitingForLock({{"owner", owner}})});
    } else if (!mtr_core::is_fresh(lock->stamp_ns, tick_ns, timeout_s_)) {
      engaged.push_back({owner, problems::kLockSilent({{"owner", owner}})});
    } else if (lock->engaged) {
      engaged.push_back({owner, lock->reason, lock->emergency});
    }
  }
  return engaged;
}

}  // namespace mtr_drive_control
