/// @file
/// Steps of the ROS clock do not affect ages (A10).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mtr_core/schedule.hpp"
#include "mtr_core/steady_time.hpp"

namespace mtr_core {
namespace {

constexpr std::int64_t kMs = kMillisecondNs;
constexpr double kTimeoutS = 0.14;
constexpr std::int64_t kTimeoutNs = 140 * kMs;
// The clocks' origins differ.
constexpr std::int64_t kRosNs = 1'700'000'000 * kSecondNs;
constexpr std::int64_t kSteadyNs = 5'000 * kMs;

TEST(SteadyTime, StampIsAsOldOnTheSteadyClockAsOnItsOwn) {
  EXPECT_EQ(steady_time_of(kRosNs - 30 * kMs, {kSteadyNs, kRosNs}), kSteadyNs - 30 * kMs);
}

TEST(SteadyTime, ClockThatIsSetAfterTheArrivalChangesNoAge) {
  for (const std::int64_t step_ns : {50 * kMs, 400 * kMs, 3'600'000 * kMs, -50 * kMs, -400 * kMs, -3'600'000 * kMs}) {
    const Instant before{kSteadyNs, kRosNs};
    const Instant after{kSteadyNs + 130 * kMs, kRosNs + 130 * kMs + step_ns};
    const std::int64_t first_ns = steady_time_of(before.stamp_ns, before);
    EXPECT_TRUE(is_fresh(first_ns, kSteadyNs + kTimeoutNs, kTimeoutS));
    EXPECT_FALSE(is_fresh(first_ns, kSteadyNs + kTimeoutNs + 1, kTimeoutS));
    EXPECT_EQ(steady_time_of(after.stamp_ns, after), after.time_ns);
  }
}

TEST(SteadyTime, ClockThatIsSetWhileAMessageIsUnderWayNeverMakesItYounger) {
  for (const std::int64_t step_ns : {50 * kMs, 100 * kMs, 400 * kMs, 3'600'000 * kMs}) {
    // Stamped at kRosNs, then the clock is set back by the step, then the message arrives.
    const std::int64_t time_ns = steady_time_of(kRosNs, {kSteadyNs, kRosNs - step_ns});
    EXPECT_FALSE(is_fresh(time_ns, kSteadyNs + kTimeoutNs + 1, kTimeoutS));
  }
}

TEST(SteadyTime, StampFarAheadIsNeitherFreshAtItsArrivalNorWhenItsTimeComes) {
  const std::int64_t time_ns = steady_time_of(kRosNs + kMaxAheadNs + 1, {kSteadyNs, kRosNs});
  EXPECT_FALSE(is_fresh(time_ns, kSteadyNs, kTimeoutS));
  EXPECT_FALSE(is_fresh(time_ns, kSteadyNs + kMaxAheadNs + 1, kTimeoutS));
}

TEST(SteadyTime, TickIsMissedByAWholePeriodAndByNoLess) {
  EXPECT_FALSE(is_missed(kDriveControl, 40 * kMs, 60 * kMs - 1));
  EXPECT_TRUE(is_missed(kDriveControl, 40 * kMs, 60 * kMs));
}

}  // namespace
}  // namespace mtr_core
