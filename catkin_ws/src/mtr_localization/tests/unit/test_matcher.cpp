/// @file
/// Matching of scans with surfaces.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "map_names.hpp"
#include "mtr_surfel_map/testing/synthetic_world.hpp"
#include "tracking/matcher.hpp"

namespace mtr_localization {

namespace synthetic = mtr_surfel_map::synthetic;
namespace {

const PoseVector kTruth(0.4, -0.3, 0.2);

class MatcherTest : public ::testing::Test {
 protected:
  void wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    world.push_back({from, to});
    const Eigen::Vector2d along = (to - from).normalized();
    const Eigen::Vector2d middle = 0.5 * (from + to);
    Eigen::Vector2d normal(-along.y(), along.x());
    normal *= normal.dot(kTruth.head<2>() - middle) > 0.0 ? 1.0 : -1.0;
    for (double at = 0.1; at < (to - from).norm(); at += 0.2) {
      surfels.push_back({from + at * along, normal, 0.2, 0.002, 50});
    }
  }

  void room() {
    wall({-4.0, -3.0}, {4.0, -3.0});
    wall({4.0, -3.0}, {4.0, 3.0});
    wall({4.0, 3.0}, {-4.0, 3.0});
    wall({-4.0, 3.0}, {-4.0, -3.0});
  }

  ScanPoints scan() {
    ScanPoints points;
    for (double angle = -2.35; angle < 2.35; angle += 0.015) {
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      double range = synthetic::cast(world, kTruth.head<2>(), rotation(kTruth.z()) * direction);
      if (range > 0.0) {
        // Alternate beams belong to the two LiDARs.
        const int lidar = static_cast<int>(points.points.size() % kLidars);
        range += range_bias_m[lidar] + 0.01 * normal(random);
        points.points.push_back({range * direction, direction, range, rise_m, lidar});
      }
    }
    return points;
  }

  ScanMatch match(const PoseVector& offset, double sigma_m = 0.05, double sigma_rad = 0.02) {
    map.surfaces = SurfelMap(surfels);
    map.sources = error_sources_of(surfels);
    const Eigen::Matrix3d covariance =
        Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
    return ScanMatcher(TrackingParameters{}).match(scan(), map, {kTruth + offset, covariance, covariance});
  }

  static double least_information(const ScanMatch& match) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(match.correction.information).eigenvalues().minCoeff();
  }

  synthetic::World world;
  std::vector<Surfel> surfels;
  ReferenceMap map;
  Eigen::Vector2d range_bias_m = Eigen::Vector2d::Zero();
  double rise_m = 0.0;
  std::mt19937 random{1};
  std::normal_distribution<double> normal;
};

TEST_F(MatcherTest, OffsetWithinThePriorIsFound) {
  room();
  const ScanMatch found = match({0.06, -0.05, 0.02});
  EXPECT_LT((found.pose - kTruth).head<2>().norm(), 0.003);
  EXPECT_NEAR(found.pose.z(), kTruth.z(), 0.001);
  EXPECT_GT(found.matched, 0.95 * found.points);
}

TEST_F(MatcherTest, PosteriorOfTheFilterIsThePoseFound) {
  room();
  const PoseVector offset(0.03, -0.02, 0.01);
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.0025, 0.0025, 0.0004).asDiagonal();
  PoseFilter filter{SensorParameters{}};
  filter.set_pose(kTruth + offset, covariance);
  ScanMatch found = match(offset);
  filter.consider_sources(map.error_sources());
  filter.correct(found.correction);
  EXPECT_LT((filter.pose() - found.pose).norm(), 1e-6);
}

TEST_F(MatcherTest, WhatStandsInFrontOfTheWallsIsIgnored) {
  room();
  synthetic::add_post(world, 2.0, 0.5, 0.3);
  synthetic::add_post(world, 1.5, -1.5, 0.3);
  EXPECT_LT((match({0.03, -0.02, 0.01}).pose - kTruth).head<2>().norm(), 0.004);
}

TEST_F(MatcherTest, KnownRangeBiasesAreTakenOff) {
  wall({4.0, -3.0}, {4.0, 3.0});
  wall({-1.0, 3.0}, {4.0, 3.0});
  range_bias_m = {0.03, -0.05};
  map.range_bias.value_m = range_bias_m;
  EXPECT_LT((match({0.0, 0.0, 0.0}).pose - kTruth).head<2>().norm(), 0.003);
}

TEST_F(MatcherTest, BiasesThatAreNotSureAreErrorsOfThePose) {
  wall({4.0, -3.0}, {4.0, 3.0});
  wall({-1.0, 3.0}, {4.0, 3.0});
  map.range_bias.covariance << 4e-6, 0.0, 0.0, 9e-6;
  const auto columns = match({0.0, 0.0, 0.0}).correction.vector_by_source.rightCols<kLidars>().eval();
  // Half of the beams belong to each LiDAR, so the larger sigma moves the pose half as much again.
  EXPECT_NEAR(columns.col(1).norm() / columns.col(0).norm(), 1.5, 0.1);
  map.range_bias.covariance << 4e-6, -4e-6, -4e-6, 4.000001e-6;
  const auto opposed = match({0.0, 0.0, 0.0}).correction.vector_by_source.rightCols<kLidars>().eval();
  EXPECT_LT(opposed.norm(), 0.2 * columns.norm());
}

TEST_F(MatcherTest, KnownLeanIsTakenOffWhatIsMetHigher) {
  room();
  // Two of the walls lean inwards by 1 in 5; hits 0.1 m higher are 2 cm nearer.
  rise_m = 0.1;
  world[1] = {{3.98, -3.0}, {3.98, 3.0}};
  world[2] = {{4.0, 2.98}, {-4.0, 2.98}};
  for (Surfel& surfel : surfels) {
    surfel.lean_sigma = 0.01;
  }
  EXPECT_GT((match(PoseVector::Zero()).pose - kTruth).head<2>().norm(), 0.006);
  for (Surfel& surfel : surfels) {
    surfel.lean = surfel.normal.x() < -0.5 || surfel.normal.y() < -0.5 ? 0.2 : 0.0;
  }
  EXPECT_LT((match(PoseVector::Zero()).pose - kTruth).head<2>().norm(), 0.003);
}

TEST_F(MatcherTest, SurfaceIsLessCertainBeyondTheHeightsAtWhichItWasMet) {
  room();
  const auto lasting = [this](double lowest_m, double highest_m) {
    for (Surfel& surfel : surfels) {
      surfel.lean_sigma = 0.02;
      surfel.lowest_rise_m = lowest_m;
      surfel.highest_rise_m = highest_m;
    }
    const ScanMatch found = match(PoseVector::Zero());
    PoseFilter filter{SensorParameters{}};
    filter.set_pose(kTruth, Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
    filter.consider_sources(map.error_sources());
    filter.correct(found.correction);
    return std::sqrt((filter.pose_covariance() - filter.prior_covariance())(0, 0));
  };
  rise_m = 0.1;
  const double met_m = lasting(-0.1, 0.1);
  const double beyond_m = lasting(-0.05, 0.05);
  EXPECT_GT(beyond_m, 2.0 * met_m);
  rise_m = -0.1;
  EXPECT_NEAR(lasting(-0.05, 0.05), beyond_m, 0.1 * beyond_m);
  rise_m = 0.04;
  EXPECT_NEAR(lasting(-0.05, 0.05), lasting(-0.1, 0.1), 0.1 * met_m);
}

TEST_F(MatcherTest, SingleWallLeavesTheDirectionAlongItFree) {
  wall({4.0, -30.0}, {4.0, 30.0});
  const ScanMatch found = match({0.03, 0.0, 0.0});
  EXPECT_LT(least_information(found), 1.0);
  EXPECT_NEAR(found.pose.x(), kTruth.x(), 0.003);
}

TEST_F(MatcherTest, EmptyScanSaysNothing) {
  const ScanMatch found = match({0.01, 0.0, 0.0});
  EXPECT_EQ(found.matched, 0);
  EXPECT_EQ(found.correction.information.norm(), 0.0);
  EXPECT_NEAR(found.pose.x(), kTruth.x() + 0.01, 1e-12);
}

TEST_F(MatcherTest, ErrorOfAWallMovesTheFilterAsFarAsItSays) {
  room();
  for (Surfel& surfel : surfels) {
    surfel.sigma_m = surfel.position.x() > 3.99 ? 0.01 : 0.0005;
  }
  PoseFilter filter{SensorParameters{}};
  filter.set_pose(kTruth, Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  for (int i = 0; i < 100; ++i) {
    const ScanMatch found = match({0.0, 0.0, 0.0}, 0.1, 0.1);
    if (i == 0) {
      filter.consider_sources(map.error_sources());
    }
    filter.correct(found.correction);
  }
  // Scans average out, but the wall does not: it determines x together with the opposite wall.
  EXPECT_LT(std::sqrt(filter.prior_covariance()(0, 0)), 0.0005);
  EXPECT_GT(std::sqrt(filter.pose_covariance()(0, 0)), 0.001);
  EXPECT_LT(std::sqrt(filter.pose_covariance()(0, 0)), 0.01);
}

/// Returns the matches of a point near the inner side of a tyre, seen from far ahead at 6 degrees.
int matched_beside_a_tyre(const Eigen::Vector2d& point) {
  ReferenceMap map;
  map.surfaces = SurfelMap({{{8.0, -0.7}, Eigen::Vector2d(-0.17, 0.985).normalized(), 0.5, 0.003, 100}});
  const ScanPoints scan{0, {{point, point.normalized(), point.norm()}}};
  const Eigen::Matrix3d covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
  return ScanMatcher(TrackingParameters{}).match(scan, map, {PoseVector::Zero(), covariance, covariance}).matched;
}

TEST(ScanMatcher, PointWhoseBeamPassesBesideASurfaceDoesNotLieOnIt) {
  EXPECT_EQ(matched_beside_a_tyre({8.0, -0.7}), 1);
  EXPECT_EQ(matched_beside_a_tyre({8.1, -0.69}), 1);
  // On the front of the tyre: near the line of its side, which the beam meets 0.4 m farther on.
  EXPECT_EQ(matched_beside_a_tyre({7.8, -0.83}), 0);
}

}  // namespace
}  // namespace mtr_localization
