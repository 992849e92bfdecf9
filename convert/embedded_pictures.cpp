#include "convert/embedded_pictures.h"

#include <map>

#include "base/image/image.h"
#include "base/io/url.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

/// ".png" of "image/png".
std::string ending(std::string_view bytes) {
  const auto mime = sniff_mime(bytes);
  return mime.empty() ? "" : mime == "image/jpeg" ? ".jpg" : "." + std::string(mime.substr(mime.rfind('/') + 1));
}

}  // namespace

void unpack_pictures(Scene& scene, Resources& resources) {
  std::map<std::string, std::string, std::less<>> made;  // by what they were
  for (std::uint32_t i = 0; i < scene.node_count(); ++i) {
    const NodeId n{i};
    if (!scene.is(n, nodes::ImageTexture)) continue;
    std::vector<std::string_view> urls;
    bool changed = false;
    for (auto url : scene.get(n, nodes::image_texture::url)) {
      urls.push_back(url);
      if (url_kind(url) != UrlKind::data) continue;
      auto known = made.find(url);
      if (known == made.end()) {
        auto bytes = decode_data_url(url);
        if (!bytes) continue;
        const std::string name = "picture_" + std::to_string(made.size()) + ending(*bytes);
        known =
            made.emplace(url, resources.add_made({name, std::make_shared<const std::string>(std::move(*bytes))})).first;
      }
      urls.back() = scene.keep(known->second);
      changed = true;
    }
    if (changed) scene.set(n, nodes::image_texture::url, urls);
  }
}

}  // namespace wrlkit
