/// @file
/// Compares the tables by beam with the formulas for one beam, exact to the last digit.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "mtr_drive_control/collision/beams.hpp"
#include "mtr_drive_control/collision/view.hpp"
#include "scene.hpp"

namespace mtr_drive_control {
namespace {

const LidarMount kMount{-0.2, 0.01, kTestPi};

Sweep sweep_of(std::size_t beams, double time_increment_s) {
  Sweep sweep = *Scene().sweep(Pose(), 7'000'000'000);
  sweep.ranges_m.resize(beams, 3.0F);
  sweep.time_increment_s = time_increment_s;
  return sweep;
}

Motion motion_of(const Velocity& velocity) { return {7'003'000'000, Pose(1.5, -2.5, 0.7), velocity}; }

void expect_same(const Pose& a, const Pose& b) {
  for (const Point& point : {Point{0.0, 0.0}, Point{1.0, 0.0}, Point{-0.3, 2.0}}) {
    EXPECT_EQ(a.apply(point).x_m, b.apply(point).x_m);
    EXPECT_EQ(a.apply(point).y_m, b.apply(point).y_m);
  }
  EXPECT_EQ(a.heading_rad(), b.heading_rad());
}

/// Returns the pose of a base on a circle, or straight if it does not turn, without the optimization for the latter.
Pose moved(const Motion& motion, std::int64_t time_ns) {
  const double time_s = static_cast<double>(time_ns - motion.stamp_ns) * 1e-9;
  const double turn = motion.velocity.angular_radps * time_s;
  const double chord =
      motion.velocity.linear_mps * time_s * (std::abs(turn) < 1e-6 ? 1.0 : std::sin(turn / 2.0) * 2.0 / turn);
  const Point end = motion.odom_from_base.apply({chord * std::cos(turn / 2.0), chord * std::sin(turn / 2.0)});
  return {end.x_m, end.y_m, motion.odom_from_base.heading_rad() + turn};
}

TEST(BeamPoses, EachIsThatOfItsTime) {
  for (const Velocity& velocity : {Velocity{}, Velocity{0.5, 0.0}, Velocity{0.0, 0.6}, Velocity{-0.3, -0.2}}) {
    for (const double time_increment_s : {0.0, 27.8e-6, 1e-4}) {
      for (const std::size_t beams : {std::size_t{719}, std::size_t{720}}) {
        const Sweep sweep = sweep_of(beams, time_increment_s);
        const Motion motion = motion_of(velocity);
        const BeamPoses poses(sweep, motion);
        for (std::size_t beam = 0; beam < beams; ++beam) {
          expect_same(poses.at(beam), moved(motion, sweep.time_ns(static_cast<double>(beam))));
        }
        expect_same(poses.middle(), moved(motion, sweep.time_ns(0.5 * static_cast<double>(beams))));
      }
    }
  }
}

TEST(BeamDirections, AreThoseOfTheMount) {
  BeamDirections directions(kMount);
  Sweep sweep = sweep_of(720, 0.0);
  const auto expect_follows = [&] {
    directions.follow(sweep);
    for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
      for (const double range_m : {0.0, 1.0, 5.7}) {
        EXPECT_EQ(directions.in_base(range_m, beam).x_m, kMount.in_base(range_m, sweep.angle_of(beam)).x_m);
        EXPECT_EQ(directions.in_base(range_m, beam).y_m, kMount.in_base(range_m, sweep.angle_of(beam)).y_m);
      }
    }
  };
  expect_follows();
  sweep.angle_min_rad += 0.1;
  expect_follows();
  sweep.angle_increment_rad *= -0.5;
  expect_follows();
  sweep.ranges_m.resize(400);
  expect_follows();
  sweep.ranges_m.resize(700);
  expect_follows();
}

/// Returns the bearing of a point by the formulas of one beam.
std::optional<Bearing> plain_bearing(const Sweep& sweep, const Motion& motion, const Point& point) {
  const std::size_t beams = sweep.ranges_m.size();
  const std::size_t middle = beams / 2;
  std::optional<Bearing> bearing;
  double beam = 0.5 * static_cast<double>(beams);
  for (int i = 0; i < 2; ++i) {
    const Point in_base = moved(motion, sweep.time_ns(beam)).undo(point);
    const double dx = in_base.x_m - kMount.x_m;
    const double dy = in_base.y_m - kMount.y_m;
    const double angle_rad = std::atan2(dy, dx) - kMount.yaw_rad;
    beam = std::round(static_cast<double>(middle) +
                      std::remainder(angle_rad - sweep.angle_of(middle), 2.0 * kTestPi) / sweep.angle_increment_rad);
    if (beam < 0.0 || beam >= static_cast<double>(beams)) {
      return std::nullopt;
    }
    bearing = Bearing{static_cast<std::size_t>(beam), std::hypot(dx, dy)};
  }
  return bearing;
}

TEST(View, BearingsAreThoseOfThePlainFormulas) {
  int in_view = 0;
  for (const Velocity& velocity : {Velocity{}, Velocity{0.5, 0.0}, Velocity{0.3, 1.2}}) {
    for (const double time_increment_s : {0.0, 27.8e-6}) {
      const Sweep sweep = sweep_of(720, time_increment_s);
      const View view(sweep, kMount, motion_of(velocity), std::vector<double>(720, 3.0));
      for (double x = -4.0; x <= 6.0; x += 0.13) {
        for (double y = -7.0; y <= 3.0; y += 0.17) {
          const std::optional<Bearing> found = view.bearing_of({x, y});
          const std::optional<Bearing> expected = plain_bearing(sweep, motion_of(velocity), {x, y});
          ASSERT_EQ(found.has_value(), expected.has_value());
          in_view += found ? 1 : 0;
          EXPECT_TRUE(!found || (found->beam == expected->beam && found->range_m == expected->range_m));
        }
      }
    }
  }
  EXPECT_GT(in_view, 10000);
}

TEST(Footprint, ContainsWhatHasNoDistance) {
  const Footprint footprint = test_shape(true).footprint;
  const double front_m = footprint.front_m;
  const double side_m = footprint.half_width_m;
  for (const double x_m :
       {-footprint.rear_m, std::nextafter(-footprint.rear_m, -9.0), 0.0, front_m, std::nextafter(front_m, 9.0), 1.0}) {
    for (const double y_m : {-side_m, std::nextafter(-side_m, -9.0), 0.0, side_m, std::nextafter(side_m, 9.0)}) {
      EXPECT_EQ(footprint.contains({x_m, y_m}), footprint.distance_to({x_m, y_m}) == 0.0);
    }
  }
}

}  // namespace
}  // namespace mtr_drive_control
