/// @file
/// Limits of the base from the parameter server.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/base_watch.hpp"

#include <ros/ros.h>

#include <chrono>
#include <utility>

#include "mtr_drive_control/ros/base_parameters.hpp"

namespace mtr_drive_control {
namespace {

constexpr std::chrono::seconds kPeriod{5};

}  // namespace

BaseWatch::BaseWatch(std::string controller, const Parameters& parameters, const BaseLimits& limits)
    : controller_(std::move(controller)), parameters_(parameters), limits_(limits), thread_([this] { run(); }) {}

BaseWatch::~BaseWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

std::string BaseWatch::change() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return change_;
}

void BaseWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ended_.wait_for(lock, kPeriod, [this] { return is_over_; })) {
    lock.unlock();
    look();
    lock.lock();
  }
}

void BaseWatch::look() {
  std::string found;
  try {
    found = changed_limit(limits_, checked_base(controller_, parameters_), controller_);
  } catch (const mtr_core::ConfigurationError& error) {
    found = error.what();
  }
  // Without a master every parameter seems to be missing.
  if (!found.empty() && !ros::master::check()) {
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  change_ = found;
}

}  // namespace mtr_drive_control
