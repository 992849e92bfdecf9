#include "parsers/gltf/legal_names.h"

#include "scenegraph/legal_name.h"

namespace wrlkit::gltf_reader {

std::string LegalNames::of(std::string_view name) {
  if (file_.is_made_here() ? is_read_as_name(name) : is_legal_name(name)) return std::string(name);
  auto [at, is_new] = given_.try_emplace(std::string(name));
  if (is_new) at->second = fresh(name);
  return at->second;
}

std::string LegalNames::fresh(std::string_view name) {
  if (taken_.empty()) collect_names(file_.root(), taken_);
  const std::string legal = legal_name(name);
  std::string out = legal;
  for (int k = 2; !taken_.insert(out).second; ++k) out = legal + "_" + std::to_string(k);
  return out;
}

/// JSON is not deeper than JsonDocument::max_depth.
void collect_names(Json value, std::set<std::string>& out) {
  for (Json v : value) {
    if (v.is_text() && (v.key() == "name" || v.key() == "DEF")) out.emplace(v.text());
    if (v.key() == "names")
      for (Json name : v.elements()) out.emplace(name.text());
    if (v.is_object() || v.is_array()) collect_names(v, out);
  }
}

}  // namespace wrlkit::gltf_reader
