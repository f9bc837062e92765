// Randomness for the synthetic scan: the same on every machine, so integer hashes and + - * / only.
#pragma once

#include <cstdint>

namespace folprom::cli {

/// Finaliser of splitmix64: every bit of the result depends on every bit of x.
constexpr uint64_t Mix(uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// sin(2 pi t) for any t in [-2^30, 2^30], error below 1e-6.
inline double SinTurns(double t) {
  // To [-1/2, 1/2], then by symmetry to [-1/4, 1/4].
  double r = t - static_cast<double>(static_cast<int32_t>(t));
  r = r > 0.5 ? r - 1 : r;
  r = r < -0.5 ? r + 1 : r;
  r = r > 0.25 ? 0.5 - r : r;
  r = r < -0.25 ? -0.5 - r : r;
  const double s = r * r;
  // Taylor series of sin(2 pi r) to r^11.
  return r *
         (6.283185307179586 +
          s * (-41.34170224039976 +
               s * (81.60524927607506 +
                    s * (-76.70585975306136 + s * (42.05869394489765 + s * -15.09464257682298)))));
}

inline double CosTurns(double t) { return SinTurns(t + 0.25); }

/// Value of a lattice point, uniform in [-1, 1).
inline float LatticeValue(uint32_t h) {
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  h *= 0x297A2D39u;
  return static_cast<float>(static_cast<int32_t>(h)) * (1.0f / 2147483648.0f);
}

/// Smooth value noise in [-1, 1], features of size 1. Coordinates must lie in [0, 2^24).
inline float ValueNoise(float x, float y, float z, uint32_t seed) {
  const auto ix = static_cast<int32_t>(x);
  const auto iy = static_cast<int32_t>(y);
  const auto iz = static_cast<int32_t>(z);
  const float rx = x - static_cast<float>(ix);
  const float ry = y - static_cast<float>(iy);
  const float rz = z - static_cast<float>(iz);
  const float wx = rx * rx * (3 - 2 * rx);
  const float wy = ry * ry * (3 - 2 * ry);
  const float wz = rz * rz * (3 - 2 * rz);
  constexpr uint32_t kX = 0x9E3779B1u, kY = 0x85EBCA77u, kZ = 0xC2B2AE3Du;
  const uint32_t h = seed + static_cast<uint32_t>(ix) * kX + static_cast<uint32_t>(iy) * kY +
                     static_cast<uint32_t>(iz) * kZ;
  const auto along_x = [&](uint32_t corner) {
    const float lo = LatticeValue(corner);
    return lo + wx * (LatticeValue(corner + kX) - lo);
  };
  const float y0 = along_x(h), y1 = along_x(h + kY);
  const float y2 = along_x(h + kZ), y3 = along_x(h + kY + kZ);
  const float z0 = y0 + wy * (y1 - y0);
  const float z1 = y2 + wy * (y3 - y2);
  return z0 + wz * (z1 - z0);
}

}  // namespace folprom::cli
