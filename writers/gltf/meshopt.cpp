#include "writers/gltf/meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>

namespace wrlkit::gltf {
namespace {

constexpr std::size_t large = 3 * 5000;      // corners from which overdraw counts for more than sharing indices
constexpr float overdraw_threshold = 1.05f;  // how much worse the vertex cache may become for it

void permute(std::vector<float>& values, std::size_t width, std::span<const std::uint32_t> to) {
  if (values.empty()) return;
  std::vector<float> out(values.size());
  for (std::size_t v = 0; v < to.size(); ++v) std::copy_n(&values[v * width], width, &out[to[v] * width]);
  values = std::move(out);
}

std::vector<unsigned> wide(std::string_view bytes, std::size_t width) {
  std::vector<unsigned> out(bytes.size() / width);
  for (std::size_t i = 0; i < out.size(); ++i) std::memcpy(&out[i], bytes.data() + i * width, width);
  return out;
}

unsigned highest(const std::vector<unsigned>& index) { return index.empty() ? 0 : *std::ranges::max_element(index); }

using Pack = std::size_t(unsigned char*, std::size_t, const unsigned*, std::size_t);
using Bound = std::size_t(std::size_t, std::size_t);

std::string packed_indices(std::string_view bytes, std::size_t width, Pack* pack, Bound* bound) {
  meshopt_encodeIndexVersion(1);
  const auto index = wide(bytes, width);
  std::string out(bound(index.size(), std::size_t{highest(index)} + 1), '\0');
  out.resize(pack(reinterpret_cast<unsigned char*>(out.data()), out.size(), index.data(), index.size()));
  return out;
}

}  // namespace

void order_for_drawing(Vertices& v) {
  if (v.index.empty() || v.index.size() % 3 != 0) return;
  const std::size_t n = v.count();
  std::vector<unsigned> index(v.index.size()), to(n);
  meshopt_optimizeVertexCacheStrip(index.data(), v.index.data(), index.size(), n);
  // Of parts that were merged, ids and colours are runs as long as the parts stay together.
  if (index.size() >= large && v.feature.empty())
    meshopt_optimizeOverdraw(index.data(), std::vector(index).data(), index.size(), v.position.data(), n,
                             3 * sizeof(float), overdraw_threshold);
  if (meshopt_optimizeVertexFetchRemap(to.data(), index.data(), index.size(), n) != n) return;
  for (auto& i : index) i = to[i];
  v.index.assign(index.begin(), index.end());
  permute(v.position, 3, to);
  permute(v.normal, 3, to);
  permute(v.color, static_cast<std::size_t>(v.color_width), to);
  permute(v.texcoord, 2, to);
  permute(v.lightcoord, 2, to);
  permute(v.feature, 1, to);
}

std::string pack_elements(std::string_view bytes, std::size_t stride) {
  meshopt_encodeVertexVersion(0);
  const std::size_t n = bytes.size() / stride;
  std::string out(meshopt_encodeVertexBufferBound(n, stride), '\0');
  out.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), bytes.data(), n, stride));
  return out;
}

std::string pack_triangles(std::string_view bytes, std::size_t width) {
  return packed_indices(bytes, width, meshopt_encodeIndexBuffer, meshopt_encodeIndexBufferBound);
}

std::string pack_sequence(std::string_view bytes, std::size_t width) {
  return packed_indices(bytes, width, meshopt_encodeIndexSequence, meshopt_encodeIndexSequenceBound);
}

std::string octahedral(std::span<const float> xyz, int bits) {
  std::vector<float> four;
  four.reserve(xyz.size() / 3 * 4);
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) four.insert(four.end(), {xyz[i], xyz[i + 1], xyz[i + 2], 0});
  std::string out(four.size(), '\0');
  meshopt_encodeFilterOct(out.data(), four.size() / 4, 4, bits, four.data());
  return out;
}

std::vector<float> undo_octahedral(std::string bytes) {
  const std::size_t n = bytes.size() / 4;
  bytes.resize((n + 3) / 4 * 16);  // the filter reads groups of four
  meshopt_decodeFilterOct(bytes.data(), (n + 3) / 4 * 4, 4);
  std::vector<float> out;
  out.reserve(n * 3);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      out.push_back(std::max(static_cast<signed char>(bytes[i * 4 + k]) / 127.0f, -1.0f));
  return out;
}

}  // namespace wrlkit::gltf
