// Numbers with fewer bits. Positions of all meshes lie on one grid: its step is a power of two, and its points are
// whole multiples of the step in every local frame. What two parts share they share afterwards, too: no cracks.
#pragma once
#include <span>
#include <string>

#include "writers/gltf/store.h"

namespace wrlkit::gltf {

/// The largest step of a grid, a power of two, on which no point moves by more than `tolerance`.
double grid_step(double tolerance);

struct Quantized {
  std::string bytes;
  Bounds bounds{};   // of positions: the numbers that are stored; with the filter, what it makes of them
  double error = 0;  // largest distance that a value moved: length, or for normals the angle in radians
};

/// Floats of `width` components on a grid, in the form from which the filter EXPONENTIAL makes floats: 24 bits of a
/// mantissa, 8 of an exponent that is the same everywhere.
Quantized on_grid(std::span<const float> values, std::size_t width, double step);
/// The same as floats.
std::vector<float> snapped(std::span<const float> values, std::size_t width, double step, double& error);

/// Sixteen bits a component, relative to a point of the grid; padded to eight bytes.
struct ShortPositions {
  Quantized values;
  std::array<double, 3> origin{};
};
/// The positions must reach no further than 65,535 steps.
ShortPositions short_positions(std::span<const float> xyz, double step);

/// Unit vectors as signed bytes, and filtered.
Quantized byte_normals(std::span<const float> xyz);
Quantized octahedral_normals(std::span<const float> xyz, int bits);
/// Values in [0, 1] as unsigned shorts of that many significant bits; padded to a multiple of four bytes.
Quantized shorts(std::span<const float> values, std::size_t width, int bits);

}  // namespace wrlkit::gltf
