/// @file
/// Maps of synthetic drives round the Car.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mtr_surfel_map/adjustment/map_adjustment.hpp"
#include "synthetic_loop.hpp"

namespace mtr_surfel_map {
namespace {

using synthetic::drive;
using synthetic::errors_of;
using synthetic::Loop;
using synthetic::LoopOptions;

AdjustedMap map_of(const Loop& loop) { return adjust(loop.key_frames, AdjustmentParameters{}); }

LoopOptions in(const std::string& scene) {
  LoopOptions options;
  options.scene = scene;
  return options;
}

/// Returns the largest position error after the adjustment of a drive in m, or infinity without a valid map.
double largest_error_m(const LoopOptions& options) {
  const Loop loop = drive(options);
  const AdjustedMap map = map_of(loop);
  EXPECT_TRUE(map.valid) << map.message.text;
  return map.valid ? errors_of(map.key_frames, loop.truth).max_m : std::numeric_limits<double>::infinity();
}

/// Returns the mean of squared errors over their variances, per degree of freedom.
double nees_of(const AdjustedMap& map, const std::vector<PoseVector>& truth) {
  double sum = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    Eigen::Vector3d error = map.key_frames[i].pose - truth[i];
    error[2] = wrapped(error[2]);
    sum += error.dot(map.pose_covariances[i].inverse() * error) / 3.0;
  }
  return sum / static_cast<double>(truth.size() - 1);
}

TEST(MapAdjustment, PosesInALotAreTrueToMillimetres) {
  EXPECT_GT(errors_of(drive({}).key_frames, drive({}).truth).max_m, 0.03);
  EXPECT_LT(largest_error_m(in("lot")), 0.005);
}

TEST(MapAdjustment, PosesAmongFourConesAreTrueToACentimetre) { EXPECT_LT(largest_error_m(in("cones")), 0.01); }

TEST(MapAdjustment, PosesRoundTheCarAloneAreTrueToTwoCentimetres) { EXPECT_LT(largest_error_m(in("open")), 0.02); }

TEST(MapAdjustment, SurfacesLieOnTheTrueOnes) {
  const Loop loop = drive({});
  const AdjustedMap map = map_of(loop);
  double squares = 0.0;
  double ratios = 0.0;
  for (const Surfel& surfel : map.surfels) {
    const double distance_m = synthetic::distance_from(loop.world, surfel.position);
    squares += distance_m * distance_m;
    ratios += std::min(9.0, distance_m * distance_m / (surfel.sigma_m * surfel.sigma_m));
  }
  const double count = static_cast<double>(map.surfels.size());
  EXPECT_GT(count, 150.0);
  EXPECT_LT(std::sqrt(squares / count), 0.005);
  // Errors and sigmas agree; each ratio is limited to 9, because a line does not fit at corners.
  EXPECT_LT(ratios / count, 1.5);
  EXPECT_GT(ratios / count, 0.1);
}

TEST(MapAdjustment, PoseErrorsOfManyDrivesAgreeWithTheirCovariances) {
  for (const std::string scene : {"lot", "open"}) {
    double sum = 0.0;
    constexpr unsigned kDrives = 5;
    for (unsigned seed = 1; seed <= kDrives; ++seed) {
      LoopOptions options = in(scene);
      options.seed = seed;
      const Loop loop = drive(options);
      sum += nees_of(map_of(loop), loop.truth) / kDrives;
    }
    // Errors within one drive are correlated: 5 drives are about 15 independent numbers, whose mean is within 0.7 of 1
    // for correct covariances. The covariances are conservative, because the surfaces here have a smaller error than
    // surface_sigma_m.
    EXPECT_LT(sum, 1.7) << scene;
    EXPECT_GT(sum, 0.2) << scene;
  }
}

TEST(MapAdjustment, RangeBiasIsFoundAndTakenOff) {
  for (const double bias_m : {0.02, -0.02}) {
    LoopOptions options = in("open");
    options.range_bias_m = bias_m;
    const Loop loop = drive(options);
    const AdjustedMap map = map_of(loop);
    for (int lidar = 0; lidar < kLidars; ++lidar) {
      const double sigma_m = std::sqrt(map.range_bias.covariance(lidar, lidar));
      EXPECT_NEAR(map.range_bias.value_m[lidar], bias_m, 2.0 * sigma_m);
      EXPECT_LT(sigma_m, 0.005);
    }
    EXPECT_LT(errors_of(map.key_frames, loop.truth).max_m, 0.02);
    std::vector<double> off_m;
    for (const Surfel& surfel : map.surfels) {
      off_m.push_back(synthetic::distance_from(loop.world, surfel.position));
    }
    std::sort(off_m.begin(), off_m.end());
    EXPECT_LT(off_m[off_m.size() * 95 / 100], 0.01);
    // The largest errors belong to single short surfels at corners.
    EXPECT_LT(off_m.back(), 0.025);
  }
}

TEST(MapAdjustment, EachLidarHasABiasOfItsOwn) {
  for (const char* scene : {"open", "cones", "lot"}) {
    LoopOptions options = in(scene);
    options.opposed_bias_m = 0.01;
    const Loop loop = drive(options);
    const AdjustedMap map = map_of(loop);
    EXPECT_NEAR(map.range_bias.value_m[0], 0.01, 2.0 * std::sqrt(map.range_bias.covariance(0, 0))) << scene;
    EXPECT_NEAR(map.range_bias.value_m[1], -0.01, 2.0 * std::sqrt(map.range_bias.covariance(1, 1))) << scene;
    LoopOptions plain = options;
    plain.opposed_bias_m = 0.0;
    EXPECT_NEAR(errors_of(map.key_frames, loop.truth).rms_m,
                errors_of(map_of(drive(plain)).key_frames, loop.truth).rms_m, 0.002)
        << scene;
  }
}

TEST(MapAdjustment, GyroThatTurnsTooLittleBendsNoMap) {
  double right = 0.0;
  double wrong = 0.0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    LoopOptions options = in("open");
    options.seed = seed;
    right += largest_error_m(options);
    // Gyro scale error by the data sheet, without a comparison with full turns: 2 degrees per circuit.
    options.gyro_scale = 0.006;
    wrong += largest_error_m(options);
  }
  EXPECT_LT(wrong, 1.3 * right);
}

TEST(MapAdjustment, TiltOfOneDegreeCostsLessThanThreeTimes) {
  double level = 0.0;
  double tilted = 0.0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    LoopOptions options = in("open");
    options.seed = seed;
    level += largest_error_m(options);
    options.tilt_sigma_rad = M_PI / 180.0;
    tilted += largest_error_m(options);
  }
  EXPECT_LT(tilted, 3.0 * level);
}

TEST(MapAdjustment, ViewsFromHigherOrLowerCountLessAndLeansAreNeverSurerThanBendsAllow) {
  Loop loop = drive(in("lot"));
  const AdjustedMap level = map_of(loop);
  for (std::size_t i = 0; i < loop.key_frames.size(); ++i) {
    for (ScanPoint& point : loop.key_frames[i].scan.points) {
      point.rise_m = (i % 2 == 0 ? 0.03 : -0.03) * point.range_m;
    }
  }
  const AdjustedMap rough = map_of(loop);
  ASSERT_TRUE(level.valid && rough.valid);
  double level_m = 0.0;
  double rough_m = 0.0;
  for (std::size_t i = 1; i < level.pose_covariances.size(); ++i) {
    level_m += std::sqrt(level.pose_covariances[i].topLeftCorner<2, 2>().trace());
    rough_m += std::sqrt(rough.pose_covariances[i].topLeftCorner<2, 2>().trace());
  }
  EXPECT_GT(rough_m, 1.2 * level_m);
  for (const Surfel& surfel : rough.surfels) {
    EXPECT_GE(surfel.lean_sigma, kBendSigma);
    EXPECT_LE(surfel.lean_sigma, kLeanSigma);
  }
}

TEST(MapAdjustment, PersonWhoWalksByLeavesNoSurface) {
  LoopOptions options;
  options.person = true;
  EXPECT_LT(largest_error_m(options), 0.006);
  const Loop loop = drive(options);
  int strangers = 0;
  for (const Surfel& surfel : map_of(loop).surfels) {
    strangers += synthetic::distance_from(loop.world, surfel.position) > 0.05 ? 1 : 0;
  }
  EXPECT_EQ(strangers, 0);
}

TEST(MapAdjustment, RainDoesNotMoveTheMap) {
  LoopOptions options;
  options.drops = 60;
  EXPECT_LT(largest_error_m(options), 0.006);
}

TEST(MapAdjustment, NoisyLidarCostsLittle) {
  LoopOptions options;
  options.range_noise_m = 0.02;
  EXPECT_LT(largest_error_m(options), 0.008);
}

TEST(MapAdjustment, DriftOfDecimetresIsBroughtTogether) {
  LoopOptions options;
  options.motion_noise_factor = 6.0;
  options.seed = 2;
  const Loop loop = drive(options);
  ASSERT_GT(errors_of(loop.key_frames, loop.truth).max_m, 0.12);
  const AdjustedMap map = map_of(loop);
  ASSERT_TRUE(map.valid) << map.message.text;
  EXPECT_LT(errors_of(map.key_frames, loop.truth).max_m, 0.008);
}

TEST(MapAdjustment, FirstKeyFrameStaysWhereItWas) {
  const Loop loop = drive(in("open"));
  const AdjustedMap map = map_of(loop);
  EXPECT_EQ(map.key_frames.front().pose, loop.key_frames.front().pose);
  EXPECT_LT(map.pose_covariances.front().norm(), 1e-9);
}

TEST(MapAdjustment, SameKeyFramesGiveTheSameMapToTheLastBit) {
  const Loop loop = drive(in("open"));
  const AdjustedMap first = map_of(loop);
  const AdjustedMap second = map_of(loop);
  ASSERT_EQ(first.surfels.size(), second.surfels.size());
  for (std::size_t i = 0; i < first.surfels.size(); ++i) {
    EXPECT_EQ(first.surfels[i].position, second.surfels[i].position);
  }
  EXPECT_EQ(first.key_frames.back().pose, second.key_frames.back().pose);
}

}  // namespace
}  // namespace mtr_surfel_map
