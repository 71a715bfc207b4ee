/// @file
/// Feeds events to the localizer and collects its output.
// SPDX-License-Identifier: Apache-2.0
#include "replay/replay.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

#include "mtr_surfel_map/adjustment/map_adjustment.hpp"
#include "ros/saved_map.hpp"

namespace mtr_localization::replay {
namespace {

// Id of the map if the bag has no orders.
constexpr std::uint64_t kMapCarId = 1;
// Accuracy of a start pose given by a person.
constexpr double kBeginSigmaM = 0.05;
constexpr double kBeginSigmaRad = 0.02;

double cpu_s(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// CPU time of the calling thread since construction.
class CpuTimer {
 public:
  double elapsed_s() const { return cpu_s(CLOCK_THREAD_CPUTIME_ID) - begun_s_; }

 private:
  double begun_s_ = cpu_s(CLOCK_THREAD_CPUTIME_ID);
};

}  // namespace

Result Replay::run(const Progress& progress) {
  const auto begun = std::chrono::steady_clock::now();
  const double process_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID);
  const CpuTimer thread;
  reader_.open();
  if (!options_.map.empty()) {
    go_on_with_map();
  }
  int told = -1;
  Event event;
  while (reader_.next(event)) {
    std::visit([this](auto& content) { take(std::move(content)); }, event);
    if (progress && reader_.percent() > told) {
      told = reader_.percent();
      progress(told);
    }
  }
  result_.adjustment_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID) - process_s - thread.elapsed_s();
  finish_map();
  result_.sweeps_refused = localizer_.figures().scans_refused;
  result_.sweeps_used = localizer_.scans_used();
  if (result_.sweeps_used == 0) {
    invalidate_trajectory();
  }
  result_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return std::move(result_);
}

void Replay::invalidate_trajectory() {
  for (Estimate& estimate : result_.trajectory) {
    estimate.valid = false;
  }
}

void Replay::go_on_with_map() {
  const auto saved = read_map(options_.map);
  if (!saved) {
    throw std::runtime_error("File " + options_.map + " is not there.");
  }
  Memory memory = memory_of(saved->map);
  result_.map.map = memory.map;
  result_.map.map_car_id = memory.map_car_id;
  result_.map.revision = memory.revision;
  result_.is_map_new = false;
  has_map_ = true;
  if (options_.begin_at) {
    // The start pose refers to the first odometry, which has not been read yet.
    memory_ = std::move(memory);
  } else {
    localizer_.go_on(std::move(memory));
  }
}

void Replay::begin_at(const WheelSample& sample) {
  const Eigen::Map<const PoseVector> place(options_.begin_at->data());
  const Eigen::Vector3d sigma(kBeginSigmaM, kBeginSigmaM, kBeginSigmaRad);
  memory_->pose = RememberedPose{place, sigma.cwiseAbs2().asDiagonal(), {sample.x_m, sample.y_m, sample.heading_rad}};
  localizer_.go_on(*std::move(memory_));
  memory_.reset();
}

void Replay::take(const ImuSample& sample) {
  ++result_.imu_samples;
  track([&] { return localizer_.add_imu(sample); });
}

void Replay::track(const std::function<std::vector<Estimate>()>& answer) {
  const CpuTimer timer;
  const std::vector<Estimate> estimates = answer();
  const double elapsed_s = timer.elapsed_s();
  result_.tracking_s += elapsed_s;
  result_.max_ms = std::max(result_.max_ms, 1e3 * elapsed_s);
  for (const Estimate& estimate : estimates) {
    note(estimate.message, estimate.stamp_ns);
    result_.trajectory.push_back(estimate);
  }
}

void Replay::take(const GnssFix& fix) { localizer_.add_fix(fix); }

void Replay::take(MapOrder order) {
  if (options_.map.empty()) {
    localizer_.add_order(order);
  }
}

void Replay::take(Sweep sweep) {
  ++result_.sweeps;
  const std::int64_t stamp_ns = sweep.stamp_ns;
  const CpuTimer timer;
  const Lidar lidar = sweep.lidar;
  const std::string refusal = localizer_.add_scan(std::move(sweep));
  result_.tracking_s += timer.elapsed_s();
  if (!refusal.empty()) {
    ++result_.refusals[{lidar, refusal}];
    note(mtr_core::Problem{"", refusal, {}, nullptr}, stamp_ns);
  }
}

void Replay::take(WheelSample sample) {
  ++result_.wheel_samples;
  if (memory_) {
    begin_at(sample);
  }
  if (!reader_.has_orders() && options_.map.empty()) {
    give_order(sample.stamp_ns);
  }
  track([&] { return localizer_.add_wheels(sample); });
  if (auto map = localizer_.take_map()) {
    note(map->map.message, map->stamp_ns);
    if (map->map.valid || !has_map_) {
      result_.map = std::move(*map);
      has_map_ = true;
    }
  }
}

void Replay::give_order(std::int64_t now_ns) {
  MapOrder order{now_ns, kMapCarId, MapOrder::Phase::kCollect};
  const bool is_closed = options_.loop_end_ns ? now_ns >= *options_.loop_end_ns : loop_.closes(localizer_.key_frames());
  if (is_closed) {
    order.phase = MapOrder::Phase::kFreeze;
  }
  localizer_.add_order(order);
}

void Replay::finish_map() {
  if (has_map_) {
    return;
  }
  // The bag ended before its map was due: adjust the available key frames to report at least what is missing.
  result_.map.map = mtr_surfel_map::adjust(localizer_.key_frames(), options_.parameters.adjustment);
  result_.map.grid = occupancy_of(result_.map.map);
  const mtr_core::Problem early{"", "The bag ends before the map takes effect.", {}, nullptr};
  note(result_.map.map.valid ? early : result_.map.map.message,
       result_.trajectory.empty() ? 0 : result_.trajectory.back().stamp_ns);
}

void Replay::note(const mtr_core::Problem& problem, std::int64_t stamp_ns) {
  if (problem) {
    ++result_.messages.emplace(problem.text, Note{problem.code, stamp_ns, 0}).first->second.count;
  }
}

}  // namespace mtr_localization::replay
