// The vertex and index data of a glTF file: a few buffer views, each with all values of one kind in a row, and
// accessors into them. Equal data is stored once, whoever asks: the indices of a thousand cylinders are the same
// numbers.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/io/blocks.h"
#include "base/math/box.h"

namespace wrlkit::gltf {

inline constexpr std::uint32_t none = 0xffffffffu;

enum class View : std::uint8_t {
  position,
  normal,
  rgb,
  rgba,
  texcoord,
  index16,
  index32,
  time,
  moving1,
  moving2,
  moving3,
  moving4,
  // Quantised (packing.h). "grid": floats on a grid; "sequence": indices that are not those of triangles.
  short_position,
  byte_normal,
  short_rgb,
  short_rgba,
  short_texcoord,
  grid_position,
  oct_normal,
  grid_texcoord,
  sequence16,
  sequence32,
  feature,  // numbers of parts, of vertices
  part,     // the same, of places
  place3,
  place4,        // of instances, on a grid
  short_feature  // in the data of Draco
};
inline constexpr std::size_t n_views = 27;

/// What meshoptimizer's decoder does to the elements of a view behind decoding (EXT_meshopt_compression).
enum class Filter : std::uint8_t { none, octahedral, exponential };

struct ViewInfo {
  std::uint8_t element;  // bytes
  std::uint16_t component_type;
  bool vertices, indices, normalized;
  const char* type;
  Filter filter;
  std::string_view name;  // what it holds
};
const ViewInfo& info(View);

/// The bounds of the positions of one accessor, as the floats that are stored.
using Bounds = BoxOf<float, 3>;

struct Accessor {
  std::uint32_t offset, count;  // bytes, elements; no offset (none): the values are elsewhere, packed by Draco
  std::uint32_t bounds;         // into Store::bounds; none unless of positions
  View view;
};

class Store {
 public:
  /// No more than `most` bytes are taken: a .glb ends at 4 GiB, and so do the offsets of accessors.
  explicit Store(std::uint32_t most = std::numeric_limits<std::uint32_t>::max()) : most_(most) {}

  /// Accessors with these values; `none` when they do not fit any more.
  std::uint32_t positions(std::span<const float>, const Bounds&);
  std::uint32_t vertices(View, std::span<const float>);
  /// Times of an animation, ascending.
  std::uint32_t times(std::span<const float>);
  /// 16-bit indices when there are few enough vertices for them.
  std::uint32_t indices(std::span<const std::uint32_t>, std::size_t n_vertices);
  /// Bytes as they are to be stored; `bounds` of positions.
  std::uint32_t raw(View, std::string_view bytes, const Bounds* bounds = nullptr);
  /// Without values.
  std::uint32_t described(View, std::uint32_t count, const Bounds* bounds = nullptr);
  /// The bytes of an accessor.
  std::string bytes(std::uint32_t accessor) const;

  const std::vector<Accessor>& accessors() const { return accessors_; }
  const std::vector<Bounds>& bounds() const { return bounds_; }
  const Bounds& bounds_of(std::uint32_t accessor) const { return bounds_[accessors_[accessor].bounds]; }
  const Blocks& view(View v) const { return views_[static_cast<std::size_t>(v)]; }
  std::uint64_t bytes() const;
  /// Data had to be refused.
  bool full() const { return full_; }

 private:
  struct Slot {
    std::uint32_t hash = 0, accessor = none;
  };
  std::uint32_t add(View, const void* data, std::size_t n_bytes);
  void set_bounds(std::uint32_t accessor, const Bounds&);
  Slot& find(View, const void* data, std::size_t n_bytes, std::uint32_t hash);
  void grow();

  std::array<Blocks, n_views> views_;
  std::vector<Accessor> accessors_;
  std::vector<Bounds> bounds_;
  std::vector<Slot> slots_ = std::vector<Slot>(64);  // open addressing, a power of two
  std::vector<std::uint16_t> narrow_;
  std::uint64_t most_;
  bool full_ = false;
};

}  // namespace wrlkit::gltf
