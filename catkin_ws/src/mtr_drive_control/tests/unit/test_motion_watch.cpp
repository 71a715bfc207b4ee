/// @file
/// Bases, odometries and gyros that contradict the commands (A7).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "mtr_drive_control/motion_watch.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::int64_t kPeriodNs = 20'000'000;

class MotionWatchTest : public ::testing::Test {
 protected:
  /// Returns the code of the first problem with its time in s, during this motion of wheels and gyro; empty without
  /// one.
  std::string drive(const Velocity& sent, const Velocity& wheels, double gyro_radps, double duration_s = 3.0) {
    for (const std::int64_t begun_ns = now_ns; now_ns < begun_ns + static_cast<std::int64_t>(duration_s * 1e9);) {
      const mtr_core::Problem problem = step(sent, wheels, gyro_radps);
      if (problem) {
        told_after_s = static_cast<double>(now_ns - begun_ns) * 1e-9;
        return problem.code;
      }
    }
    return "";
  }

  mtr_core::Problem step(const Velocity& sent, const Velocity& wheels, double gyro_radps) {
    now_ns += kPeriodNs;
    if (odometry_lives) {
      pose = pose.after(wheels, 0.02);
    }
    const double noise = imu_lives ? 1e-3 * static_cast<double>((now_ns / kPeriodNs) % 7) : 0.0;
    return watch.take(now_ns, sent, Motion{now_ns, pose, wheels},
                      ImuReading{now_ns, {noise, -noise, gyro_radps + noise}, {noise, 0.0, 9.81}});
  }

  std::int64_t now_ns = 5'000'000'000;
  Pose pose;
  bool odometry_lives = true;
  bool imu_lives = true;
  double told_after_s = 0.0;
  MotionWatch watch;
};

TEST_F(MotionWatchTest, BaseThatObeysIsWell) {
  EXPECT_EQ(drive({0.7, 0.0}, {0.7, 0.0}, 0.0), "");
  EXPECT_EQ(drive({0.0, -1.2}, {0.0, -1.2}, -1.0), "");
  EXPECT_EQ(drive({}, {}, 0.0), "");
}

TEST_F(MotionWatchTest, BaseThatAnswersLateIsWell) {
  std::vector<Velocity> sent;
  for (int tick = 0; tick < 300; ++tick) {
    // Up and down with the hardest accelerations of drive control.
    const double phase = 0.02 * (tick % 100);
    sent.push_back({phase < 1.0 ? std::min(0.85, phase) : std::max(0.0, 0.85 - 2.4 * (phase - 1.0)), 0.0});
    const Velocity wheels = tick < 15 ? Velocity{} : sent[static_cast<std::size_t>(tick - 15)];
    EXPECT_FALSE(step(sent.back(), wheels, 0.0));
  }
}

TEST_F(MotionWatchTest, FrozenOdometryIsToldWithinASecond) {
  drive({0.7, 0.0}, {0.7, 0.0}, 0.0);
  odometry_lives = false;
  EXPECT_EQ(drive({0.7, 0.0}, {0.7, 0.0}, 0.0), "drive_control.odometry_frozen");
  EXPECT_LE(told_after_s, 0.6);
}

TEST_F(MotionWatchTest, BaseWhoseWheelsStandIsToldWithinASecond) {
  EXPECT_EQ(drive({0.1, 0.0}, {}, 0.0), "drive_control.base_stands");
  EXPECT_LE(told_after_s, 1.0);
}

TEST_F(MotionWatchTest, BaseWhoseWheelsStandIsToldAlthoughItsEncodersFlickerAndItsServosSettle) {
  // A single count of a Jackal's encoder back and forth, and the end of a stop.
  for (const Velocity& flicker : {Velocity{0.00064, 0.001}, Velocity{-0.008, 0.0}, Velocity{0.0, 0.02}}) {
    watch = MotionWatch();
    drive({0.4, 0.0}, {0.4, 0.0}, 0.0);
    const std::int64_t begun_ns = now_ns;
    std::string code;
    for (int tick = 0; tick < 60 && code.empty(); ++tick) {
      code = step({0.4, 0.0}, flicker.scaled(tick % 7 == 0 ? 1.0 : tick % 7 == 3 ? -1.0 : 0.0), 0.0).code;
    }
    EXPECT_EQ(code, "drive_control.base_stands");
    EXPECT_LE(static_cast<double>(now_ns - begun_ns) * 1e-9, 0.6);
  }
}

TEST_F(MotionWatchTest, BaseThatFollowsACrawlIsWell) {
  // Half of the command, uphill, with a count more or less at each tick.
  for (int tick = 0; tick < 500; ++tick) {
    EXPECT_FALSE(step({0.05, 0.0}, {0.025 + 0.008 * (tick % 3 - 1), 0.0}, 0.0));
  }
  for (int tick = 0; tick < 500; ++tick) {
    EXPECT_FALSE(step({0.0, 0.15}, {0.0, 0.075 + 0.02 * (tick % 3 - 1)}, 0.05));
  }
}

TEST_F(MotionWatchTest, BaseThatSetsOffLateOrStandsWhereItTurnsBackIsWell) {
  drive({}, {}, 0.0);
  drive({0.3, 0.0}, {}, 0.0, 0.6);
  EXPECT_EQ(drive({0.3, 0.0}, {0.3, 0.0}, 0.0), "");
  EXPECT_EQ(drive({-0.3, 0.0}, {}, 0.0, 0.4), "");
  EXPECT_EQ(drive({-0.3, 0.0}, {-0.3, 0.0}, 0.0), "");
}

TEST_F(MotionWatchTest, BaseThatStandsWithoutAnOrderToMoveIsWell) {
  EXPECT_EQ(drive({0.03, 0.1}, {0.0, 0.0}, 0.0), "");
}

TEST_F(MotionWatchTest, BaseThatDoesSomethingElseIsTold) {
  EXPECT_EQ(drive({0.7, 0.0}, {0.7, 0.9}, 0.9), "drive_control.base_disobeys");
  EXPECT_LE(told_after_s, 1.0);
}

TEST_F(MotionWatchTest, BaseThatDrivesTheOtherWayIsTold) {
  EXPECT_EQ(drive({0.4, 0.0}, {-0.4, 0.0}, 0.0), "drive_control.base_disobeys");
}

TEST_F(MotionWatchTest, BaseThatMovesByItselfIsTold) {
  EXPECT_EQ(drive({}, {0.5, 0.0}, 0.0), "drive_control.base_disobeys");
}

TEST_F(MotionWatchTest, JoltIsNoContradiction) {
  drive({0.7, 0.0}, {0.7, 0.0}, 0.0);
  EXPECT_EQ(drive({0.7, 0.0}, {0.2, 0.8}, 0.8, 0.3), "");
  EXPECT_EQ(drive({0.7, 0.0}, {0.7, 0.0}, 0.0), "");
}

TEST_F(MotionWatchTest, FrozenImuIsToldInMotionAndNotAtRest) {
  imu_lives = false;
  EXPECT_EQ(drive({}, {}, 0.0), "");
  EXPECT_EQ(drive({0.4, 0.0}, {0.4, 0.0}, 0.0), "drive_control.imu_frozen");
  EXPECT_LE(told_after_s, 1.0);
}

TEST_F(MotionWatchTest, WheelsThatSpinAgainstTheGyroAreTold) {
  EXPECT_EQ(drive({0.0, 1.2}, {0.0, 1.2}, 0.0), "drive_control.wheels_slip");
  EXPECT_LE(told_after_s, 1.0);
}

TEST_F(MotionWatchTest, GyroThatTurnsTheOtherWayIsTold) {
  EXPECT_EQ(drive({0.0, 0.6}, {0.0, 0.6}, -0.6), "drive_control.wheels_slip");
}

TEST_F(MotionWatchTest, SameReadingTakenTwiceIsNoFrozenSensor) {
  for (int tick = 0; tick < 200; ++tick) {
    step({0.5, 0.0}, {0.5, 0.0}, 0.0);
    EXPECT_FALSE(watch.take(now_ns, {0.5, 0.0}, Motion{now_ns, pose, {0.5, 0.0}}, std::nullopt));
  }
}

TEST(ImuReadingTest, WhatNoRobotsImuShowsIsNotPlausible) {
  EXPECT_TRUE((ImuReading{0, {0.1, -0.2, 4.0}, {1.0, -2.0, 9.81}}).is_plausible());
  EXPECT_TRUE((ImuReading{0, {0.0, 0.0, -10.0}, {0.0, 0.0, 160.0}}).is_plausible());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {-686.73, 1e30, kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE((ImuReading{0, {0.0, 0.0, wrong}, {0.0, 0.0, 9.81}}).is_plausible()) << wrong;
    EXPECT_FALSE((ImuReading{0, {wrong, 0.0, 0.0}, {0.0, 0.0, 9.81}}).is_plausible()) << wrong;
    EXPECT_FALSE((ImuReading{0, {0.0, 0.0, 0.0}, {0.0, wrong, 9.81}}).is_plausible()) << wrong;
  }
}

}  // namespace
}  // namespace mtr_drive_control
