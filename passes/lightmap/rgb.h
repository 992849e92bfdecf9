// Light in three colours, linear.
#pragma once

namespace wrlkit::bake {

struct Rgb {
  float r = 0, g = 0, b = 0;

  Rgb& operator+=(const Rgb& o) {
    r += o.r;
    g += o.g;
    b += o.b;
    return *this;
  }
  // Friends do not hide the operators of Vec3 from this namespace.
  friend Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
  friend Rgb operator-(const Rgb& a, const Rgb& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
  friend Rgb operator*(float s, const Rgb& a) { return {s * a.r, s * a.g, s * a.b}; }
};

/// Luminance by Rec. 709, whose primaries sRGB has.
inline float luminance(const Rgb& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

}  // namespace wrlkit::bake
