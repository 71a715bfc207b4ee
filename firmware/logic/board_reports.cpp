/// @file
/// Reports to the host: state, inputs, counters.
// SPDX-License-Identifier: Apache-2.0
#include <math.h>

#include "../hal/hal.hpp"
#include "board.hpp"

namespace mtr {
namespace {

/// True once per period; periods that were missed are not made up for.
bool is_due(uint32_t now_us, uint32_t period_us, uint32_t* last_us) {
  const uint32_t late_us = now_us - *last_us;
  if (late_us < period_us) {
    return false;
  }
  *last_us = late_us < 2 * period_us ? *last_us + period_us : now_us;
  return true;
}

}  // namespace

void Board::report(uint32_t now_us) {
  if (is_due(now_us, kStatePeriodUs, &state_us_)) {
    send_state();
  } else if (is_input_new_ || is_due(now_us, kInputsPeriodUs, &inputs_us_)) {
    send_inputs();
  } else if (is_due(now_us, kHealthPeriodUs, &health_us_)) {
    send_health();
  }
}

void Board::send_state() {
  const bool is_broken = sensor_.is_broken();
  State state;
  state.time_us = hal::clock_us();
  state.lift_height_m = is_broken ? NAN : memory_.calibration().height_um(sensor_.counts()) * 1e-6f;
  for (uint8_t servo = 0; servo < kServoCount; ++servo) {
    state.servo_us[servo] = presses_.width_us(servo);
  }
  state.press = presses_.report();
  state.led_pattern = shown_pattern();
  state.fault = fault();
  state.lift_state = calibrator_.is_running() ? LiftState::kCalibrating
                     : lift_.is_moving()      ? LiftState::kMoving
                                              : LiftState::kStill;
  state.calibration_id = calibration_id_;
  state.calibration_state = calibration_state_;
  if (!send(state)) {
    count(&counters_.dropped_reports);
  }
}

void Board::send_inputs() {
  InputReport inputs;
  inputs.time_us = hal::clock_us();
  if (stop_input_.is_used()) {
    inputs.stop = stop_input_.is_open() ? StopState::kOpen : StopState::kClosed;
  }
  inputs.stops = stop_input_.openings();
  inputs.signal = signals_.signal();
  inputs.beacon = signals_.has_beacon() ? 1 : 0;
  is_input_new_ = !send(inputs);
}

void Board::send_health() {
  Health health;
  health.reset_cause = hal::reset_cause();
  health.resets = memory_.resets();
  health.uart_overruns = hal::uart_overruns();
  health.dropped_bytes = hal::uart_dropped();
  health.counters = counters_;
  health.worst_loop_us = worst_loop_us_;
  health.free_ram = hal::free_ram();
  health.calibration_copies = memory_.copies();
  health.stroke_mm = memory_.calibration().stroke_mm;
  if (send(health)) {
    worst_loop_us_ = 0;
  } else {
    count(&counters_.dropped_reports);
  }
}

uint8_t Board::shown_pattern() const {
  if (link_lost_) {
    return kLedLinkLost;
  }
  if (signals_.signal() == kSetsOff) {
    return kLedSetsOff;
  }
  return sensor_.is_broken() || lift_.is_jammed() ? static_cast<uint8_t>(kLedError) : led_pattern_;
}

Fault Board::fault() const {
  if (sensor_.is_broken()) {
    return Fault::kSensorBroken;
  }
  if (link_lost_) {
    return Fault::kLinkLost;
  }
  if (lift_.is_jammed()) {
    return lift_.has_given_up() ? Fault::kLiftGivenUp : Fault::kLiftJammed;
  }
  return Fault::kNone;
}

}  // namespace mtr
