/// @file
/// Orders, key-frames and frozen maps at the steps of the filter.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/map_keeper.hpp"

#include <cmath>
#include <utility>

#include "mtr_localization/map_names.hpp"
#include "mtr_surfel_map/adjustment/map_adjustment.hpp"

namespace mtr_localization {
namespace {

// One step of the simulated clock: what is stamped before it has arrived at its end, see docs/lock-step.md.
constexpr std::int64_t kLockstepLagNs = 20'000'000;
// Orders come every 100 ms and take effect one period after their stamp, whoever is first to hear of it.
constexpr std::int64_t kOrderLagNs = 100'000'000;
// Without a scan for so long, the LiDARs are taken to be silent: seven sweeps of 25 Hz, three of 10 Hz.
constexpr std::int64_t kSilentNs = 300'000'000;
// A robot that stops when it is lost goes less far. One that went on and was not sure of its place again has a way
// round with an open end.
constexpr double kMostLostTravelM = 1.0;
// What the growing map adds to the uncertainty of the place where the frozen one is entered.
constexpr double kEntrySigmaM = 0.02;
constexpr double kEntrySigmaRad = 0.005;

std::optional<std::int64_t> lag_of(const LocalizerParameters& parameters) {
  return parameters.lockstep ? std::optional<std::int64_t>(kLockstepLagNs) : std::nullopt;
}

double square(double value) { return value * value; }

/// Key-frames as they are, for poses that come from elsewhere.
AdjustedMap unadjusted(const std::vector<KeyFrame>& key_frames) {
  GrowingMap points;
  AdjustedMap map;
  for (const KeyFrame& frame : key_frames) {
    points.insert(frame.pose, frame.scan);
    map.pose_covariances.push_back(Eigen::Matrix3d::Zero());
  }
  map.surfels = points.surfels();
  map.key_frames = key_frames;
  map.valid = !map.surfels.empty();
  map.message = map.valid ? "Surfaces by poses from elsewhere, not adjusted." : "No scan has been seen.";
  return map;
}

MapBuilder::Adjust map_maker(const LocalizerParameters& parameters) {
  if (parameters.external) {
    return unadjusted;
  }
  return [adjustment = parameters.adjustment](const std::vector<KeyFrame>& key_frames) {
    return mtr_surfel_map::adjust(key_frames, adjustment);
  };
}

}  // namespace

MapKeeper::MapKeeper(const LocalizerParameters& parameters)
    : parameters_(parameters),
      sweeps_(lag_of(parameters)),
      builder_(parameters.motion, map_maker(parameters)),
      tracker_(parameters.tracking) {}

bool MapKeeper::advance(FilterHistory& history, bool standing) {
  const std::int64_t now_ns = history.newest().stamp_ns;
  const Motion& motion = history.newest().input.motion;
  if (history.newest().input.kind == FilterInput::Kind::kMove) {
    builder_.travel(motion.distance_m, motion.gyro_angle_rad);
    mapped_travel_m_ += std::abs(motion.distance_m);
    lost_travel_m_ = tracker_.lost() ? lost_travel_m_ + std::abs(motion.distance_m) : 0.0;
  }
  bool begins = false;
  while (!orders_.empty() && orders_.front().stamp_ns + kOrderLagNs <= now_ns) {
    begins = obey(orders_.front(), history) || begins;
    orders_.pop_front();
  }
  if (auto made = builder_.result(now_ns, parameters_.lockstep)) {
    finish(std::move(*made), history);
  }
  use_sweeps(history, standing);
  return begins;
}

bool MapKeeper::use_sweeps(FilterHistory& history, bool standing) {
  const std::vector<Look> looks = sweeps_.take_due(history);
  for (const Look& look : looks) {
    if (!parameters_.external) {
      tracker_.track(look, history);
    }
    looked_ns_ = look.scan.stamp_ns;
    if (!tracker_.lost()) {
      collect(look, history, standing);
    }
  }
  return !looks.empty();
}

bool MapKeeper::obey(const MapOrder& order, FilterHistory& history) {
  const auto delay_ns = std::llround(parameters_.tracking.freeze_delay_s * 1e9);
  if (!builder_.order(order, delay_ns)) {
    return false;
  }
  revision_ = 0;
  mapped_travel_m_ = 0.0;
  lost_travel_m_ = 0.0;
  if (!parameters_.external) {
    tracker_.begin_mapping(history);
  }
  return true;
}

void MapKeeper::collect(const Look& look, const FilterHistory& history, bool standing) {
  const FilterStep& step = history.at(look.step);
  if (parameters_.external && !external_) {
    return;
  }
  const PoseVector pose = external_ ? compose(*external_, step.odom) : PoseVector(step.filter.pose());
  if (builder_.add({look.scan, pose, step.odom, standing, step.filter.gyro_bias_sigma_radps()}) &&
      !parameters_.external) {
    tracker_.extend(pose, builder_.key_frames().back().scan);
  }
}

void MapKeeper::finish(MadeMap made, FilterHistory& history) {
  if (lost_travel_m_ > kMostLostTravelM) {
    made.map.valid = false;
    made.map.message = "The position was lost on the way round the Car, and the robot went on; map the Car again.";
  }
  if (made.map.valid) {
    revision_ = ++newest_revision_;
    if (!parameters_.external) {
      enter(made.map, history);
    }
  }
  result_ = MapResult{history.newest().stamp_ns, builder_.map_car_id(), newest_revision_, std::move(made.map),
                      std::move(made.grid)};
}

void MapKeeper::enter(const AdjustedMap& map, FilterHistory& history) {
  // The way from the last key-frame on, as tracked, leads from its adjusted pose into the adjusted map.
  const PoseVector since = relative(builder_.key_frames().back().pose, history.newest().filter.pose());
  const PoseVector pose = compose(map.key_frames.back().pose, since);
  Eigen::Matrix3d covariance = map.pose_covariances.back();
  covariance.diagonal() += Eigen::Vector3d(square(kEntrySigmaM), square(kEntrySigmaM), square(kEntrySigmaRad));
  history.change(history.size() - 1, [&](PoseFilter& filter) { filter.set_pose(pose, covariance); });
  tracker_.freeze(map, history);
}

bool MapKeeper::degenerate(std::int64_t now_ns) const {
  const bool has_map = tracker_.state() != ScanTracker::State::kNoMap;
  return tracker_.degenerate() || (has_map && now_ns - looked_ns_ > kSilentNs);
}

Eigen::Matrix3d MapKeeper::map_covariance() const {
  if (tracker_.state() != ScanTracker::State::kMapping) {
    return Eigen::Matrix3d::Zero();
  }
  const double position = square(parameters_.tracking.mapping_drift_m_per_sqrt_m) * mapped_travel_m_;
  const double heading = square(parameters_.tracking.mapping_drift_rad_per_sqrt_m) * mapped_travel_m_;
  return Eigen::Vector3d(position, position, heading).asDiagonal();
}

std::optional<MapResult> MapKeeper::take_result() { return std::exchange(result_, std::nullopt); }

}  // namespace mtr_localization
