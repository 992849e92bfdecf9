// Faces and polylines put together again: triangles that were one polygon, segments that were one polyline, vertices
// that were one point.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace wrlkit::gltf_reader {

/// Polygons or polylines of vertices.
struct Polygons {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> begin{0};  // of each, and the end
  std::size_t size() const { return begin.size() - 1; }
  void close() { begin.push_back(static_cast<std::uint32_t>(corners.size())); }
};

/// `runs` are pairs: N triangles are one polygon, M times; what they do not cover are triangles. Triangles whose
/// outline is not one loop stay triangles. Linear.
Polygons polygons_of(std::span<const std::uint32_t> triangles, std::span<const double> runs);
/// Segments that go on where the one before ends.
Polygons polylines(std::span<const std::uint32_t> segments);

/// Equal values once, in the order in which they are met.
struct Joined {
  std::vector<double> values;
  std::vector<std::int32_t> of_vertex;
};
Joined join(std::span<const double> values, std::size_t width);

/// As coordIndex and the like have it, with -1 behind each; and one number for each polygon, that of its first corner.
std::vector<std::int32_t> index_of(const Polygons&, std::span<const std::int32_t> of_vertex);
std::vector<std::int32_t> face_index_of(const Polygons&, std::span<const std::int32_t> of_vertex);
std::vector<std::int32_t> faces_of(std::span<const std::uint32_t> triangles);
std::vector<std::int32_t> polylines_of(std::span<const std::uint32_t> segments);
/// 0 1 2 ...
bool counts_up(std::span<const std::int32_t> index);

}  // namespace wrlkit::gltf_reader
