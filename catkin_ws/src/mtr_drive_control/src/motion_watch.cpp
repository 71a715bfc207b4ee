/// @file
/// Contradictions between commands and measurements.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/motion_watch.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_core/plausible.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

// Response time of a base, in s: control loop, acceleration limit, delay of the odometry.
constexpr double kAnswerS = 0.4;
// Time after which a contradiction counts, in s; at full speed it costs 0.4 m.
constexpr double kContradictionS = 0.5;
// Wheels slip briefly on grass and kerbs.
constexpr double kSlipS = 0.7;
// Below these speeds the encoders may show standstill.
constexpr double kMovesMps = 0.05;
constexpr double kMovesRadps = 0.15;
// Apparent motion of stopped wheels. Settling servos creep by some mm/s. An encoder that flickers by one count in 20 ms
// shows 0.6 mm/s with counts of 13 um, as on a Jackal, and 10 mm/s with counts of 0.2 mm. The limit is a quarter of the
// least motion that counts, so a base that follows a crawl is far from it.
constexpr double kStandsMps = 0.25 * kMovesMps;
constexpr double kStandsRadps = 0.25 * kMovesRadps;
// Motion beyond the recent commands plus this is uncommanded. A jolt is shorter than kContradictionS.
constexpr double kDisobeysMps = 0.2;
constexpr double kDisobeysRadps = 0.5;
// Depending on the ground, a skid-steered robot turns by a third more or less than its wheels show.
constexpr double kSlipRadps = 0.4;
constexpr double kSlipShare = 0.5;

bool is_between(double value, double low, double high, double margin) {
  return value >= std::min(low, 0.0) - margin && value <= std::max(high, 0.0) + margin;
}

bool repeats(const Motion& motion, const Motion& before) {
  const auto& [x_m, y_m] = motion.odom_from_base.position();
  return x_m == before.odom_from_base.position().x_m && y_m == before.odom_from_base.position().y_m &&
         motion.odom_from_base.heading_rad() == before.odom_from_base.heading_rad() &&
         motion.velocity.linear_mps == before.velocity.linear_mps &&
         motion.velocity.angular_radps == before.velocity.angular_radps;
}

bool stands(const Velocity& measured) {
  return std::abs(measured.linear_mps) <= kStandsMps && std::abs(measured.angular_radps) <= kStandsRadps;
}

}  // namespace

bool ImuReading::is_plausible() const {
  return std::all_of(rates_radps.begin(), rates_radps.end(), mtr_core::is_turn_rate) &&
         std::all_of(forces_mps2.begin(), forces_mps2.end(), mtr_core::is_force);
}

bool Duration::lasts(bool is_so, std::int64_t tick_ns, double for_s) {
  if (!is_so) {
    since_ns_.reset();
    return false;
  }
  since_ns_ = std::min(since_ns_.value_or(tick_ns), tick_ns);
  return static_cast<double>(tick_ns - *since_ns_) * 1e-9 >= for_s;
}

mtr_core::Problem MotionWatch::take(std::int64_t tick_ns, const Velocity& sent, const std::optional<Motion>& motion,
                                    const std::optional<ImuReading>& imu) {
  remember(tick_ns, sent);
  const mtr_core::Problem wheels = motion ? wheels_problem(tick_ns, *motion) : mtr_core::Problem{};
  const mtr_core::Problem turn = imu ? imu_problem(tick_ns, motion, *imu) : mtr_core::Problem{};
  return wheels ? wheels : turn;
}

void MotionWatch::remember(std::int64_t tick_ns, const Velocity& sent) {
  while (!told_.empty() && !(told_.front().tick_ns <= tick_ns &&
                             static_cast<double>(tick_ns - told_.front().tick_ns) * 1e-9 <= kAnswerS)) {
    told_.pop_front();
  }
  told_.push_back({tick_ns, sent});
}

bool MotionWatch::was_told_to_move() const {
  const bool is_long = static_cast<double>(told_.back().tick_ns - told_.front().tick_ns) * 1e-9 > 0.5 * kAnswerS;
  return is_long && std::all_of(told_.begin(), told_.end(), [](const Told& told) {
           return std::abs(told.velocity.linear_mps) >= kMovesMps ||
                  std::abs(told.velocity.angular_radps) >= kMovesRadps;
         });
}

bool MotionWatch::obeys(const Velocity& measured) const {
  const auto by_linear = [](const Told& a, const Told& b) { return a.velocity.linear_mps < b.velocity.linear_mps; };
  const auto by_turn = [](const Told& a, const Told& b) { return a.velocity.angular_radps < b.velocity.angular_radps; };
  const auto [back, ahead] = std::minmax_element(told_.begin(), told_.end(), by_linear);
  const auto [right, left] = std::minmax_element(told_.begin(), told_.end(), by_turn);
  return is_between(measured.linear_mps, back->velocity.linear_mps, ahead->velocity.linear_mps, kDisobeysMps) &&
         is_between(measured.angular_radps, right->velocity.angular_radps, left->velocity.angular_radps,
                    kDisobeysRadps);
}

mtr_core::Problem MotionWatch::wheels_problem(std::int64_t tick_ns, const Motion& motion) {
  if (!motion_ || motion.stamp_ns != motion_->stamp_ns) {
    odometry_repeats_ = motion_ && repeats(motion, *motion_);
    motion_ = motion;
  }
  const bool is_told = was_told_to_move();
  const bool is_standing = standing_.lasts(is_told && stands(motion.velocity), tick_ns, kContradictionS);
  const bool is_frozen = frozen_odometry_.lasts(is_told && odometry_repeats_, tick_ns, kContradictionS);
  if (is_standing) {
    return problems::kBaseStands();
  }
  if (is_frozen) {
    return problems::kOdometryFrozen();
  }
  if (disobedience_.lasts(!obeys(motion.velocity), tick_ns, kContradictionS)) {
    const Velocity& sent = told_.back().velocity;
    return problems::kBaseDisobeys({{"sent_mps", sent.linear_mps},
                                    {"sent_radps", sent.angular_radps},
                                    {"measured_mps", motion.velocity.linear_mps},
                                    {"measured_radps", motion.velocity.angular_radps}});
  }
  return {};
}

mtr_core::Problem MotionWatch::imu_problem(std::int64_t tick_ns, const std::optional<Motion>& motion,
                                           const ImuReading& imu) {
  if (!imu_ || imu.stamp_ns != imu_->stamp_ns) {
    imu_repeats_ = imu_ && imu.repeats(*imu_);
    imu_ = imu;
  }
  if (frozen_imu_.lasts(imu_repeats_ && was_told_to_move(), tick_ns, kContradictionS)) {
    return problems::kImuFrozen();
  }
  const double wheels_radps = motion ? motion->velocity.angular_radps : imu.yaw_rate_radps();
  const double apart_radps = std::abs(wheels_radps - imu.yaw_rate_radps());
  const double allowed_radps =
      kSlipRadps + kSlipShare * std::max(std::abs(wheels_radps), std::abs(imu.yaw_rate_radps()));
  if (slip_.lasts(apart_radps > allowed_radps, tick_ns, kSlipS)) {
    return problems::kWheelsSlip({{"wheels_radps", wheels_radps}, {"gyro_radps", imu.yaw_rate_radps()}});
  }
  return {};
}

}  // namespace mtr_drive_control
