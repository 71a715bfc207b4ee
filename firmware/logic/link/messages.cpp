/// @file
/// ROS serialization: fields one after the other, little-endian.
// SPDX-License-Identifier: Apache-2.0
#include "messages.hpp"

#include <string.h>

#include "../crc16.hpp"
#include "definitions.hpp"
#include "endpoints.hpp"
#include "frame_writer.hpp"

namespace mtr {
namespace {

constexpr uint8_t kCrcBytes = 2;

/// Takes values from a payload; never from beyond its end.
class Reader {
 public:
  Reader(const uint8_t* payload, uint8_t length) : next_(payload), left_(length) {}

  uint8_t u8() {
    if (left_ == 0) {
      return 0;
    }
    --left_;
    return *next_++;
  }
  uint16_t u16() {
    const uint8_t low = u8();
    return static_cast<uint16_t>(low | u8() << 8);
  }
  uint32_t u32() {
    const uint16_t low = u16();
    return low | static_cast<uint32_t>(u16()) << 16;
  }
  float f32() {
    const uint32_t bits = u32();
    float value = 0.0f;
    memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const uint8_t* next_;
  uint8_t left_;
};

/// True when the last two bytes are the CRC of those before.
bool is_sealed(const uint8_t* payload, uint8_t length, uint8_t wanted_length) {
  if (length != wanted_length) {
    return false;
  }
  const uint8_t* sum = payload + length - kCrcBytes;
  return crc16(payload, static_cast<uint8_t>(length - kCrcBytes)) == static_cast<uint16_t>(sum[0] | sum[1] << 8);
}

}  // namespace

bool read(const uint8_t* payload, uint8_t length, Command* message) {
  Reader reader(payload, length);
  message->seq = reader.u32();
  message->lift_height_m = reader.f32();
  message->led_pattern = reader.u8();
  message->stop = reader.u8();
  message->latest_us = reader.u32();
  return is_sealed(payload, length, MTR_FIRMWARECOMMAND_BYTES);
}

bool read(const uint8_t* payload, uint8_t length, Press* message) {
  Reader reader(payload, length);
  message->id = reader.u32();
  message->servos = reader.u8();
  message->strength = reader.f32();
  message->hold_ms = reader.u16();
  message->latest_us = reader.u32();
  return is_sealed(payload, length, MTR_FIRMWAREPRESS_BYTES);
}

bool read(const uint8_t* payload, uint8_t length, Calibrate* message) {
  Reader reader(payload, length);
  message->id = reader.u32();
  message->stroke_m = reader.f32();
  message->latest_us = reader.u32();
  return is_sealed(payload, length, MTR_FIRMWARECALIBRATE_BYTES);
}

bool read(const uint8_t* payload, uint8_t length, SignalOrder* message) {
  Reader reader(payload, length);
  message->signal = reader.u8();
  message->beacon = reader.u8();
  message->stop_input = reader.u8();
  message->latest_us = reader.u32();
  return is_sealed(payload, length, MTR_FIRMWARESIGNALS_BYTES);
}

bool send(const State& message) {
  FrameWriter frame;
  if (!frame.begin(kTopicState, MTR_FIRMWARESTATE_BYTES)) {
    return false;
  }
  frame.u32(message.time_us);
  frame.f32(message.lift_height_m);
  for (uint16_t width : message.servo_us) {
    frame.u16(width);
  }
  frame.u32(message.press.id);
  frame.u8(static_cast<uint8_t>(message.press.state));
  frame.u32(message.press.start_us);
  frame.u32(message.press.end_us);
  frame.u8(message.led_pattern);
  frame.u8(static_cast<uint8_t>(message.fault));
  frame.u8(static_cast<uint8_t>(message.lift_state));
  frame.u32(message.calibration_id);
  frame.u8(static_cast<uint8_t>(message.calibration_state));
  frame.crc();
  frame.end();
  return true;
}

bool send(const Health& message) {
  FrameWriter frame;
  if (!frame.begin(kTopicHealth, MTR_FIRMWAREHEALTH_BYTES)) {
    return false;
  }
  frame.u8(message.reset_cause);
  frame.u16(message.resets);
  frame.u16(message.uart_overruns);
  frame.u16(message.dropped_bytes);
  frame.u16(message.counters.checksum_errors);
  frame.u16(message.counters.skipped_frames);
  frame.u16(message.counters.refused_commands);
  frame.u32(message.worst_loop_us);
  frame.u16(message.free_ram);
  frame.u16(message.counters.dropped_reports);
  frame.u8(static_cast<uint8_t>(message.counters.last_refusal));
  frame.u8(message.calibration_copies);
  frame.u16(message.stroke_mm);
  frame.end();
  return true;
}

bool send(const InputReport& message) {
  FrameWriter frame;
  if (!frame.begin(kTopicInputs, MTR_FIRMWAREINPUTS_BYTES)) {
    return false;
  }
  frame.u32(message.time_us);
  frame.u8(static_cast<uint8_t>(message.stop));
  frame.u16(message.stops);
  frame.u8(message.signal);
  frame.u8(message.beacon);
  frame.crc();
  frame.end();
  return true;
}

bool send_echo(uint8_t seq) {
  FrameWriter frame;
  if (!frame.begin(kTopicEcho, MTR_FIRMWAREECHO_BYTES)) {
    return false;
  }
  frame.u8(seq);
  frame.end();
  return true;
}

}  // namespace mtr
