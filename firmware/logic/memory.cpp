/// @file
/// Layout: calibration, calibration, resets, resets; each record ends with its CRC, all little-endian.
// SPDX-License-Identifier: Apache-2.0
#include "memory.hpp"

#include "../hal/hal.hpp"
#include "crc16.hpp"

namespace mtr {
namespace {

constexpr uint8_t kCrcBytes = 2;

uint16_t word_at(const uint8_t* bytes) { return static_cast<uint16_t>(bytes[0] | bytes[1] << 8); }

void put_word(uint8_t* bytes, uint16_t value) {
  bytes[0] = static_cast<uint8_t>(value);
  bytes[1] = static_cast<uint8_t>(value >> 8);
}

bool is_good(const uint8_t* record, uint8_t length) {
  const uint8_t data_bytes = static_cast<uint8_t>(length - kCrcBytes);
  return crc16(record, data_bytes) == word_at(record + data_bytes);
}

void seal(uint8_t* record, uint8_t length) {
  const uint8_t data_bytes = static_cast<uint8_t>(length - kCrcBytes);
  put_word(record + data_bytes, crc16(record, data_bytes));
}

}  // namespace

void Memory::load() {
  for (uint8_t i = 0; i < kImageBytes; ++i) {
    image_[i] = hal::eeprom_read(i);
  }
  load_calibration();
  load_resets();
  next_ = 0;
}

void Memory::save(const Calibration& calibration) {
  calibration_ = calibration;
  copies_ = kCopies;
  put_calibration();
  next_ = 0;
}

void Memory::poll() {
  if (next_ >= kImageBytes || !hal::eeprom_ready()) {
    return;
  }
  if (hal::eeprom_read(next_) != image_[next_]) {
    hal::eeprom_write(next_, image_[next_]);
  }
  ++next_;
}

void Memory::load_calibration() {
  copies_ = 0;
  for (uint8_t copy = kCopies; copy-- > 0;) {
    const uint8_t* record = image_ + copy * kCalibrationBytes;
    Calibration read;
    read.low = word_at(record);
    read.high = word_at(record + 2);
    read.stroke_mm = word_at(record + 4);
    if (is_good(record, kCalibrationBytes) && read.is_plausible()) {
      calibration_ = read;
      ++copies_;
    }
  }
  if (copies_ > 0) {
    put_calibration();
  }
}

void Memory::load_resets() {
  uint8_t* records = image_ + kCopies * kCalibrationBytes;
  for (uint8_t copy = 0; copy < kCopies; ++copy) {
    const uint8_t* record = records + copy * kResetBytes;
    if (is_good(record, kResetBytes) && word_at(record) > resets_) {
      resets_ = word_at(record);
    }
  }
  if (resets_ != 0xFFFF) {
    ++resets_;
  }
  uint8_t* record = records + (resets_ % kCopies) * kResetBytes;
  put_word(record, resets_);
  seal(record, kResetBytes);
}

void Memory::put_calibration() {
  for (uint8_t copy = 0; copy < kCopies; ++copy) {
    uint8_t* record = image_ + copy * kCalibrationBytes;
    put_word(record, calibration_.low);
    put_word(record + 2, calibration_.high);
    put_word(record + 4, calibration_.stroke_mm);
    seal(record, kCalibrationBytes);
  }
}

}  // namespace mtr
