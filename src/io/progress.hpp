/**
# Progress of long work

A line on stderr that is rewritten in place, only when a person is watching and after two seconds. */
#pragma once

#include <chrono>
#include <string>

namespace rotor_stator {

class Progress {
public:
  /** Without a name nothing is shown. */
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  bool is_watched() const { return watched_; }
  void step();
  void show(const std::string& state, bool is_last = false);  ///< instead of steps

private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::size_t done_ = 0, total_;
  bool watched_, shown_ = false;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(2);
};

}  // namespace rotor_stator
