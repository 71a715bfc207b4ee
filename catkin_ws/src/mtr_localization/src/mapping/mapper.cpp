/// @file
/// Orders, travelled distance and the adjustment thread.
// SPDX-License-Identifier: Apache-2.0
#include "mapping/mapper.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "problems.hpp"

namespace mtr_localization {
namespace {

// Orders arrive every 100 ms and take effect one period after their stamp, independent of the order of arrival.
constexpr std::int64_t kOrderLagNs = 100'000'000;
// A robot that stops when lost travels less. If it continues without relocalization, the path has an open end.
constexpr double kMaxLostTravelM = 1.0;

}  // namespace

Mapper::Mapper(const Parameters& parameters, Adjust adjust)
    : parameters_(parameters), adjust_(std::move(adjust)), selector_(parameters.sensors), drift_(parameters) {}

void Mapper::go_on(std::uint64_t map_car_id, std::uint32_t revision) {
  map_car_id_ = map_car_id;
  revision_ = newest_revision_ = revision;
  state_ = State::kDone;
}

void Mapper::travel(const FilterInput& input, double heading_rad, bool lost) {
  if (input.kind != FilterInput::Kind::kMove) {
    return;
  }
  selector_.travel(input.motion.distance_m, input.motion.gyro_angle_rad);
  drift_.travel(input.motion, heading_rad);
  lost_travel_m_ = lost ? lost_travel_m_ + std::abs(input.motion.distance_m) : 0.0;
}

bool Mapper::begins(std::int64_t now_ns) {
  bool begins = false;
  while (!orders_.empty() && orders_.front().stamp_ns + kOrderLagNs <= now_ns) {
    begins = handle(orders_.front()) || begins;
    orders_.pop_front();
  }
  return begins;
}

bool Mapper::handle(const MapOrder& order) {
  const bool is_known = state_ != State::kNone && order.map_car_id == map_car_id_;
  if (order.phase == MapOrder::Phase::kCollect && !is_known && state_ != State::kAdjusting) {
    begin(order.map_car_id);
    return true;
  }
  const bool is_open = is_known && (state_ == State::kCollecting || state_ == State::kPaused);
  if (is_open && order.phase == MapOrder::Phase::kFreeze) {
    start_adjustment(order.stamp_ns + std::llround(parameters_.mapping.freeze_delay_s * 1e9));
  } else if (is_open) {
    state_ = order.phase == MapOrder::Phase::kCollect ? State::kCollecting : State::kPaused;
  }
  return false;
}

void Mapper::begin(std::uint64_t map_car_id) {
  map_car_id_ = map_car_id;
  key_frames_.clear();
  selector_.restart();
  state_ = State::kCollecting;
  revision_ = 0;
  drift_.restart();
  lost_travel_m_ = 0.0;
}

void Mapper::start_adjustment(std::int64_t effect_ns) {
  effect_ns_ = effect_ns;
  adjusting_ = std::async(std::launch::async, [adjust = adjust_, key_frames = key_frames_] {
    MapResult made;
    made.map = adjust(key_frames);
    made.grid = occupancy_of(made.map);
    return made;
  });
  state_ = State::kAdjusting;
}

const KeyFrame* Mapper::add(const KeyFrameCandidate& candidate) {
  std::optional<KeyFrame> frame = state_ == State::kCollecting ? selector_.add(candidate) : std::nullopt;
  if (!frame) {
    return nullptr;
  }
  key_frames_.push_back(std::move(*frame));
  return &key_frames_.back();
}

bool Mapper::is_finished(std::int64_t now_ns) const {
  if (state_ != State::kAdjusting || now_ns < effect_ns_) {
    return false;
  }
  return parameters_.lockstep || adjusting_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

const AdjustedMap* Mapper::finish(std::int64_t now_ns) {
  if (!is_finished(now_ns)) {
    return nullptr;
  }
  state_ = State::kDone;
  result_ = adjusting_.get();
  if (lost_travel_m_ > kMaxLostTravelM) {
    result_->map.valid = false;
    result_->map.message = problems::kLostOnTheWay();
  }
  if (result_->map.valid) {
    revision_ = ++newest_revision_;
  }
  result_->stamp_ns = now_ns;
  result_->map_car_id = map_car_id_;
  result_->revision = newest_revision_;
  return &result_->map;
}

std::optional<MapResult> Mapper::take_result() { return std::exchange(result_, std::nullopt); }

}  // namespace mtr_localization
