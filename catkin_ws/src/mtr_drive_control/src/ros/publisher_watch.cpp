/// @file
/// Publishers of the wheels' topics, as listed by the master.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/publisher_watch.hpp"

#include <ros/ros.h>

#include <chrono>

namespace mtr_drive_control {
namespace {

constexpr std::chrono::seconds kPeriod{1};

/// Returns the unexpected publisher of a topic from the master's list of [topic, [node, ...]].
std::optional<Intruder> intruder_of(XmlRpc::XmlRpcValue& publishers, const std::string& topic,
                                    const std::string& permitted) {
  for (int i = 0; i < publishers.size(); ++i) {
    const std::string name = publishers[i][0];
    XmlRpc::XmlRpcValue& nodes = publishers[i][1];
    for (int j = 0; name == topic && j < nodes.size(); ++j) {
      const std::string node = nodes[j];
      if (node != permitted) {
        return Intruder{node, topic};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

PublisherWatch::PublisherWatch(std::map<std::string, std::string> permitted) : permitted_(std::move(permitted)) {
  look();
  thread_ = std::thread([this] { run(); });
}

PublisherWatch::~PublisherWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

std::optional<Intruder> PublisherWatch::intruder() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return intruder_;
}

void PublisherWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ended_.wait_for(lock, kPeriod, [this] { return is_over_; })) {
    lock.unlock();
    look();
    lock.lock();
  }
}

void PublisherWatch::look() {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false) || state.size() < 1) {
    return;
  }
  std::optional<Intruder> found;
  for (const auto& [topic, permitted] : permitted_) {
    found = found ? found : intruder_of(state[0], topic, permitted);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  intruder_ = found;
}

}  // namespace mtr_drive_control
