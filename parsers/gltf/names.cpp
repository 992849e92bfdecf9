#include "parsers/gltf/names.h"

#include "parsers/gltf/part_rows.h"

namespace wrlkit {
namespace gltf_reader {
namespace {

/// JSON is not deeper than JsonDocument::max_depth.
void collect(Json value, std::set<std::string>& out) {
  for (Json v : value) {
    if (v.is_text() && (v.key() == "name" || v.key() == "DEF")) out.emplace(v.text());
    if (v.key() == "names")
      for (Json name : v.elements()) out.emplace(name.text());
    if (v.is_object() || v.is_array()) collect(v, out);
  }
}

}  // namespace
}  // namespace gltf_reader

std::set<std::string> names_in_gltf(std::string_view bytes, const std::string& path, Diagnostics& diag) {
  using namespace gltf_reader;
  std::set<std::string> out;
  File file(bytes, 0, diag);
  if (!file.read()) return out;
  collect(file.root(), out);
  Buffers buffers(file, path, {}, nullptr);
  Accessors accessors(file, buffers);
  Scene scene;
  Lost lost;
  PartRows parts(Context{file, buffers, accessors, scene, lost});
  for (const PartRow& row : parts.rows()) {
    out.insert(row.name);
    if (const auto number = row.name.rfind('#'); number != row.name.npos)
      out.insert(row.name.substr(0, number));  // "Bolt#2", of merge
  }
  out.erase("");
  return out;
}

}  // namespace wrlkit
