/// @file
/// The firmware: what arrives becomes orders for lift, servos and LEDs; what they do is reported.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "counters.hpp"
#include "leds.hpp"
#include "lift/lift.hpp"
#include "lift/lift_calibrator.hpp"
#include "lift/position_sensor.hpp"
#include "link/messages.hpp"
#include "link/rosserial_client.hpp"
#include "memory.hpp"
#include "presses.hpp"
#include "signals.hpp"
#include "stop_input.hpp"

namespace mtr {

class Board {
 public:
  Board(PressMemory* press_memory, StopMemory* stop_memory)
      : client_(take, this, &counters_), presses_(press_memory), stop_input_(stop_memory) {}

  void start();

  /// One pass of the main loop.
  void step();

 private:
  static void take(void* self, uint16_t topic, const uint8_t* payload, uint8_t length);
  void on_command(const Command& command);
  void on_press(const Press& press);
  void on_calibrate(const Calibrate& calibrate);
  void on_signals(const SignalOrder& order);
  /// True while the host or the stop input stops lift and servos.
  bool is_stopped() const { return is_stopped_ || stop_input_.is_open(); }
  /// Holds the lift, ends a calibration, releases the servos.
  void stop();
  /// True when an order of the host has been under way for too long, or was meant for another clock.
  bool is_late(uint32_t latest_us) const { return latest_us - now_us_ > kMaxLeadUs; }
  /// The host lives.
  void hear();
  void lose_link();

  void tick();
  void move_lift(float height_m);
  void step_lift();
  void step_leds();
  /// Writes LEDs, buzzer and beacon.
  void show();
  void report(uint32_t now_us);
  void send_state();
  void send_inputs();
  void send_health();
  uint8_t shown_pattern() const;
  Fault fault() const;

  Counters counters_;
  RosserialClient client_;
  Presses presses_;
  Memory memory_;
  PositionSensor sensor_;
  Lift lift_;
  LiftCalibrator calibrator_;
  StopInput stop_input_;
  Signals signals_;
  uint32_t now_us_ = 0;
  uint32_t heard_us_ = 0;
  uint32_t state_us_ = 0;
  uint32_t health_us_ = 0;
  uint32_t inputs_us_ = 0;
  uint32_t worst_loop_us_ = 0;
  uint32_t calibration_id_ = 0;
  CalibrationState calibration_state_ = CalibrationState::kNone;
  uint8_t led_pattern_ = kLedStarting;
  uint8_t led_slot_ = 0;
  uint8_t led_ms_ = 0;
  bool link_lost_ = false;
  /// By the newest command of the host.
  bool is_stopped_ = false;
  /// A change of the stop input has not been reported yet.
  bool is_input_new_ = false;
};

}  // namespace mtr
