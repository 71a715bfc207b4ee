/// @file
/// Wiring of the parts, and the silence of the host.
// SPDX-License-Identifier: Apache-2.0
#include "board.hpp"

#include <math.h>

#include "../hal/hal.hpp"
#include "link/endpoints.hpp"

namespace mtr {
namespace {

constexpr uint8_t kLedSlots = 16;
/// A pass takes at most so many bytes, so that a flood of them starves nothing.
constexpr uint8_t kBytesPerPass = 64;

int32_t to_um(float metres) { return static_cast<int32_t>(metres * 1e6f + 0.5f); }

}  // namespace

void Board::start() {
  now_us_ = heard_us_ = hal::clock_us();
  state_us_ = health_us_ = inputs_us_ = now_us_;
  memory_.load();
  presses_.start();
  for (uint8_t servo = 0; servo < kServoCount; ++servo) {
    hal::servo_write(servo, presses_.width_us(servo));
  }
  client_.start(now_us_);
}

void Board::step() {
  now_us_ = hal::clock_us();
  const uint32_t began_us = now_us_;
  uint8_t byte = 0;
  for (uint8_t i = 0; i < kBytesPerPass && hal::uart_take(&byte); ++i) {
    client_.receive(byte, now_us_);
  }
  if (!link_lost_ && now_us_ - heard_us_ > kSilenceUs) {
    lose_link();
  }
  client_.poll(now_us_, !link_lost_);
  for (uint8_t ticks = hal::take_ticks(); ticks > 0; --ticks) {
    tick();
  }
  uint32_t period_us = 0;
  if (hal::servo_turn(&period_us)) {
    presses_.step(period_us);
    for (uint8_t servo = 0; servo < kServoCount; ++servo) {
      hal::servo_write(servo, presses_.width_us(servo));
    }
  }
  memory_.poll();
  if (client_.may_report()) {
    report(now_us_);
  }
  const uint32_t took_us = hal::clock_us() - began_us;
  worst_loop_us_ = took_us > worst_loop_us_ ? took_us : worst_loop_us_;
}

void Board::take(void* self, uint16_t topic, const uint8_t* payload, uint8_t length) {
  Board* board = static_cast<Board*>(self);
  Command command;
  Press press;
  Calibrate calibrate;
  SignalOrder signals;
  if (topic == kTopicStop) {
    board->lose_link();
  } else if (topic == kTopicCommand && read(payload, length, &command)) {
    board->on_command(command);
  } else if (topic == kTopicPress && read(payload, length, &press)) {
    board->on_press(press);
  } else if (topic == kTopicCalibrate && read(payload, length, &calibrate)) {
    board->on_calibrate(calibrate);
  } else if (topic == kTopicSignals && read(payload, length, &signals)) {
    board->on_signals(signals);
  } else {
    count(&board->counters_.checksum_errors);
  }
}

void Board::on_command(const Command& command) {
  if (!send_echo(static_cast<uint8_t>(command.seq))) {
    count(&counters_.dropped_reports);
  }
  // An old order proves no living host.
  if (is_late(command.latest_us)) {
    counters_.refuse(Refusal::kLate);
    return;
  }
  hear();
  if (command.led_pattern < kLedPatternCount) {
    led_pattern_ = command.led_pattern;
  } else {
    counters_.refuse(Refusal::kLedPattern);
  }
  is_stopped_ = command.stop != 0;
  if (is_stopped()) {
    stop();
  } else {
    move_lift(command.lift_height_m);
  }
}

void Board::stop() {
  presses_.abort();
  move_lift(NAN);
}

void Board::move_lift(float height_m) {
  const int32_t stroke_um = memory_.calibration().stroke_um();
  const float least_m = -kHeightToleranceUm * 1e-6f, most_m = (stroke_um + kHeightToleranceUm) * 1e-6f;
  if (height_m >= least_m && height_m <= most_m) {
    if (!calibrator_.is_running()) {
      lift_.go_to(to_um(height_m));
    }
    return;
  }
  if (!isnan(height_m)) {
    counters_.refuse(Refusal::kHeight);
  }
  calibrator_.abort();
  lift_.hold();
}

void Board::on_press(const Press& press) {
  Refusal impediment = is_stopped() ? Refusal::kStopped : Refusal::kNone;
  if (is_late(press.latest_us)) {
    impediment = Refusal::kLate;
  } else {
    hear();
  }
  const Refusal refusal = presses_.order(press, impediment);
  if (refusal != Refusal::kNone) {
    counters_.refuse(refusal);
  }
}

void Board::on_calibrate(const Calibrate& calibrate) {
  if (is_late(calibrate.latest_us)) {
    counters_.refuse(Refusal::kLate);
    return;
  }
  hear();
  if (calibrate.id == calibration_id_ && calibrate.id != 0) {
    return;
  }
  const bool fits = calibrate.stroke_m >= kShortestStrokeMm * 1e-3f && calibrate.stroke_m <= kLongestStrokeMm * 1e-3f;
  if (calibrate.id == 0 || calibrator_.is_running()) {
    counters_.refuse(Refusal::kCalibration);
    return;
  }
  if (is_stopped()) {
    counters_.refuse(Refusal::kStopped);
    return;
  }
  calibration_id_ = calibrate.id;
  if (!fits || sensor_.is_broken()) {
    counters_.refuse(Refusal::kCalibration);
    calibration_state_ = CalibrationState::kFailed;
    return;
  }
  lift_.cut();
  calibrator_.start(static_cast<uint16_t>(calibrate.stroke_m * 1e3f + 0.5f));
  calibration_state_ = CalibrationState::kUnderWay;
}

void Board::on_signals(const SignalOrder& order) {
  if (is_late(order.latest_us)) {
    counters_.refuse(Refusal::kLate);
    return;
  }
  if (order.stop_input != 0 && !stop_input_.is_used()) {
    stop_input_.use();
    is_input_new_ = true;
    if (stop_input_.is_open()) {
      stop();
    }
  }
  if (!signals_.order(order.signal, order.beacon != 0, now_us_)) {
    counters_.refuse(Refusal::kSignal);
  }
  show();
}

void Board::hear() {
  heard_us_ = now_us_;
  link_lost_ = false;
}

void Board::lose_link() {
  link_lost_ = true;
  lift_.cut();
  calibrator_.abort();
  presses_.abort();
  signals_.end();
  hal::motor_drive(0);
}

void Board::tick() {
  const bool was_open = stop_input_.is_open();
  if (stop_input_.step(hal::stop_input_open())) {
    stop();
  }
  is_input_new_ = is_input_new_ || stop_input_.is_open() != was_open;
  if (sensor_.add(hal::position_take())) {
    step_lift();
  }
  if (++led_ms_ >= kLedSlotMs) {
    led_ms_ = 0;
    step_leds();
  }
}

void Board::step_lift() {
  if (sensor_.is_broken()) {
    calibrator_.abort();
    lift_.cut();
    hal::motor_drive(0);
  } else if (calibrator_.is_running()) {
    hal::motor_drive(calibrator_.step(sensor_.counts()));
  } else {
    const Calibration& calibration = memory_.calibration();
    hal::motor_drive(lift_.step(calibration.height_um(sensor_.counts()), calibration.stroke_um()));
  }
  Calibration found;
  if (calibrator_.take(&found)) {
    memory_.save(found);
    calibration_state_ = CalibrationState::kDone;
  } else if (calibration_state_ == CalibrationState::kUnderWay && calibrator_.has_failed()) {
    calibration_state_ = CalibrationState::kFailed;
  }
}

void Board::step_leds() {
  led_slot_ = static_cast<uint8_t>((led_slot_ + 1) % kLedSlots);
  signals_.step(now_us_);
  show();
}

void Board::show() {
  hal::leds_write(leds_of(shown_pattern(), led_slot_));
  hal::buzzer_write(buzzer_of(signals_.signal(), led_slot_));
  hal::beacon_write(signals_.has_beacon());
}

}  // namespace mtr
