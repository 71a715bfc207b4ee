/// @file
/// Converted stamps are continuous across steps of the ROS clock (A10).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "mtr_core/stamp_clock.hpp"

namespace mtr_core {
namespace {

constexpr std::int64_t kMs = kMillisecondNs;
constexpr std::int64_t kRosNs = 1'700'000'000 * kSecondNs;
constexpr std::int64_t kSteadyNs = 5'000 * kMs;
constexpr std::int64_t kSteps[] = {50 * kMs,  400 * kMs,  60'000 * kMs,  3'600'000 * kMs,
                                   -50 * kMs, -400 * kMs, -60'000 * kMs, -3'600'000 * kMs};

/// A producer whose messages are stamped every 20 ms and arrive with a fixed age, and the clock that reads them.
class Line {
 public:
  explicit Line(std::int64_t age_ns) : age_ns_(age_ns) {}
  void set_age(std::int64_t age_ns) { age_ns_ = age_ns; }

  /// Error of the next message's steady time; the clock may be set while the message is in transit.
  std::int64_t error_of_next(std::int64_t step_under_way_ns = 0) {
    time_ns_ += 20 * kMs;
    const std::int64_t stamp_ns = time_ns_ + offset_ns_;
    offset_ns_ += step_under_way_ns;
    const std::int64_t arrival_ns = time_ns_ + age_ns_;
    return clock_.time_of(stamp_ns, {arrival_ns, arrival_ns + offset_ns_}, usual_age_ns_) - time_ns_;
  }

  void slew(std::int64_t ns) { offset_ns_ += ns; }
  std::int64_t stamp_error() const { return clock_.stamp_of(time_ns_) - time_ns_ - offset_ns_; }

 private:
  StampClock clock_;
  std::int64_t age_ns_;
  std::int64_t time_ns_ = kSteadyNs;
  std::int64_t offset_ns_ = kRosNs;
  std::int64_t usual_age_ns_ = 0;
};

TEST(StampClock, MessagesUnderWayAndAfterAStepHaveTheTimeThatTheyHadWithoutIt) {
  for (const std::int64_t step_ns : kSteps) {
    for (const std::int64_t age_ns : {1 * kMs, 45 * kMs, 90 * kMs}) {
      Line line(age_ns);
      for (int message = 0; message < 10; ++message) {
        ASSERT_EQ(line.error_of_next(), 0);
      }
      EXPECT_EQ(line.error_of_next(step_ns), 0) << step_ns << " under way, age " << age_ns;
      for (int message = 0; message < 100; ++message) {
        ASSERT_EQ(line.error_of_next(), 0) << step_ns << " after it, age " << age_ns;
      }
      EXPECT_EQ(line.stamp_error(), 0);
    }
  }
}

TEST(StampClock, MessagesThatABusyMachineDelaysAfterAStepAreNotOfTheFuture) {
  // A scan, and a queue of late scans that drains: one late message must not affect the next ones.
  for (const std::int64_t step_ns : {400 * kMs, -400 * kMs}) {
    Line line(105 * kMs);
    for (int message = 0; message < 100; ++message) {
      line.error_of_next();
    }
    line.error_of_next(step_ns);
    for (std::int64_t age_ms = 380; age_ms > 0; age_ms -= 19) {
      line.set_age(std::max<std::int64_t>(age_ms, 105) * kMs);
      EXPECT_EQ(line.error_of_next(), 0) << step_ns << ", age " << age_ms;
    }
  }
}

TEST(StampClock, MessageUnderWayForLongerThanUsualWhenTheClockIsSetBackIsNotOfTheFuture) {
  Line line(20 * kMs);
  for (int message = 0; message < 100; ++message) {
    line.error_of_next();
  }
  line.set_age(350 * kMs);
  EXPECT_EQ(line.error_of_next(-400 * kMs), 0);
}

TEST(StampClock, SlewOfNtpIsFollowedWithoutAStep) {
  Line line(5 * kMs);
  for (int message = 0; message < 1000; ++message) {
    line.slew(10'000);  // 0.5 ms per s.
    ASSERT_LT(std::abs(line.error_of_next()), 50'000);
  }
}

TEST(StampClock, ReadingThatIsLateByAMillisecondShiftsNoStampByMoreThanASlew) {
  StampClock clock;
  std::int64_t age_ns = 0;
  for (std::int64_t time_ns = kSteadyNs; time_ns < 2 * kSteadyNs; time_ns += 20 * kMs) {
    const std::int64_t late_ns = time_ns % (200 * kMs) == 100 * kMs ? kMs : 0;
    const Instant now{time_ns, time_ns + kRosNs + late_ns};
    EXPECT_LE(std::abs(clock.time_of(time_ns + kRosNs, now, age_ns) - time_ns), 20'000);
  }
}

TEST(StampClock, WithoutAReadingAStampIsItsTime) { EXPECT_EQ(StampClock().stamp_of(kSteadyNs), kSteadyNs); }

}  // namespace
}  // namespace mtr_core
