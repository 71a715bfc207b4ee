/// @file
/// Motion locks, one per owner; an owner that becomes silent keeps its lock engaged.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mtr_core/problem.hpp"
#include "mtr_core/samples.hpp"

namespace mtr_drive_control {

/// State of one owner's lock.
struct Lock {
  std::int64_t stamp_ns;
  bool engaged;
  /// One sentence for the Operator.
  mtr_core::Problem reason;
  /// The owner is an emergency stop.
  bool emergency = false;
};

/// Lock that forbids motion now.
struct EngagedLock {
  std::string owner;
  mtr_core::Problem reason;
  /// The owner is an emergency stop.
  bool emergency = false;
};

/// Locks of the required owners, and of every other owner received so far.
///
/// An emergency stop is latched: one that became silent while engaged is released only after its owner engages it and
/// then releases it. A restarted owner that does not know of it therefore cannot release it.
class MotionLocks {
 public:
  /// @param waiting given in lock-step: waits for the required owners with a slot in the schedule
  MotionLocks(const std::vector<std::string>& required_owners, double timeout_s,
              const std::optional<mtr_core::Waiting>& waiting);

  /// Accepts the newest state of an owner's lock.
  ///
  /// @return true if it engages a lock that was released or never received, at most once per period: an emergency stop
  /// with a bouncing contact, or reported by several owners, causes one immediate step
  bool take(const std::string& owner, Lock lock);

  /// Locks that forbid motion at the tick, ordered by owner.
  std::vector<EngagedLock> engaged_at(std::int64_t tick_ns);

  /// Age of the oldest received lock, in s, at the tick of the last call above.
  double age_s() const { return age_s_; }

 private:
  bool is_first_in_period(std::int64_t stamp_ns);

  /// Newest message of an owner.
  struct Word {
    std::int64_t stamp_ns;
    bool engaged;
    /// Emergency stop without an observed release.
    bool latched;
  };

  bool is_latched(const std::string& owner, const Lock& lock) const;

  double timeout_s_;
  /// Stamp of the last reported engagement.
  std::optional<std::int64_t> engaged_ns_;
  double age_s_ = 0.0;
  std::map<std::string, mtr_core::Samples<Lock>> locks_;
  std::map<std::string, Word> words_;
};

}  // namespace mtr_drive_control
