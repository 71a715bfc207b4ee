/// @file
/// Association of returns with surface elements.
// SPDX-License-Identifier: Apache-2.0
#include "adjustment/observations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mtr_surfel_map/se2.hpp"

namespace mtr_surfel_map {
namespace {

// Distance from the surface, as a share of the gate, at which a return has a quarter of its weight.
constexpr double kHalfway = 0.5;

/// Weighted sums over the returns of one key frame from one surfel.
struct Sums {
  double weight = 0.0;
  double variance = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, kLidars> directions = Eigen::Matrix<double, 2, kLidars>::Zero();
  double rise_m = 0.0;
  double lowest_rise_m = std::numeric_limits<double>::infinity();
  double highest_rise_m = -std::numeric_limits<double>::infinity();
  int beams = 0;
};

/// Returns the variance of one return along the normal in m^2, from the range and direction errors of its beam.
double variance_of(const ScanPoint& point, double cosine, double range_noise_m, double bearing_sigma_rad) {
  const double along = range_noise_m * cosine;
  const double across = bearing_sigma_rad * point.range_m * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return along * along + across * across;
}

/// Collects the views of one key frame at a time.
class Collector {
 public:
  Collector(const SurfelMap& map, double gate_m, const AdjustmentParameters& parameters)
      : map_(map), gate_m_(gate_m), parameters_(parameters), sums_(map.surfels().size()) {}

  void add(const KeyFrame& frame, const RangeBias& range_bias) {
    const Eigen::Matrix2d turn = rotation(frame.pose[2]);
    const double noise_m = parameters_.range_noise_m / std::sqrt(std::max(1, frame.sweeps));
    for (const ScanPoint& point : frame.scan.points) {
      const Eigen::Vector2d position = range_bias.corrected(point);
      const Eigen::Vector2d seen_along = turn * point.direction;
      const std::optional<SurfelMatch> match = map_.match(turn * position + frame.pose.head<2>(), gate_m_, seen_along);
      if (match) {
        const double cosine = -match->surfel->normal.dot(seen_along);
        const double part = match->distance_along_normal_m / (kHalfway * gate_m_);
        const double root = 1.0 / (1.0 + part * part);
        add(static_cast<int>(match->surfel - map_.surfels().data()), point, root * root,
            variance_of(point, cosine, noise_m, parameters_.bearing_sigma_rad));
      }
    }
  }

  void flush(int key_frame, std::vector<Observation>& observations) {
    std::sort(touched_.begin(), touched_.end());
    for (const int surfel : touched_) {
      Sums& sums = sums_[surfel];
      const double surface = std::hypot(parameters_.surface_sigma_m, kBendSigma * sums.rise_m / sums.weight);
      const double variance = sums.variance / (sums.weight * sums.weight) + surface * surface;
      observations.push_back({key_frame, surfel, sums.position / sums.weight, sums.directions / sums.weight,
                              std::sqrt(variance), sums.beams, sums.rise_m / sums.weight, sums.lowest_rise_m,
                              sums.highest_rise_m});
      sums = Sums{};
    }
    touched_.clear();
  }

 private:
  void add(int surfel, const ScanPoint& point, double weight, double variance) {
    Sums& sums = sums_[surfel];
    if (sums.beams == 0) {
      touched_.push_back(surfel);
    }
    sums.weight += weight;
    sums.variance += weight * weight * variance;
    sums.position += weight * point.position;
    sums.directions.col(point.lidar) += weight * point.direction;
    sums.rise_m += weight * point.rise_m;
    sums.lowest_rise_m = std::min(sums.lowest_rise_m, point.rise_m);
    sums.highest_rise_m = std::max(sums.highest_rise_m, point.rise_m);
    ++sums.beams;
  }

  const SurfelMap& map_;
  double gate_m_;
  const AdjustmentParameters& parameters_;
  std::vector<Sums> sums_;
  std::vector<int> touched_;
};

}  // namespace

SeenPoints points_in_map(const std::vector<KeyFrame>& key_frames, const RangeBias& range_bias) {
  SeenPoints points;
  for (std::size_t i = 0; i < key_frames.size(); ++i) {
    const KeyFrame& frame = key_frames[i];
    const Eigen::Matrix2d turn = rotation(frame.pose[2]);
    for (const ScanPoint& point : frame.scan.points) {
      const Eigen::Vector2d position = turn * range_bias.corrected(point);
      points.push_back({position + frame.pose.head<2>(), turn * point.direction, point.range_m, static_cast<int>(i)});
    }
  }
  return points;
}

std::vector<Observation> observe(const std::vector<KeyFrame>& key_frames, const RangeBias& range_bias,
                                 const SurfelMap& map, double gate_m, const AdjustmentParameters& parameters) {
  std::vector<Observation> observations;
  Collector collector(map, gate_m, parameters);
  for (std::size_t i = 0; i < key_frames.size(); ++i) {
    collector.add(key_frames[i], range_bias);
    collector.flush(static_cast<int>(i), observations);
  }
  return observations;
}

}  // namespace mtr_surfel_map
