/// @file
/// Duplicate messages: their equal stamps differ by nanoseconds on the steady clock.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <tuple>

#include "localizer_fixture.hpp"
#include "mtr_core/stamp_clock.hpp"
#include "scans/scan_queue.hpp"

namespace mtr_localization {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kOffsetNs = 1'700'000'000'000'000'000;

class RepeatedMessageTest : public LocalizerFixture {
 protected:
  void SetUp() override { ASSERT_TRUE(drive(0.0, 0.0, 2.0).valid); }

  void expect_unspoilt() {
    drive(0.0, 0.0, 1.0);
    EXPECT_TRUE(newest.valid) << newest.message.text;
    EXPECT_NEAR(newest.x_m, 0.0, 1e-9);
    EXPECT_TRUE(std::isfinite(newest.covariance[0]));
  }
};

TEST_F(RepeatedMessageTest, WheelsThatFallTwiceOnOneStampOfTheImuSpoilNothing) {
  advance_truth(0.0, 0.0);
  send_imu();
  for (const std::int64_t later_ns : {3'000, 23'000}) {
    WheelSample later = wheels;
    later.stamp_ns += later_ns;
    take(localizer.add_wheels(later));
  }
  expect_unspoilt();
}

TEST_F(RepeatedMessageTest, ImuAndWheelsThatGoBackByNanosecondsAreNotInterrupted) {
  for (const std::int64_t earlier_ns : {0, 250}) {
    take(localizer.add_imu({wheels.stamp_ns - earlier_ns, gyro_bias_radps}));
    WheelSample earlier = wheels;
    earlier.stamp_ns -= earlier_ns;
    take(localizer.add_wheels(earlier));
  }
  step_once(0.0, 0.0);
  EXPECT_TRUE(newest.valid) << newest.message.text;
  expect_unspoilt();
}

/// Rate error of the ROS clock in ppm; speed in m/s; whether the IMU message is also repeated.
class RepeatedOnTheSteadyClockTest : public ::testing::TestWithParam<std::tuple<double, double, bool>> {
 protected:
  static constexpr int kRepeated = 400;

  /// Feeds 50 messages per second of both sensors; after 4 s the robot drives, and one message is repeated 5 ms later.
  void run() {
    for (int number = 0; number < 2 * kRepeated; ++number, now_ns_ += 20 * kMs) {
      const double speed_mps = number > kRepeated / 2 ? std::get<1>(GetParam()) : 0.0;
      wheels_.x_m += 0.02 * speed_mps;
      wheels_.linear_mps = speed_mps;
      const std::int64_t stamp_ns = at(now_ns_).stamp_ns;
      send_imu(stamp_ns, now_ns_ + kMs);
      send_wheels(stamp_ns, now_ns_ + kMs);
      if (number == kRepeated && std::get<2>(GetParam())) {
        send_imu(stamp_ns, now_ns_ + 5 * kMs);
      }
      if (number == kRepeated) {
        send_wheels(stamp_ns, now_ns_ + 5 * kMs);
      }
      invalid_ += number > kRepeated && !newest_.valid ? 1 : 0;
    }
  }

  Estimate newest_;
  int invalid_ = 0;
  WheelSample wheels_{0, 0.0, 0.0, 0.0, 0.0, 0.0};

 private:
  mtr_core::Instant at(std::int64_t time_ns) const {
    const double ahead_ns = static_cast<double>(time_ns) * std::get<0>(GetParam()) * 1e-6;
    return {time_ns, time_ns + kOffsetNs + std::llround(ahead_ns)};
  }

  void send_imu(std::int64_t stamp_ns, std::int64_t now_ns) {
    take(localizer_.add_imu({clock_.time_of(stamp_ns, at(now_ns), imu_age_ns_), 0.0}));
  }

  void send_wheels(std::int64_t stamp_ns, std::int64_t now_ns) {
    wheels_.stamp_ns = clock_.time_of(stamp_ns, at(now_ns), wheels_age_ns_);
    take(localizer_.add_wheels(wheels_));
  }

  void take(const std::vector<Estimate>& estimates) { newest_ = estimates.empty() ? newest_ : estimates.back(); }

  mtr_core::StampClock clock_;
  std::int64_t imu_age_ns_ = 0;
  std::int64_t wheels_age_ns_ = 0;
  std::int64_t now_ns_ = 10'000 * kMs;
  Localizer localizer_{Parameters{}};
};

INSTANTIATE_TEST_SUITE_P(ClocksAndSpeeds, RepeatedOnTheSteadyClockTest,
                         ::testing::Combine(::testing::Values(-50.0, 50.0), ::testing::Values(0.0, 0.5),
                                            ::testing::Bool()));

TEST_P(RepeatedOnTheSteadyClockTest, NothingIsSpoiltNorInterrupted) {
  run();
  EXPECT_EQ(invalid_, 0) << newest_.message.text;
  EXPECT_NEAR(newest_.x_m, wheels_.x_m, 1e-3);
}

TEST(RepeatedSweep, IsRefusedAsIfItsStampWereTheSame) {
  Sweep sweep;
  sweep.angle_max_rad = 0.3;
  sweep.angle_increment_rad = 0.1;
  sweep.range_max_m = 30.0;
  sweep.ranges_m.assign(4, 3.0F);
  ScanQueue queue(20 * kMs);
  ASSERT_EQ(queue.add(sweep), "");
  sweep.stamp_ns += 250;
  EXPECT_EQ(queue.add(sweep).find("A scan is not newer"), 0U);
}

}  // namespace
}  // namespace mtr_localization
