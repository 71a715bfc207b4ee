/// @file
/// Profile, stall detection and the closed loop on a simple lift.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>

#include "../../logic/config.hpp"
#include "../../logic/lift/lift.hpp"
#include "../../logic/lift/lift_calibrator.hpp"
#include "../../logic/lift/motion_profile.hpp"
#include "../../logic/lift/stall_detector.hpp"

namespace {

constexpr std::int32_t kStrokeUm = 1200000;
constexpr int kLongestSteps = 2000;

/// Checks each step's limits; returns the steps until it stands on the target.
int run(mtr::MotionProfile* profile, std::int32_t target_um) {
  for (int steps = 1; steps <= kLongestSteps; ++steps) {
    const std::int32_t before_um = profile->speed_um();
    profile->step(target_um);
    EXPECT_LE(std::abs(profile->speed_um()), mtr::kTopSpeedUmPerStep);
    EXPECT_LE(std::abs(profile->speed_um() - before_um), mtr::kAccelerationUmPerStep2);
    if (profile->position_um() == target_um && profile->speed_um() == 0) {
      return steps;
    }
  }
  return kLongestSteps;
}

TEST(MotionProfile, ReachesEveryTargetExactlyWithinItsLimits) {
  for (std::int32_t target_um : {1, 29, 31, 95, 1000, 4567, 38000, 76543, 1200000}) {
    mtr::MotionProfile profile;
    profile.start_at(0);
    EXPECT_LT(run(&profile, target_um), kLongestSteps) << target_um;
    EXPECT_LT(run(&profile, 0), kLongestSteps) << target_um;
  }
}

TEST(MotionProfile, TakesTheTimeOfATrapezoid) {
  mtr::MotionProfile profile;
  profile.start_at(0);
  // 1.2 m at 0.15 m/s and 0.3 m/s^2: 8 s and 0.5 s.
  EXPECT_NEAR(run(&profile, kStrokeUm), 850, 5);
}

TEST(MotionProfile, TurnsRoundWhenTheTargetChanges) {
  mtr::MotionProfile profile;
  profile.start_at(0);
  for (int i = 0; i < 200; ++i) {
    profile.step(kStrokeUm);
  }
  EXPECT_LT(run(&profile, 10000), kLongestSteps);
}

TEST(MotionProfile, StopsWhereItSays) {
  mtr::MotionProfile profile;
  profile.start_at(0);
  for (int i = 0; i < 123; ++i) {
    profile.step(kStrokeUm);
  }
  const std::int32_t point_um = profile.stopping_point_um();
  EXPECT_LE(run(&profile, point_um), mtr::kTopSpeedUmPerStep / mtr::kAccelerationUmPerStep2 + 2);
}

TEST(StallDetector, NoticesStandstillAfterItsTimeOnly) {
  mtr::StallDetector detector(100);
  detector.step(50, 0);
  for (int i = 1; i < mtr::kStallSteps; ++i) {
    EXPECT_FALSE(detector.step(50, 99));
  }
  EXPECT_TRUE(detector.step(50, 99));
}

TEST(StallDetector, IsContentWithProgressInTheRightDirectionOnly) {
  mtr::StallDetector detector(100);
  bool stalled = false;
  for (int i = 0; i < 200; ++i) {
    stalled = stalled || detector.step(50, i * 5);
  }
  EXPECT_FALSE(stalled);
  EXPECT_TRUE(detector.has_progressed());
  for (int i = 0; i < 200; ++i) {
    stalled = stalled || detector.step(-50, i * 5);
  }
  EXPECT_TRUE(stalled);
}

/// Follows the duty at once, above some friction.
class SimpleLift {
 public:
  std::int16_t step(mtr::Lift* lift) {
    const std::int16_t duty = lift->step(position_um, kStrokeUm);
    if (!is_blocked && std::abs(duty) > 20) {
      position_um += duty * mtr::kFullDutySpeedUmPerStep / mtr::kFullDuty;
    }
    return duty;
  }

  bool is_blocked = false;
  std::int32_t position_um = 0;
};

TEST(Lift, ReachesAHeightAndSwitchesOff) {
  mtr::Lift lift;
  SimpleLift plant;
  lift.go_to(600000);
  for (int i = 0; i < 600; ++i) {
    plant.step(&lift);
  }
  EXPECT_NEAR(plant.position_um, 600000, mtr::kArrivedUm);
  EXPECT_EQ(plant.step(&lift), 0);
  EXPECT_FALSE(lift.is_moving());
  EXPECT_FALSE(lift.is_jammed());
}

TEST(Lift, JamsRestsAndTriesAgainWhenFreed) {
  mtr::Lift lift;
  SimpleLift plant;
  plant.is_blocked = true;
  lift.go_to(600000);
  for (int i = 0; i < 2 * mtr::kStallSteps; ++i) {
    plant.step(&lift);
  }
  EXPECT_TRUE(lift.is_jammed());
  EXPECT_EQ(plant.step(&lift), 0);
  plant.is_blocked = false;
  for (int i = 0; i < 700; ++i) {
    plant.step(&lift);
  }
  EXPECT_FALSE(lift.is_jammed());
  EXPECT_NEAR(plant.position_um, 600000, mtr::kArrivedUm);
}

/// Pushes of a blocked lift during a minute in which the host wants these heights in turn.
int pushes(mtr::Lift* lift, SimpleLift* plant, std::int32_t first_um, std::int32_t second_um) {
  constexpr int kStepsPerMinute = 60000 / mtr::kLiftPeriodMs;
  int count = 0;
  bool was_pushing = false;
  for (int i = 0; i < kStepsPerMinute; ++i) {
    lift->go_to(i / 7 % 2 == 0 ? first_um : second_um);
    const bool is_pushing = plant->step(lift) != 0;
    count += is_pushing && !was_pushing ? 1 : 0;
    was_pushing = is_pushing;
  }
  return count;
}

TEST(Lift, TriesOnceMoreAfterAJamWhateverHeightsAreWanted) {
  EXPECT_EQ(mtr::kJamTries, 2);
  for (std::int32_t other_um : {600000, 600001, 500000}) {
    mtr::Lift lift;
    SimpleLift plant;
    plant.is_blocked = true;
    EXPECT_EQ(pushes(&lift, &plant, 600000, other_um), 2) << other_um;
    EXPECT_TRUE(lift.is_jammed() && lift.has_given_up() && !lift.is_moving());
  }
}

TEST(Lift, ThatHasGivenUpMovesOnlyAfterItWasOrderedToHold) {
  mtr::Lift lift;
  SimpleLift plant;
  plant.is_blocked = true;
  pushes(&lift, &plant, 600000, 600000);
  plant.is_blocked = false;
  EXPECT_EQ(pushes(&lift, &plant, 600000, 500000), 0) << "free again, and nothing was decided";
  lift.cut();
  EXPECT_EQ(pushes(&lift, &plant, 600000, 500000), 0) << "a lost link is no decision";
  lift.hold();
  EXPECT_FALSE(lift.is_jammed());
  EXPECT_EQ(plant.step(&lift), 0);
  lift.go_to(600000);
  EXPECT_NE(plant.step(&lift), 0);
}

TEST(Lift, ThatMovedAfterAJamHasAllItsTriesAgain) {
  mtr::Lift lift;
  SimpleLift plant;
  plant.is_blocked = true;
  lift.go_to(600000);
  for (int i = 0; i < 2 * mtr::kStallSteps; ++i) {
    plant.step(&lift);
  }
  EXPECT_TRUE(lift.is_jammed() && !lift.has_given_up());
  plant.is_blocked = false;
  for (int i = 0; i < 2 * mtr::kJamRestSteps; ++i) {
    plant.step(&lift);
  }
  EXPECT_FALSE(lift.is_jammed());
  plant.is_blocked = true;
  EXPECT_EQ(pushes(&lift, &plant, 600000, 600000), 2) << "the push under way, and one more";
}

TEST(Lift, HoldBrakesAndCutStopsAtOnce) {
  mtr::Lift lift;
  SimpleLift plant;
  lift.go_to(600000);
  for (int i = 0; i < 200; ++i) {
    plant.step(&lift);
  }
  const std::int32_t held_um = plant.position_um;
  lift.hold();
  EXPECT_NE(plant.step(&lift), 0);
  for (int i = 0; i < 100; ++i) {
    plant.step(&lift);
  }
  EXPECT_GT(plant.position_um, held_um);
  EXPECT_LT(plant.position_um, held_um + 60000);
  EXPECT_EQ(plant.step(&lift), 0);
  lift.go_to(600000);
  EXPECT_NE(plant.step(&lift), 0);
  lift.cut();
  EXPECT_EQ(plant.step(&lift), 0);
}

/// Sum of readings between two stops.
class SensorWithStops {
 public:
  void step(mtr::LiftCalibrator* calibrator) {
    counts += calibrator->step(static_cast<std::uint16_t>(counts)) / 10;
    counts = std::max(low, std::min(high, counts));
  }

  int low = 700, high = 9000, counts = 5000;
};

TEST(LiftCalibrator, FindsBothStops) {
  mtr::LiftCalibrator calibrator;
  SensorWithStops plant;
  calibrator.start(800);
  for (int i = 0; i < 3000; ++i) {
    plant.step(&calibrator);
  }
  mtr::Calibration found;
  ASSERT_TRUE(calibrator.take(&found));
  EXPECT_EQ(found.low, 700);
  EXPECT_EQ(found.high, 9000);
  EXPECT_EQ(found.stroke_mm, 800);
  EXPECT_FALSE(calibrator.take(&found));
}

TEST(LiftCalibrator, FailsWhenTheStopsAreTooNear) {
  mtr::LiftCalibrator calibrator;
  SensorWithStops plant;
  plant.high = 3000;
  calibrator.start(800);
  for (int i = 0; i < 3000; ++i) {
    plant.step(&calibrator);
  }
  mtr::Calibration found;
  EXPECT_TRUE(calibrator.has_failed());
  EXPECT_FALSE(calibrator.take(&found));
}

}  // namespace
