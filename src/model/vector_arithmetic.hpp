/**
# Sums and multiples of vectors and of pairs of bodies

What a time integrator does with slopes. */
#pragma once

#include "model/rotor_stator.hpp"

namespace rotor_stator
{

inline Vec2 operator+(Vec2 a, Vec2 b)
{
  return {a.x + b.x, a.y + b.y};
}
inline Vec2 operator*(double s, Vec2 a)
{
  return {s * a.x, s * a.y};
}
inline Bodies operator+(const Bodies& a, const Bodies& b)
{
  return {a.stator + b.stator, a.rotor + b.rotor};
}
inline Bodies operator*(double s, const Bodies& a)
{
  return {s * a.stator, s * a.rotor};
}

}  // namespace rotor_stator
