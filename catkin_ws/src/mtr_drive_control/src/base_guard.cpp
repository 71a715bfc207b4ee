/// @file
/// Acceleration limits and time-out of a base.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/base_guard.hpp"

#include <algorithm>

#include "mtr_core/steady_time.hpp"

namespace mtr_drive_control {
namespace {

// A longer time without a step is a pause.
constexpr double kPausePeriods = 2.0;
// Queued commands have arrived within this time.
constexpr std::int64_t kDeafNs = 100 * mtr_core::kMillisecondNs;

double toward(double wanted, double now, double step) { return std::clamp(wanted, now - step, now + step); }

}  // namespace

void BaseGuard::take(std::int64_t now_ns, const Velocity& command) {
  notice_pause(now_ns);
  if (now_ns >= deaf_until_ns_ && command.is_finite()) {
    command_ = command;
    commanded_ns_ = now_ns;
  }
}

Velocity BaseGuard::step(std::int64_t now_ns) {
  notice_pause(now_ns);
  stepped_ns_ = now_ns;
  const bool is_told = commanded_ns_ && mtr_core::is_fresh(*commanded_ns_, now_ns, limits_.command_timeout_s);
  const Velocity wanted = is_told ? command_ : Velocity{};
  sent_ = {toward(wanted.linear_mps, sent_.linear_mps, limits_.linear_acceleration_mps2 * period_s_),
           toward(wanted.angular_radps, sent_.angular_radps, limits_.angular_acceleration_radps2 * period_s_)};
  return sent_;
}

void BaseGuard::notice_pause(std::int64_t now_ns) {
  if (!stepped_ns_ || mtr_core::is_fresh(*stepped_ns_, now_ns, kPausePeriods * period_s_)) {
    return;
  }
  if (!mtr_core::is_fresh(*stepped_ns_, now_ns, limits_.command_timeout_s)) {
    sent_ = {};
  }
  commanded_ns_.reset();
  stepped_ns_ = now_ns;
  deaf_until_ns_ = now_ns + kDeafNs;
}

}  // namespace mtr_drive_control
