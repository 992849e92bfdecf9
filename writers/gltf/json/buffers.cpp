#include "writers/gltf/json/lists.h"

#include "scenegraph/tags.h"
#include "writers/gltf/json/part.h"

namespace wrlkit::gltf {
namespace {

constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr int nearest_filter = 9728, linear_filter = 9729, repeat = 10497, clamp_to_edge = 33071,
              mirrored_repeat = 33648;

class BufferJson : public JsonPart {
 public:
  using JsonPart::JsonPart;

  void texture(const Texture& t) {
    json_.object([&] {
      if (auto name = name_of(t.source); !name.empty()) json_.member("name", name);
      json_.member("sampler", t.sampler);
      if (p_.textures.pictures()[t.picture].is_webp())
        webp(t.picture);
      else
        json_.member("source", t.picture);
      if (p_.extras && !p_.facts_only) p_.extras->member(json_, t.source, said_by_texture(p_.scene, t.source));
      if (p_.extras && p_.facts_only && has_tags(p_.scene, t.source))
        json_.object("extras", [&] { json_.object("vrml97", [&] { p_.extras->tags(json_, t.source); }); });
    });
  }

  void image(std::size_t i) {
    const Picture& picture = p_.textures.pictures()[i];
    json_.object([&] {
      json_.member("name", picture.name);
      if (p_.layout.pictures_inside()) {
        json_.members("mimeType", picture.mime, "bufferView", p_.layout.of_picture(i));
      } else {
        json_.member("uri", p_.picture_uris[i]);
      }
    });
  }

  void sampler(const TextureSampler& s) {
    json_.object([&] {
      json_.members("magFilter", s.nearest ? nearest_filter : linear_filter, "minFilter",
                    static_cast<std::uint32_t>(s.minified));
      for (const auto& [name, wrap] : {std::pair("wrapS", s.s), {"wrapT", s.t}})
        if (wrap != Wrap::repeat) json_.member(name, wrap == Wrap::clamp ? clamp_to_edge : mirrored_repeat);
    });
  }

  void accessor(const Accessor& a) {
    const auto& type = info(a.view);
    json_.object([&] {
      if (a.offset != none) json_.member("bufferView", p_.layout.of(a.view));
      if (a.offset > 0 && a.offset != none) json_.member("byteOffset", a.offset);
      json_.members("componentType", type.component_type, "count", a.count);
      if (type.normalized) json_.member("normalized", true);
      json_.member("type", type.type);
      if (a.bounds != none) {
        const auto& b = p_.packing.store().bounds()[a.bounds];
        const std::size_t n = a.view == View::time ? 1 : 3;
        json_.member("max", std::span<const float>(b.high).first(n));
        json_.member("min", std::span<const float>(b.low).first(n));
      }
    });
  }

  void buffer_view(const Layout::BufferView& v) {
    const bool packed = v.unpacked > 0;
    const auto offset = packed ? v.unpacked_offset : v.offset;
    json_.object([&] {
      json_.member("buffer", packed ? 1 : 0);
      if (offset > 0) json_.member("byteOffset", offset);
      json_.member("byteLength", packed ? v.unpacked : v.length);
      if (v.picture == none && v.blob == none && v.column == none) {
        const auto& type = info(v.view);
        if (type.vertices) json_.member("byteStride", type.element);
        if (type.vertices || type.indices) json_.member("target", type.vertices ? array_buffer : element_array_buffer);
      }
      if (packed) packed_view(v);
    });
  }

  void unpacked_buffer() {
    json_.object([&] {
      json_.member("byteLength", p_.layout.unpacked_size());
      json_.member("extensions", JsonText{R"({"EXT_meshopt_compression":{"fallback":true}})"});
    });
  }

  void buffer() {
    json_.object([&] {
      json_.member("byteLength", p_.layout.size());
      if (!p_.buffer_uri.empty()) json_.member("uri", p_.buffer_uri);
    });
  }

 private:
  void webp(std::uint32_t picture) {
    extension("EXT_texture_webp", [&] { json_.member("source", picture); });
  }

  void packed_view(const Layout::BufferView& v) {
    constexpr std::string_view filters[] = {"", "OCTAHEDRAL", "EXPONENTIAL"};
    const auto& type =
        v.column == none ? info(v.view) : info(View::part);  // columns that are packed have elements of four bytes
    const bool triangles = v.column == none && (v.view == View::index16 || v.view == View::index32);
    extension("EXT_meshopt_compression", [&] {
      json_.member("buffer", 0);
      if (v.offset > 0) json_.member("byteOffset", v.offset);
      json_.members("byteLength", v.length, "byteStride", type.element, "count", v.unpacked / type.element, "mode",
                    !type.indices ? "ATTRIBUTES"
                    : triangles   ? "TRIANGLES"
                                  : "INDICES");
      if (type.filter != Filter::none) json_.member("filter", filters[static_cast<std::size_t>(type.filter)]);
    });
  }
};

}  // namespace

void write_texture(JsonOut& json, const Parts& parts, std::size_t i) {
  BufferJson(json, parts).texture(parts.textures.textures()[i]);
}

void write_image(JsonOut& json, const Parts& parts, std::size_t i) { BufferJson(json, parts).image(i); }

void write_sampler(JsonOut& json, const Parts& parts, std::size_t i) {
  BufferJson(json, parts).sampler(parts.textures.samplers()[i]);
}

void write_accessor(JsonOut& json, const Parts& parts, std::size_t i) {
  BufferJson(json, parts).accessor(parts.packing.store().accessors()[i]);
}

void write_buffer_view(JsonOut& json, const Parts& parts, std::size_t i) {
  BufferJson(json, parts).buffer_view(parts.layout.views()[i]);
}

void write_buffer(JsonOut& json, const Parts& parts, std::size_t i) {
  BufferJson buffers(json, parts);
  if (i == 0)
    buffers.buffer();
  else
    buffers.unpacked_buffer();
}

}  // namespace wrlkit::gltf
