#include "writers/gltf/pointers.h"

#include <cmath>
#include <numbers>

#include "scenegraph/nodes.h"
#include "writers/gltf/color.h"
#include "writers/gltf/number.h"
#include "writers/gltf/texture_transform.h"

namespace wrlkit::gltf {
namespace {

using In = std::span<const Property::At>;
using Out = std::vector<double>;

class Pointers {
 public:
  Pointers(Animations& animations, const Scene& scene) : animations_(animations), scene_(scene) {}

  void material(const Materials::Moved& m) {
    const std::string at = "/materials/" + std::to_string(m.material);
    if (m.transform)
      for (std::string_view picture : m.mapped)
        texture_transform(at + "/" + std::string(picture) + "/extensions/KHR_texture_transform", m.transform);
    if (!m.source) return;
    // The fields that are looked at, a missing one as it stands. Those of a PhysicalMaterial are linear.
    const bool physical = scene_.is(m.source, nodes::PhysicalMaterial);
    const auto moved = [physical](const Property::At& field, const Vec3& displayed) {
      return physical ? vec3(field.value(sample(all_linear(displayed))))
                      : all_linear(vec3(field.value(sample(displayed))));
    };
    auto base = [=](In in, Out& out) {
      const Vec3 color = m.base_field.empty() ? all_linear(m.base) : moved(in[0], m.base);
      out.insert(out.end(), color.begin(), color.end());
      out.push_back(m.shows_alpha ? 1 - unit_range(in.back().value({1 - m.alpha})[0]) : m.alpha);
    };
    add(at + "/pbrMetallicRoughness/baseColorFactor", 4, m.source, {m.base_field, m.shows_alpha ? "transparency" : ""},
        base, false);
    auto emissive = [=](In in, Out& out) {
      const Vec3 color = moved(in[0], m.emissive);
      out.insert(out.end(), color.begin(), color.end());
    };
    if (m.shows_emissive) add(at + "/emissiveFactor", 3, m.source, {"emissiveColor"}, emissive, false);
    if (!m.lit) return;
    if (physical) {
      for (auto [field, factor] : {std::pair{"metallic", "metallicFactor"}, {"roughness", "roughnessFactor"}})
        add(
            at + "/pbrMetallicRoughness/" + factor, 1, m.source, {field},
            [](In in, Out& out) { out.push_back(unit_range(in[0].value({})[0])); }, false);
      return;
    }
    const double shininess = scene_.get(m.source, nodes::material::shininess);
    const Vec3 specular = scene_.get(m.source, nodes::material::specularColor);
    auto rough = [=](In in, Out& out) {
      out.push_back(roughness(in[0].value({shininess})[0], vec3(in[1].value(sample(specular)))));
    };
    add(at + "/pbrMetallicRoughness/roughnessFactor", 1, m.source, {"shininess", "specularColor"}, rough, false);
  }

  void light(std::size_t i, const Light& l, const Box& world) {
    const std::string at = "/extensions/KHR_lights_punctual/lights/" + std::to_string(i);
    auto color = [](In in, Out& out) {
      for (double v : vec3(in[0].value({}))) out.push_back(linear(v));
    };
    add(at + "/color", 3, l.source, {"color"}, color, false);
    const double full = full_intensity(scene_, l, world);
    add(
        at + "/intensity", 1, l.source, {"intensity"},
        [full](In in, Out& out) { out.push_back(full * std::max(in[0].value({})[0], 0.0)); }, false);
  }

  void camera(std::size_t i, NodeId n) {
    if (scene_.is(n, nodes::Viewpoint))
      add(
          "/cameras/" + std::to_string(i) + "/perspective/yfov", 1, n, {"fieldOfView"},
          [](In in, Out& out) { out.push_back(in[0].value({})[0]); }, true);
  }

  /// KHR_texture_transform counts from the top, and scales before it turns: a turn has an even scale.
  void texture_transform(const std::string& at, NodeId n) {
    namespace f = nodes::texture_transform;
    const TextureTransformNode still = read_texture_transform(scene_, n);
    const Vec2& scale = still.scale;
    const double rotation = still.rotation;
    const bool turns = rotation != 0 || animations_.motion().moves(n, f::rotation.slot);
    auto two = [](const Property::At& in, const Vec2& otherwise) {
      const Sample s = in.value({otherwise[0], otherwise[1]});
      return Vec2{s[0], s[1]};
    };
    auto offset = [=](In in, Out& out) {
      const TexcoordMap a = TextureTransformNode{two(in[0], still.center), two(in[1], still.scale),
                                                 two(in[3], still.translation), in[2].value({still.rotation})[0]}
                                .map();
      out.push_back(a.xy + a.x);
      out.push_back(1 - a.yy - a.y);
    };
    auto size = [=](In in, Out& out) {
      const Vec2 s = two(in[0], scale);
      for (double v : s) out.push_back(turns ? std::abs(v) : v);
    };
    auto turn = [=](In in, Out& out) {
      out.push_back(in[0].value({rotation})[0] + (scale[0] < 0 ? std::numbers::pi : 0));
    };
    add(at + "/offset", 2, n, {"center", "scale", "rotation", "translation"}, offset, false);
    add(at + "/scale", 2, n, {"scale"}, size, true);
    if (turns) add(at + "/rotation", 1, n, {"rotation"}, turn, true);
  }

 private:
  static Sample sample(const Vec3& v) { return {v[0], v[1], v[2], 0}; }
  static Vec3 vec3(const Sample& s) { return {s[0], s[1], s[2]}; }
  static Vec3 all_linear(const Vec3& v) { return {linear(v[0]), linear(v[1]), linear(v[2])}; }

  /// Unless none of the fields is moved.
  void add(std::string pointer, std::size_t width, NodeId source, std::initializer_list<std::string_view> fields,
           Property::Evaluate evaluate, bool straight) {
    Property p{{}, std::move(pointer), width, {}, std::move(evaluate), straight};
    bool moved = false;
    for (auto f : fields) {
      auto slot = f.empty() ? std::nullopt : scene_.type(source).find(f, Dialect::x3d);
      if (!slot) continue;
      p.inputs.push_back({source.value, *slot});
      moved |= animations_.motion().moves(source, *slot);
    }
    if (moved) animations_.add(std::move(p));
  }

  Animations& animations_;
  const Scene& scene_;
};

}  // namespace

void add_pointers(Animations& animations, const Scene& scene, const Materials& materials, const Document& document,
                  Diagnostics& diag) {
  for (const auto& [node, slot] : materials.outshone()) {
    const auto& type = scene.type(NodeId{node});
    diag.report(Diag::no_gltf_value, scene.where(NodeId{node}), type.name,
                std::string(type.fields[slot].name_in(scene.dialect())) + ", animated behind a lightmap,");
  }
  Pointers p(animations, scene);
  for (const auto& m : materials.moved()) p.material(m);
  for (std::size_t i = 0; i < document.lights.size(); ++i)
    if (document.lights[i].source) p.light(i, document.lights[i], document.world);
  for (std::size_t i = 0; i < document.cameras.size(); ++i) p.camera(i, document.cameras[i].source);
}

}  // namespace wrlkit::gltf
