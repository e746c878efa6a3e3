/**
# Catch2, version 2 or 3 */
#pragma once

#include <string>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>

using Catch::Approx;
inline auto contains(const std::string& part)
{
  return Catch::Matchers::ContainsSubstring(part);
}
#else
#include <catch2/catch.hpp>

inline auto contains(const std::string& part)
{
  return Catch::Contains(part);
}
#endif
