/// @file
/// Values of the plugin's element, which mtr_gazebo.world.plugin_element writes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <gazebo/physics/physics.hh>
#include <ignition/math/Pose3.hh>
#include <sdf/sdf.hh>
#include <stdexcept>
#include <string>

#include "mtr_core/slot.hpp"

namespace mtr_gazebo {

/// Returns the value of a child.
/// @throws std::runtime_error if the child is missing
template <typename Value>
Value value_of(const sdf::ElementPtr& element, const std::string& name) {
  if (!element->HasElement(name)) {
    throw std::runtime_error("The plugin's element " + element->GetName() + " has no " + name +
                             "; the world file has to be one of mtr_gazebo.");
  }
  return element->Get<Value>(name);
}

/// Returns the time in ns of a child in ms.
inline std::int64_t ns_of(const sdf::ElementPtr& element, const std::string& name) {
  return std::llround(value_of<double>(element, name) * static_cast<double>(mtr_core::kMillisecondNs));
}

/// Returns period and phase of a sensor.
inline mtr_core::Slot slot_of(const sdf::ElementPtr& element) {
  return {ns_of(element, "period_ms"), ns_of(element, "phase_ms")};
}

/// Returns base_from_sensor.
inline ignition::math::Pose3d pose_of(const sdf::ElementPtr& element) {
  return value_of<ignition::math::Pose3d>(element, "pose");
}

/// A physics step: its end, and the end of the previous step, in ns of the ROS clock.
struct Step {
  std::int64_t before_ns;
  std::int64_t now_ns;

  /// Returns true if the step contains a tick of the slot.
  [[nodiscard]] bool has_tick(const mtr_core::Slot& slot) const { return slot.last_at(now_ns) > before_ns; }
};

}  // namespace mtr_gazebo
