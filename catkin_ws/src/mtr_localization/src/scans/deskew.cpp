/// @file
/// Conversion of a sweep, with the LiDAR pose at the time of each beam.
// SPDX-License-Identifier: Apache-2.0
#include "scans/deskew.hpp"

#include <algorithm>
#include <cmath>

#include "map_names.hpp"
#include "scans/ground.hpp"

namespace mtr_localization {
namespace {

// Limits of the range difference of neighbouring beams on one surface: slope of a surface met at 80 degrees, and noise.
constexpr double kMaxSlope = 5.7;
constexpr double kNoiseBetweenNeighboursM = 0.06;
// Number of beams on either side that can support a return.
constexpr int kNeighbours = 2;

class Converter {
 public:
  Converter(const Sweep& sweep, const FilterHistory& motion, ScanPoints& scan)
      : sweep_(sweep),
        motion_(motion),
        scan_(scan),
        odom_from_ref_(motion.odom_at(scan.stamp_ns)),
        input_(motion.at(motion.nearest(scan.stamp_ns)).input) {}

  void run() {
    // The robot's motion within a few ms is linear: its pose is computed for some beams and interpolated in between.
    const std::size_t beams = sweep_.ranges_m.size();
    for (std::size_t first = 0; first < beams; first += kBeamsPerPiece) {
      convert_piece(first, std::min(first + kBeamsPerPiece, beams));
    }
  }

 private:
  static constexpr std::size_t kBeamsPerPiece = 32;

  PoseVector lidar_at(std::size_t beam) const {
    PoseVector mount = sweep_.mount;
    // Tilt with the nose up shifts the LiDAR backwards.
    mount.head<2>() -= sweep_.mount_height_m * input_.slope;
    return compose(relative(odom_from_ref_, motion_.odom_at(sweep_.beam_ns(beam))), mount);
  }

  void convert_piece(std::size_t first, std::size_t end) {
    const PoseVector begin_pose = lidar_at(first);
    const std::size_t last = std::min(end, sweep_.ranges_m.size() - 1);
    const PoseVector end_pose = lidar_at(last);
    const Eigen::Vector2d shift = end_pose.head<2>() - begin_pose.head<2>();
    const double turn = wrapped(end_pose.z() - begin_pose.z());
    for (std::size_t beam = first; beam < end; ++beam) {
      if (is_return(beam) && is_backed(beam)) {
        const double share = last > first ? static_cast<double>(beam - first) / static_cast<double>(last - first) : 0.0;
        const double angle = begin_pose.z() + share * turn + sweep_.angle_min_rad +
                             static_cast<double>(beam) * sweep_.angle_increment_rad;
        const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
        add(begin_pose.head<2>() + share * shift, direction, sweep_.ranges_m[beam]);
      }
    }
  }

  void add(const Eigen::Vector2d& lidar, const Eigen::Vector2d& direction, double range) {
    // The scan plane of a tilted robot meets the ground, and projected points are nearer.
    const double climb = input_.slope.dot(direction);
    if (!may_be_ground(climb * range, range, input_.slope_sigma)) {
      const Eigen::Vector2d beam = range * (direction - 0.5 * climb * input_.slope);
      scan_.points.push_back({lidar + beam, direction, range, climb * range, static_cast<int>(sweep_.lidar)});
    }
  }

  bool is_return(std::size_t beam) const {
    const double range = sweep_.ranges_m[beam];
    return std::isfinite(range) && range > 0.0 && range >= sweep_.range_min_m && range <= sweep_.range_max_m;
  }

  bool is_backed(std::size_t beam) const {
    const double range = sweep_.ranges_m[beam];
    const double step = kMaxSlope * range * std::abs(sweep_.angle_increment_rad);
    for (int offset = -kNeighbours; offset <= kNeighbours; ++offset) {
      const std::size_t other = beam + static_cast<std::size_t>(offset);
      if (offset != 0 && other < sweep_.ranges_m.size() && is_return(other) &&
          std::abs(sweep_.ranges_m[other] - range) <= kNoiseBetweenNeighboursM + std::abs(offset) * step) {
        return true;
      }
    }
    return false;
  }

  const Sweep& sweep_;
  const FilterHistory& motion_;
  ScanPoints& scan_;
  PoseVector odom_from_ref_;
  const FilterInput& input_;
};

}  // namespace

ScanPoints deskew(const ScanSet& set, const FilterHistory& motion) {
  ScanPoints scan{motion.at(set.step).stamp_ns, {}};
  for (const Sweep& sweep : set.sweeps) {
    Converter(sweep, motion, scan).run();
  }
  return scan;
}

}  // namespace mtr_localization
