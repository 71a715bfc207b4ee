/// @file
/// Pose of the filter, and consistency of its covariance.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "motion/pose_filter.hpp"

namespace mtr_localization {
namespace {

constexpr double kStepS = 0.02;

/// Drive of 40 s, straight and curved with two stops, with sensor errors as specified by the parameters.
class NoisyDrive {
 public:
  explicit NoisyDrive(unsigned seed) : random_(seed) {
    wheel_scale_ = draw(parameters_.wheel_scale_sigma);
    gyro_scale_ = draw(parameters_.gyro_scale_sigma);
    bias_ = draw(0.02);
  }

  void run() {
    stand(2.0);
    move(0.8, 0.0, 10.0);
    move(0.0, 0.5, 3.0);
    stand(2.0);
    move(0.5, 0.2, 15.0);
    move(-0.5, 0.0, 6.0);
    stand(2.0);
  }

  /// Returns squared errors of x, y and heading in units of the predicted variances.
  std::array<double, 3> normalised_squares() const {
    const auto covariance = reckoning_.pose_covariance();
    const double turn = std::remainder(reckoning_.heading_rad() - heading_, 2.0 * M_PI);
    return {std::pow(reckoning_.x_m() - x_, 2) / covariance(0, 0),
            std::pow(reckoning_.y_m() - y_, 2) / covariance(1, 1), turn * turn / covariance(2, 2)};
  }

  const PoseFilter& reckoning() const { return reckoning_; }

 private:
  double draw(double sigma) { return sigma * normal_(random_); }

  double gyro_rate(double true_rate) {
    bias_ += draw(parameters_.gyro_bias_walk_radps_per_sqrt_s * std::sqrt(kStepS));
    return true_rate / (1.0 + gyro_scale_) + bias_ + draw(parameters_.gyro_noise_radps_per_sqrt_hz / std::sqrt(kStepS));
  }

  void stand(double duration_s) {
    for (int step = 0; step < std::lround(duration_s / kStepS); ++step) {
      reckoning_.stand(kStepS, gyro_rate(0.0));
    }
  }

  void move(double speed, double rate, double duration_s) {
    for (int step = 0; step < std::lround(duration_s / kStepS); ++step) {
      const double turn_slip = parameters_.turn_slip_m_per_sqrt_rad * std::sqrt(std::abs(rate) * kStepS);
      const double along = speed * kStepS + draw(parameters_.slip_m_per_sqrt_m * std::sqrt(std::abs(speed) * kStepS));
      const double direction = heading_ + 0.5 * rate * kStepS;
      x_ += along * std::cos(direction) + draw(turn_slip);
      y_ += along * std::sin(direction) + draw(turn_slip);
      heading_ += rate * kStepS;
      reckoning_.move({kStepS, speed * kStepS / (1.0 + wheel_scale_), gyro_rate(rate) * kStepS});
    }
  }

  SensorParameters parameters_;
  PoseFilter reckoning_{parameters_};
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  double x_ = 0.0, y_ = 0.0, heading_ = 0.0;
  double wheel_scale_ = 0.0, gyro_scale_ = 0.0, bias_ = 0.0;
};

TEST(PoseFilter, ErrorsOfManyNoisyDrivesAgreeWithTheCovariance) {
  constexpr int kDrives = 300;
  std::array<double, 3> sums{};
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    NoisyDrive drive(seed);
    drive.run();
    const auto squares = drive.normalised_squares();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += squares[i] / kDrives;
    }
  }
  for (const double mean_square : sums) {
    EXPECT_GT(mean_square, 0.75);
    EXPECT_LT(mean_square, 1.3);
  }
}

TEST(PoseFilter, CovarianceGrowsWithTheDistance) {
  PoseFilter reckoning{SensorParameters{}};
  double last = 0.0;
  for (int metre = 0; metre < 5; ++metre) {
    reckoning.move({2.0, 1.0, 0.0});
    EXPECT_GT(reckoning.pose_covariance()(0, 0), last);
    last = reckoning.pose_covariance()(0, 0);
  }
}

TEST(PoseFilter, StandingStillDoesNotMoveThePoseAndMeasuresTheBias) {
  PoseFilter reckoning{SensorParameters{}};
  for (int step = 0; step < 50; ++step) {
    reckoning.stand(kStepS, 0.013);
  }
  EXPECT_EQ(reckoning.x_m(), 0.0);
  EXPECT_EQ(reckoning.heading_rad(), 0.0);
  EXPECT_NEAR(reckoning.gyro_bias_radps(), 0.013, 1e-5);
  EXPECT_NEAR(reckoning.gyro_bias_sigma_radps(), SensorParameters{}.gyro_noise_radps_per_sqrt_hz, 1e-4);
}

TEST(PoseFilter, ArcOfAQuarterCircleEndsAtItsRadius) {
  PoseFilter reckoning{SensorParameters{}};
  constexpr int kSteps = 500;
  for (int step = 0; step < kSteps; ++step) {
    reckoning.move({kStepS, 2.0 * M_PI_2 / kSteps, M_PI_2 / kSteps});
  }
  EXPECT_NEAR(reckoning.x_m(), 2.0, 1e-4);
  EXPECT_NEAR(reckoning.y_m(), 2.0, 1e-4);
  EXPECT_NEAR(reckoning.heading_rad(), M_PI_2, 1e-9);
}

TEST(PoseFilter, HeadingStaysWithinHalfATurn) {
  PoseFilter reckoning{SensorParameters{}};
  reckoning.move({1.0, 0.0, 3.0});
  reckoning.move({1.0, 0.0, 1.0});
  EXPECT_NEAR(reckoning.heading_rad(), 4.0 - 2.0 * M_PI, 1e-12);
}

TEST(PoseFilter, CovarianceIsSymmetric) {
  NoisyDrive drive(7);
  drive.run();
  const auto covariance = drive.reckoning().pose_covariance();
  EXPECT_NEAR(covariance(0, 1), covariance(1, 0), 1e-12);
  EXPECT_NEAR(covariance(0, 2), covariance(2, 0), 1e-12);
  EXPECT_NEAR(covariance(1, 2), covariance(2, 1), 1e-12);
}

}  // namespace
}  // namespace mtr_localization
