/// @file
/// Reasons to stand still, one per owner; an owner that falls silent keeps its lock engaged.
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

/// A lock that forbids motion now.
struct EngagedLock {
  std::string owner;
  mtr_core::Problem reason;
  /// The owner is an emergency stop.
  bool emergency = false;
};

/// Locks of the required owners, and of every other owner that was ever heard.
///
/// An emergency stop is latched: one that fell silent while it was engaged is released only when its owner engages it
/// and then releases it, so that a new process that knows nothing of it releases nothing.
class MotionLocks {
 public:
  /// @param waiting given in lock-step: the required owners with a slot in the schedule are waited for
  MotionLocks(const std::vector<std::string>& required_owners, double timeout_s,
              const std::optional<mtr_core::Waiting>& waiting);

  /// Takes the newest state of an owner's lock.
  ///
  /// @return true when it engages a lock that was released or never heard, once per period: an emergency stop whose
  /// contact bounces, or that several owners report, causes one immediate step
  bool take(const std::string& owner, Lock lock);

  /// Locks that forbid motion at the tick, ordered by owner.
  std::vector<EngagedLock> engaged_at(std::int64_t tick_ns);

  /// Age of the oldest lock that was heard, in s, at the tick of the last call above.
  double age_s() const { return age_s_; }

 private:
  bool is_first_in_period(std::int64_t stamp_ns);

  /// The newest word of an owner.
  struct Word {
    std::int64_t stamp_ns;
    bool engaged;
    /// An emergency stop that nobody was seen to release.
    bool latched;
  };

  bool is_latched(const std::string& owner, const Lock& lock) const;

  double timeout_s_;
  /// Stamp of the engagement that was reported last.
  std::optional<std::int64_t> engaged_ns_;
  double age_s_ = 0.0;
  std::map<std::string, mtr_core::Samples<Lock>> locks_;
  std::map<std::string, Word> words_;
};

}  // namespace mtr_drive_control
