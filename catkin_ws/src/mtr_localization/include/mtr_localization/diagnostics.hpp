/// @file
/// State of localization for /diagnostics.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include "mtr_localization/localizer.hpp"
#include "mtr_localization/work_load.hpp"

namespace mtr_localization {

/// One status: OK while valid, a warning while it waits or is degenerate, an error when lost.
diagnostic_msgs::DiagnosticArray diagnostics_of(const Localizer& localizer, const Estimate& estimate,
                                                const WorkLoad& load);

}  // namespace mtr_localization
