/// @file
/// Compares the fast functions with the standard library, exact to the last digit.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mtr_drive_control/arithmetic.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDraws = 20000;

/// Each value with its neighbours and with both signs.
std::vector<double> with_neighbours(const std::vector<double>& values) {
  std::vector<double> all;
  for (const double value : values) {
    for (const double each : {value, std::nextafter(value, kInfinity), std::nextafter(value, -kInfinity)}) {
      all.push_back(each);
      all.push_back(-each);
    }
  }
  return all;
}

bool is_same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

TEST(Arithmetic, WrappedAngleIsTheStandardRemainder) {
  std::vector<double> angles = with_neighbours(
      {0.0, 0.5 * kPi, kPi, 1.5 * kPi, 2.0 * kPi, 2.5 * kPi, 3.0 * kPi, 4.0 * kPi, 5.0 * kPi, 100.0, 1e9, kInfinity});
  angles.push_back(std::numeric_limits<double>::quiet_NaN());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> draw(-12.0, 12.0);
  for (int i = 0; i < kDraws; ++i) {
    angles.push_back(draw(random));
  }
  for (const double angle : angles) {
    EXPECT_TRUE(is_same(wrapped_rad(angle), std::remainder(angle, 2.0 * kPi))) << angle;
  }
}

TEST(Arithmetic, FlooredIsTheStandardFloor) {
  std::vector<double> values = with_neighbours({0.0, 0.1, 0.5, 1.0, 2.0, 63.0, 64.0, 1e6});
  std::mt19937 random(2);
  std::uniform_real_distribution<double> draw(-300.0, 300.0);
  for (int i = 0; i < kDraws; ++i) {
    values.push_back(draw(random));
  }
  for (const double value : values) {
    EXPECT_EQ(floored(value), static_cast<int>(std::floor(value))) << value;
  }
}

TEST(Arithmetic, RoundedIndexIsTheStandardRoundWithinTheSize) {
  std::vector<double> values = with_neighbours({0.0, 0.5, 1.0, 1.5, 2.5, 359.5, 718.5, 719.0, 719.5, 720.0, 1e20});
  values.push_back(kInfinity);
  values.push_back(std::numeric_limits<double>::quiet_NaN());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-10.0, 730.0);
  for (int i = 0; i < kDraws; ++i) {
    values.push_back(draw(random));
  }
  for (const std::size_t size : {std::size_t{1}, std::size_t{719}, std::size_t{720}}) {
    for (const double value : values) {
      const double rounded = std::round(value);
      const bool is_index = rounded >= 0.0 && rounded < static_cast<double>(size);
      const std::optional<std::size_t> expected =
          is_index ? std::optional<std::size_t>(static_cast<std::size_t>(rounded)) : std::nullopt;
      EXPECT_EQ(rounded_index(value, size), expected) << value << " of " << size;
    }
  }
}

TEST(Arithmetic, LimitsOfDistancesAreExactAtTheLimit) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int i = 0; i < kDraws; ++i) {
    const Point a{draw(random), draw(random)};
    const Point b{draw(random), draw(random)};
    const double apart_m = distance_m(a, b);
    for (const double limit_m : {apart_m, std::nextafter(apart_m, 9.0), std::nextafter(apart_m, 0.0), 0.05, 0.4}) {
      EXPECT_EQ(is_nearer(a, b, limit_m), apart_m < limit_m);
      EXPECT_EQ(is_within(a, b, limit_m), apart_m <= limit_m);
    }
  }
}

TEST(Arithmetic, DistanceWithoutAValueIsNotWithinALimit) {
  const Point unknown{std::numeric_limits<double>::quiet_NaN(), 0.0};
  EXPECT_FALSE(is_nearer(unknown, {}, 1.0));
  EXPECT_FALSE(is_within(unknown, {}, 1.0));
  EXPECT_FALSE(is_within({kInfinity, 0.0}, {}, 1.0));
}

}  // namespace
}  // namespace mtr_drive_control
