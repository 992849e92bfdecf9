#include "passes/lower_x3d/texture_background.h"

#include "passes/lower_x3d/geometry.h"
#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

namespace b = nodes::background;
namespace t = nodes::texture_background;

struct Side {
  std::string_view name;
  FieldKey<FieldType::SFNode> texture;
  FieldKey<FieldType::MFString> url;
};
constexpr Side sky_sides[] = {
    {"frontTexture", t::frontTexture, b::frontUrl}, {"backTexture", t::backTexture, b::backUrl},
    {"leftTexture", t::leftTexture, b::leftUrl},    {"rightTexture", t::rightTexture, b::rightUrl},
    {"topTexture", t::topTexture, b::topUrl},       {"bottomTexture", t::bottomTexture, b::bottomUrl}};

}  // namespace

bool lower_texture_background(Scene& scene, NodeId n, Diagnostics& diag) {
  if (!scene.is(n, nodes::TextureBackground)) return false;
  auto fields = fields_for(scene, n, nodes::Background);
  for (const Side& side : sky_sides) {
    const NodeId texture = scene.get(n, side.texture);
    if (!texture) continue;
    if (scene.is(texture, nodes::ImageTexture))
      fields.push_back(scene.make(FieldType::MFString, side.url.slot, scene.get(texture, nodes::image_texture::url)));
    else
      diag.report(Diag::no_vrml97_value, scene.where(texture), "TextureBackground", side.name);
  }
  scene.become(n, nodes::Background, fields);
  return true;
}

}  // namespace wrlkit::x3d
