#include "passes/combine_lightmap/showing.h"

#include <cmath>
#include <cstdint>

#include "passes/lightmap/copy_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::combine {

namespace ap = nodes::appearance;
namespace ifs = nodes::indexed_face_set;

void Showing::keep(NodeId shape) {
  for_each_child(scene_, shape, [&](NodeId c) {
    if (c) kept_.insert(c.value);
  });
}

void Showing::show(std::vector<ShownGeometry> geometries, const std::vector<ShownShape>& shapes) {
  // All copies come first: they are of what was there.
  for (ShownGeometry& g : geometries) g.node = geometry_of(g);
  std::vector<NodeId> appearances, transforms;
  for (const ShownShape& s : shapes) {
    appearances.push_back(appearance_of(s));
    transforms.push_back(transform_of(s));
  }
  for (const ShownGeometry& g : geometries)
    if (g.colors.empty())
      give_places(g.node, g.places);
    else
      give_colors(g.node, g.colors);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    give_texture(appearances[i], shapes[i].texture, transforms[i]);
    const NodeId shape = shapes[i].shape, geometry = geometries[shapes[i].geometry].node;
    if (appearances[i] != shapes[i].appearance) scene_.set(shape, nodes::shape::appearance, appearances[i]);
    if (scene_.get(shape, nodes::shape::geometry) != geometry) scene_.set(shape, nodes::shape::geometry, geometry);
  }
}

/// With the light's own places the geometry of a lightmap stays as it is.
NodeId Showing::geometry_of(const ShownGeometry& g) {
  if (into_ == CombineTarget::lightmap && g.places.empty()) return g.node;
  return claim(g.node) ? g.node : bake::copy_of(scene_, g.node);
}

NodeId Showing::appearance_of(const ShownShape& s) {
  if (s.transform) return claim(s.appearance) ? s.appearance : bake::copy_of(scene_, s.appearance);
  NodeId& known = appearances_[{s.appearance.value, s.texture.value}];
  if (!known) known = claim(s.appearance) ? s.appearance : bake::copy_of(scene_, s.appearance);
  return known;
}

/// Texture coordinates are those of the light then, and colours are in the picture.
void Showing::give_places(NodeId g, const std::vector<double>& places) {
  const bool light_only = into_ == CombineTarget::lightmap;
  if (light_only && places.empty()) return;
  NodeId coords = scene_.get(g, ifs::lightCoord);
  if (!places.empty()) {
    coords = scene_.add(nodes::TextureCoordinate, scene_.where(coords));
    scene_.set(coords, nodes::texture_coordinate::point, places);
  }
  if (light_only) return scene_.set(g, ifs::lightCoord, coords);
  const auto listed = scene_.get(g, ifs::lightCoordIndex);
  const std::vector<std::int32_t> index(listed.begin(), listed.end());
  for (auto slot : {ifs::color.slot, ifs::colorIndex.slot, ifs::colorPerVertex.slot, ifs::texCoordIndex.slot,
                    ifs::lightCoord.slot, ifs::lightCoordIndex.slot})
    scene_.unset(g, slot);
  scene_.set(g, ifs::texCoord, coords);
  if (!index.empty()) scene_.set(g, ifs::texCoordIndex, index);
}

/// Three digits are as many as 255 steps need.
void Showing::give_colors(NodeId g, const std::vector<std::array<double, 3>>& colors) {
  constexpr double steps = 1000;
  std::vector<double> numbers;
  for (const auto& color : colors)
    for (const double v : color) numbers.push_back(std::round(v * steps) / steps);
  const auto listed = scene_.get(g, ifs::lightCoordIndex);
  const std::vector<std::int32_t> index(listed.begin(), listed.end());
  for (auto slot : {ifs::texCoord.slot, ifs::texCoordIndex.slot, ifs::colorIndex.slot, ifs::colorPerVertex.slot,
                    ifs::lightCoord.slot, ifs::lightCoordIndex.slot})
    scene_.unset(g, slot);
  const NodeId node = scene_.add(nodes::Color, scene_.where(g));
  scene_.set(node, nodes::color::color, numbers);
  scene_.set(g, ifs::color, node);
  if (!index.empty()) scene_.set(g, ifs::colorIndex, index);
}

NodeId Showing::transform_of(const ShownShape& s) {
  namespace f = nodes::texture_transform;
  if (s.as_light) return scene_.get(s.appearance, ap::lightmapTransform);
  const auto numbers = s.transform ? texture_transform_of(*s.transform) : std::nullopt;
  if (!numbers) return {};
  const NodeId n = scene_.add(nodes::TextureTransform);
  scene_.set(n, f::rotation, numbers->rotation, f::scale, numbers->scale, f::translation, numbers->translation);
  return n;
}

void Showing::give_texture(NodeId appearance, NodeId texture, NodeId transform) {
  for (auto slot : {ap::lightmapTransform.slot, ap::lightmapScale.slot}) scene_.unset(appearance, slot);
  if (into_ == CombineTarget::lightmap) {
    scene_.set(appearance, ap::lightmap, texture);
    if (transform) scene_.set(appearance, ap::lightmapTransform, transform);
    return;
  }
  for (auto slot : {ap::material.slot, ap::textureTransform.slot, ap::lightmap.slot, ap::lightmapDirection.slot})
    scene_.unset(appearance, slot);
  if (texture)
    scene_.set(appearance, ap::texture, texture);
  else
    scene_.unset(appearance, ap::texture.slot);
  if (transform) scene_.set(appearance, ap::textureTransform, transform);
}

}  // namespace wrlkit::combine
