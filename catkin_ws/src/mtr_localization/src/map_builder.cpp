/// @file
/// Orders and the adjustment's thread.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/map_builder.hpp"

#include <chrono>
#include <utility>

namespace mtr_localization {

MapBuilder::MapBuilder(const Parameters& parameters, Adjust adjust)
    : selector_(parameters), adjust_(std::move(adjust)) {}

bool MapBuilder::order(const MapOrder& order, std::int64_t effect_delay_ns) {
  const bool is_known = state_ != State::kNone && order.map_car_id == map_car_id_;
  if (order.phase == MapOrder::Phase::kCollect && !is_known && state_ != State::kAdjusting) {
    map_car_id_ = order.map_car_id;
    key_frames_.clear();
    selector_.restart();
    state_ = State::kCollecting;
    return true;
  }
  const bool is_open = is_known && (state_ == State::kCollecting || state_ == State::kPaused);
  if (is_open && order.phase == MapOrder::Phase::kFreeze) {
    effect_ns_ = order.stamp_ns + effect_delay_ns;
    adjusting_ = std::async(std::launch::async, [adjust = adjust_, key_frames = key_frames_] {
      MadeMap made{adjust(key_frames), {}};
      made.grid = occupancy_of(made.map);
      return made;
    });
    state_ = State::kAdjusting;
  } else if (is_open) {
    state_ = order.phase == MapOrder::Phase::kCollect ? State::kCollecting : State::kPaused;
  }
  return false;
}

bool MapBuilder::add(const View& view) {
  std::optional<KeyFrame> frame = state_ == State::kCollecting ? selector_.add(view) : std::nullopt;
  if (!frame) {
    return false;
  }
  key_frames_.push_back(std::move(*frame));
  return true;
}

std::optional<MadeMap> MapBuilder::result(std::int64_t now_ns, bool waits) {
  if (state_ != State::kAdjusting || now_ns < effect_ns_) {
    return std::nullopt;
  }
  if (!waits && adjusting_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  state_ = State::kDone;
  return adjusting_.get();
}

}  // namespace mtr_localization
