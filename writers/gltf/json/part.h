// What the writers of the lists of a file's JSON share.
#pragma once
#include "base/text/json.h"
#include "writers/gltf/json/json.h"

namespace wrlkit::gltf {

class JsonPart {
 public:
  JsonPart(JsonOut& json, const Parts& parts) : json_(json), p_(parts), d_(parts.document) {}

 protected:
  /// A member that is a list; glTF allows no empty ones.
  void list(std::string_view name, std::size_t n, const auto& element) {
    if (n == 0) return;
    json_.key(name);
    json_.begin_array();
    for (std::size_t i = 0; i < n; ++i) element(i);
    json_.end_array();
  }
  /// The member extensions with one extension in it.
  void extension(std::string_view name, const auto& members) {
    json_.object("extensions", [&] { json_.object(name, members); });
  }
  std::string_view name_of(NodeId n) const { return p_.extras ? p_.extras->name(n) : p_.scene.name(n); }

  JsonOut& json_;
  const Parts& p_;
  const Document& d_;
};

}  // namespace wrlkit::gltf
