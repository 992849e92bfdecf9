#include "writers/gltf/quantize.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "writers/gltf/meshopt.h"

namespace wrlkit::gltf {
namespace {

template <class T>
void put(std::string& out, T v) {
  out.append(reinterpret_cast<const char*>(&v), sizeof v);
}

double distance(std::span<const float> a, const float* b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (double{a[k]} - b[k]) * (double{a[k]} - b[k]);
  return std::sqrt(sum);
}

/// Between two directions, neither of which need have unit length.
double angle(const float* a, const float* b) {
  double dot = 0, aa = 0, bb = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    dot += double{a[k]} * b[k];
    aa += double{a[k]} * a[k];
    bb += double{b[k]} * b[k];
  }
  return std::acos(std::clamp(dot / std::sqrt(std::max(aa * bb, 1e-30)), -1.0, 1.0));
}

}  // namespace

double grid_step(double tolerance) { return std::exp2(std::floor(std::log2(2 * tolerance / std::numbers::sqrt3))); }

std::vector<float> snapped(std::span<const float> values, std::size_t width, double step, double& error) {
  std::vector<float> out(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    out[i] = static_cast<float>(std::round(values[i] / step) * step + 0.0);  // no -0
  for (std::size_t i = 0; i + width <= values.size(); i += width)
    error = std::max(error, distance(values.subspan(i, width), &out[i]));
  return out;
}

Quantized on_grid(std::span<const float> values, std::size_t width, double step) {
  // What lies further out than 24 bits of steps has no such digits as a float either.
  constexpr double most = (1 << 23) - 1;
  double reach = 0;
  for (float v : values) reach = std::max(reach, std::abs(double{v}));
  while (reach / step > most) step *= 2;
  const auto exponent = static_cast<std::uint32_t>(std::ilogb(step)) << 24;
  Quantized out;
  const auto floats = snapped(values, width, step, out.error);
  out.bytes.reserve(floats.size() * 4);
  for (float v : floats)
    put(out.bytes, exponent | (static_cast<std::uint32_t>(static_cast<std::int32_t>(v / step)) & 0xffffff));
  if (width == 3) out.bounds = box_of<3, float>(floats);
  return out;
}

ShortPositions short_positions(std::span<const float> xyz, double step) {
  ShortPositions out;
  const auto floats = snapped(xyz, 3, step, out.values.error);
  const auto box = box_of<3, float>(floats);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool near = std::max(std::abs(box.low[k]), std::abs(box.high[k])) <= 32767 * step;
    out.origin[k] = near ? 0 : std::round((double{box.low[k]} + box.high[k]) / 2 / step) * step;
  }
  for (std::size_t i = 0; i + 3 <= floats.size(); i += 3) {
    std::array<float, 3> q{};
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = static_cast<float>(std::clamp(std::round((floats[i + k] - out.origin[k]) / step), -32768.0, 32767.0));
      put(out.values.bytes, static_cast<std::int16_t>(q[k]));
    }
    put(out.values.bytes, std::int16_t{0});
    out.values.bounds.add(q);
  }
  return out;
}

Quantized byte_normals(std::span<const float> xyz) {
  Quantized out;
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3) {
    std::array<float, 3> q{};
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = std::round(std::clamp(xyz[i + k], -1.0f, 1.0f) * 127);
      put(out.bytes, static_cast<std::int8_t>(q[k]));
    }
    put(out.bytes, std::int8_t{0});
    out.error = std::max(out.error, angle(&xyz[i], q.data()));
  }
  return out;
}

Quantized octahedral_normals(std::span<const float> xyz, int bits) {
  Quantized out{octahedral(xyz, bits)};
  const auto back = undo_octahedral(out.bytes);
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3) out.error = std::max(out.error, angle(&xyz[i], &back[i]));
  return out;
}

Quantized shorts(std::span<const float> values, std::size_t width, int bits) {
  constexpr double largest = 65535;
  const double steps = (1 << std::clamp(bits, 1, 16)) - 1;
  Quantized out;
  for (std::size_t i = 0; i + width <= values.size(); i += width) {
    for (std::size_t k = 0; k < width; ++k) {
      const double q = std::round(std::round(std::clamp(values[i + k], 0.0f, 1.0f) * steps) / steps * largest);
      put(out.bytes, static_cast<std::uint16_t>(q));
      out.error = std::max(out.error, std::abs(q / largest - values[i + k]));
    }
    if (width % 2) put(out.bytes, std::uint16_t{0});
  }
  return out;
}

}  // namespace wrlkit::gltf
