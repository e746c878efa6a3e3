/**
# Progress of long work

A line on stderr that is rewritten in place, and only when a person is watching. */
#pragma once

#include <string>

namespace rotor_stator
{

class Progress
{
public:
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

private:
  std::string what_;
  std::size_t done_ = 0, total_;
  bool watched_;
};

}  // namespace rotor_stator
