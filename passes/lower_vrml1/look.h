// Materials and textures of VRML 1.0 as Appearances. A Material of VRML 1.0 is six lists; the k-th material has the
// k-th value of each, the last one of a shorter list, and behind the longest list they begin again. A Shape of VRML97
// has one Material and, by a Color node, many diffuse colours: materials that agree in all but diffuseColor are of one
// kind.
#pragma once
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "base/diagnostics.h"
#include "passes/lower_vrml1/state.h"
#include "scenegraph/looks/texture_transform_node.h"

namespace wrlkit::vrml1 {

/// The materials of a state.
struct Palette {
  std::vector<double> colors;  // what shapes show: diffuse, or emissive where nothing is lit; rgb
  std::vector<std::uint32_t>
      kind;              // of each material: the first one that agrees with it; empty: all agree with the first
  std::size_t size = 1;  // of materials; the next one is the first again
  bool unlit = false;    // the colours are not lit

  Vec3 color(std::size_t k) const;
  std::size_t kind_of(std::size_t k) const { return kind.empty() ? 0 : kind[k % size]; }
};

class Looks {
 public:
  Looks(Scene& scene, Diagnostics& diag) : scene_(scene), diag_(diag) {}

  const Palette& palette(const State&);
  /// The colours of a palette as a node.
  NodeId color_node(const State&);
  /// How one of the materials looks; `colored`: the geometry has colours. `strokes`: lines or points, which are not
  /// lit. `baked`: the texture coordinates are moved already.
  NodeId appearance(const State&, std::size_t material, bool colored, bool strokes, bool baked);

  /// A Texture2Transform behind those in force: its number.
  std::uint32_t then(std::uint32_t map, NodeId texture_transform);
  const TexcoordMap& uv_map(std::uint32_t i) const { return maps_[i]; }
  /// Whether a TextureTransform can express it; VRML97 scales last, VRML 1.0 first.
  bool can_say(std::uint32_t map) const;
  bool has_texture(NodeId texture2) const;

 private:
  std::span<const double> list(NodeId material, std::uint16_t slot) const;
  Palette make_palette(const State&) const;
  NodeId material_node(const State&, std::size_t k, bool colored, bool strokes, NodeId picture);
  NodeId unlit_node(const State&, std::size_t k, bool colored, double transparency, NodeId picture);
  NodeId texture_node(NodeId texture2);
  NodeId texture_transform(std::uint32_t map);

  Scene& scene_;
  Diagnostics& diag_;
  std::map<std::tuple<NodeId, NodeId, bool>, Palette> palettes_;
  std::map<std::tuple<NodeId, NodeId, bool>, NodeId> colors_;
  std::map<std::tuple<NodeId, NodeId, bool, std::size_t, bool, bool, NodeId>, NodeId> materials_;
  std::map<std::tuple<NodeId, NodeId, std::uint32_t, NodeId>, NodeId> appearances_;
  std::map<NodeId, NodeId> textures_;
  std::map<std::uint32_t, NodeId> transforms_;
  std::vector<TexcoordMap> maps_{TexcoordMap{}};
  std::map<TexcoordMap, std::uint32_t> map_numbers_;
};

}  // namespace wrlkit::vrml1
