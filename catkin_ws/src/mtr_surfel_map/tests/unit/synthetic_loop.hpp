/// @file
/// Key frames of a drive round the Car in a synthetic scene, with the true poses.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <vector>

#include "mtr_core/sensor_figures.hpp"
#include "mtr_surfel_map/adjustment/parameters.hpp"
#include "mtr_surfel_map/se2.hpp"
#include "mtr_surfel_map/testing/synthetic_world.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map::synthetic {

/// Properties of the drive and the sensors.
struct LoopOptions {
  std::string scene = "lot";
  unsigned seed = 1;
  double range_noise_m = 0.01;
  double range_bias_m = 0.0;
  /// Added to the ranges of the front LiDAR, subtracted from the ranges of the rear one.
  double opposed_bias_m = 0.0;
  /// True distance over wheel distance, less 1.
  double wheel_scale = 0.003;
  /// True turn over gyro turn, less 1.
  double gyro_scale = 0.0;
  /// Noise of wheels and gyro relative to the covariances of the key frames.
  double motion_noise_factor = 1.0;
  /// Tilt of the scan plane on uneven ground, 1 sigma at each place; the sides of the Car lean inwards by 1 in 5.
  double tilt_sigma_rad = 0.0;
  /// Driven part of a full circuit.
  double turns = 1.05;
  /// Drives round three sides of the Car, because the fourth is blocked, and back to the start.
  bool to_and_fro = false;
  /// Without it, the robot does not see backwards.
  bool rear_lidar = true;
  /// A person walks past in a straight line during the drive.
  bool person = false;
  /// Rain drops per sweep.
  int drops = 0;
  /// Distance of the path from the Car.
  double clearance_m = 1.6;
};

struct Loop {
  World world;
  std::vector<KeyFrame> key_frames;
  std::vector<PoseVector> truth;
};

/// Returns poses every 0.25 m on a rounded rectangle round the Car, counterclockwise, heading along the path.
inline std::vector<PoseVector> way_round(double clearance_m, double turns) {
  std::vector<PoseVector> way;
  const double a = 2.2 + clearance_m;
  const double b = 0.9 + clearance_m;
  const auto place = [&](double angle) -> Eigen::Vector2d {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double radius = std::pow(std::pow(std::abs(c) / a, 4.0) + std::pow(std::abs(s) / b, 4.0), -0.25);
    return {radius * c, radius * s};
  };
  Eigen::Vector2d last = place(0.1) - Eigen::Vector2d(1.0, 0.0);
  for (double angle = 0.1; angle < 0.1 + 2.0 * M_PI * turns; angle += 0.001) {
    const Eigen::Vector2d here = place(angle);
    if ((here - last).norm() >= 0.25) {
      const Eigen::Vector2d ahead = place(angle + 0.01) - here;
      way.emplace_back(here.x(), here.y(), std::atan2(ahead.y(), ahead.x()));
      last = here;
    }
  }
  return way;
}

/// Returns the path, a turn on the spot at its end, and the way back.
inline std::vector<PoseVector> there_and_back(std::vector<PoseVector> way) {
  constexpr int kTurnSteps = 12;
  const std::vector<PoseVector> there = way;
  for (int step = 1; step < kTurnSteps; ++step) {
    way.push_back(there.back() + PoseVector(0.0, 0.0, M_PI * step / kTurnSteps));
  }
  for (auto pose = there.rbegin(); pose != there.rend(); ++pose) {
    way.push_back(*pose + PoseVector(0.0, 0.0, M_PI));
  }
  return way;
}

// Noise of wheels and gyro that localization assumes.
inline constexpr double kSlipMPerSqrtM = mtr_core::sensor_figures::kAssumedSlipMPerSqrtM.value;
inline constexpr double kTurnSlipMPerSqrtRad = mtr_core::sensor_figures::kAssumedTurnSlipMPerSqrtRad.value;
inline constexpr double kGyroNoiseRadpsPerSqrtHz = mtr_core::sensor_figures::kAssumedGyroNoiseRadpsPerSqrtHz.value;

/// Simulation of one drive and its scans.
class Drive {
 public:
  explicit Drive(const LoopOptions& options) : options_(options), random_(options.seed) {}

  Loop run() {
    Loop loop;
    loop.world = world_of(options_.scene);
    loop.truth = way_round(options_.clearance_m, options_.turns);
    if (options_.to_and_fro) {
      loop.truth = there_and_back(loop.truth);
    }
    for (std::size_t i = 0; i < loop.truth.size(); ++i) {
      KeyFrame frame;
      frame.stamp_ns = static_cast<std::int64_t>(i) * 500'000'000;
      frame.pose = loop.truth[i];
      if (i > 0) {
        move(loop.truth[i - 1], loop.truth[i], frame);
        frame.pose = compose(loop.key_frames.back().pose, frame.motion);
      }
      frame.scan = scan(loop.world, loop.truth[i], 0.5 * static_cast<double>(i));
      frame.scan.stamp_ns = frame.stamp_ns;
      loop.key_frames.push_back(frame);
    }
    return loop;
  }

 private:
  double draw(double sigma) { return sigma * normal_(random_); }

  void move(const PoseVector& from, const PoseVector& to, KeyFrame& frame) {
    PoseVector motion = relative(from, to);
    const double distance = motion.head<2>().norm();
    const double turn = std::abs(motion[2]);
    const double slip_m =
        std::sqrt(kSlipMPerSqrtM * kSlipMPerSqrtM * distance + kTurnSlipMPerSqrtRad * kTurnSlipMPerSqrtRad * turn);
    const double turn_rad =
        std::hypot(kGyroNoiseRadpsPerSqrtHz * std::sqrt(0.5), AdjustmentParameters{}.gyro_scale_sigma * turn) + 1e-4;
    frame.motion_covariance = Eigen::Vector3d(slip_m, slip_m, turn_rad).cwiseAbs2().asDiagonal();
    motion.head<2>() /= 1.0 + options_.wheel_scale;
    motion[2] /= 1.0 + options_.gyro_scale;
    const double factor = options_.motion_noise_factor;
    frame.motion = motion + factor * PoseVector(draw(slip_m), draw(slip_m), draw(turn_rad));
  }

  ScanPoints scan(World world, const PoseVector& robot, double time_s) {
    if (options_.person) {
      add_post(world, -3.0, -8.0 + 0.9 * time_s, 0.08);
      add_post(world, -2.8, -7.8 + 0.9 * time_s, 0.08);
    }
    const double kept = 0.8;
    tilt_rad_ = kept * tilt_rad_ + std::sqrt(1.0 - kept * kept) * options_.tilt_sigma_rad *
                                       Eigen::Vector2d(normal_(random_), normal_(random_));
    ScanPoints scan;
    sweep(world, robot, {0.2, 0.0, 0.0}, 0, scan);
    if (options_.rear_lidar) {
      sweep(world, robot, {-0.2, 0.0, M_PI}, 1, scan);
    }
    return scan;
  }

  void sweep(const World& world, const PoseVector& robot, const PoseVector& mount, int lidar, ScanPoints& scan) {
    const double bias_m = options_.range_bias_m + (lidar == 0 ? 1.0 : -1.0) * options_.opposed_bias_m;
    constexpr int kBeams = 720;
    const double field = 1.5 * M_PI;
    std::uniform_int_distribution<int> any_beam(0, kBeams - 1);
    std::vector<bool> wet(kBeams, false);
    for (int drop = 0; drop < options_.drops; ++drop) {
      wet[static_cast<std::size_t>(any_beam(random_))] = true;
    }
    const PoseVector from = compose(robot, mount);
    for (int beam = 0; beam < kBeams; ++beam) {
      const double angle = -field / 2.0 + field * beam / (kBeams - 1);
      double range = cast(world, from.head<2>(), rotation(from[2] + angle) * Eigen::Vector2d::UnitX());
      if (wet[static_cast<std::size_t>(beam)]) {
        range = std::uniform_real_distribution<double>(0.3, range > 0.0 ? range : 10.0)(random_);
      } else if (range > 0.0) {
        const Eigen::Vector2d beam_in_world = rotation(from[2] + angle) * Eigen::Vector2d::UnitX();
        const bool meets_car = (from.head<2>() + range * beam_in_world).norm() < 2.5;
        range += meets_car ? 0.2 * range * tilt_rad_.dot(beam_in_world) : 0.0;
      }
      if (range > 0.1 && range < 30.0) {
        const double measured = range + bias_m + draw(options_.range_noise_m);
        const Eigen::Vector2d direction = rotation(mount[2] + angle) * Eigen::Vector2d::UnitX();
        scan.points.push_back({mount.head<2>() + measured * direction, direction, measured, 0.0, lidar});
      }
    }
  }

  LoopOptions options_;
  Eigen::Vector2d tilt_rad_ = Eigen::Vector2d::Zero();
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
};

inline Loop drive(const LoopOptions& options) { return Drive(options).run(); }

/// Largest and root mean square position error, in m, and root mean square heading error, in rad.
struct PoseErrors {
  double rms_m = 0.0;
  double max_m = 0.0;
  double rms_rad = 0.0;
};

inline PoseErrors errors_of(const std::vector<KeyFrame>& frames, const std::vector<PoseVector>& truth) {
  PoseErrors errors;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const PoseVector error = relative(truth[i], frames[i].pose);
    errors.rms_m += error.head<2>().squaredNorm() / static_cast<double>(frames.size());
    errors.rms_rad += error[2] * error[2] / static_cast<double>(frames.size());
    errors.max_m = std::max(errors.max_m, error.head<2>().norm());
  }
  errors.rms_m = std::sqrt(errors.rms_m);
  errors.rms_rad = std::sqrt(errors.rms_rad);
  return errors;
}

}  // namespace mtr_surfel_map::synthetic
