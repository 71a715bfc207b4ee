/// @file
/// Detection of a closed loop.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "map_names.hpp"

namespace mtr_localization::replay {

/// Examines the key frames as they arrive.
class LoopDetector {
 public:
  /// Returns true after the path came back to an earlier place with a full turn.
  bool closes(const std::vector<KeyFrame>& key_frames);

 private:
  std::size_t seen_ = 0;
  bool closed_ = false;
};

}  // namespace mtr_localization::replay
