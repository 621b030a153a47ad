// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "file_watch.h"

#include <chrono>
#include <string>
#include <thread>

namespace bw::cli {

namespace {

constexpr auto kLook = std::chrono::milliseconds(50);  // between two looks
constexpr int kLooksAlike = 4;                         // until what is written counts as whole

}  // namespace

using pipeline::FileStamp;

void FileWatch::add(const std::filesystem::path& file) { states_[file] = FileStamp::of(file); }

FileWatch::States FileWatch::now() const {
  States states;
  for (const auto& [file, state] : states_) states[file] = FileStamp::of(file);
  return states;
}

bool FileWatch::awaitChange(const std::stop_token& stop) const {
  States before = states_;
  for (int alike = 0; !stop.stop_requested();) {
    States states = now();
    alike = states == before ? alike + 1 : 0;
    before = std::move(states);
    if (before != states_ && alike >= kLooksAlike) return true;
    std::this_thread::sleep_for(kLook);
  }
  return false;
}

std::string FileWatch::names() const {
  std::string all;
  std::size_t left = states_.size();
  for (const auto& [file, state] : states_) {
    all += file.string();
    if (--left > 0) all += left == 1 ? " and " : ", ";
  }
  return all;
}

}  // namespace bw::cli
