#include "parsers/gltf/names.h"

#include "parsers/gltf/part_rows.h"

namespace wrlkit {

std::set<std::string> names_in_gltf(std::string_view bytes, const std::string& path, Diagnostics& diag) {
  using namespace gltf_reader;
  std::set<std::string> out;
  File file(bytes, 0, diag);
  if (!file.read()) return out;
  collect_names(file.root(), out);
  Buffers buffers(file, path, {}, nullptr);
  Accessors accessors(file, buffers);
  Scene scene;
  Lost lost;
  LegalNames names(file);
  PartRows parts(Context{file, buffers, accessors, scene, lost, names});
  for (const PartRow& row : parts.rows()) {
    out.insert(row.name);
    if (const auto number = row.name.rfind('#'); number != row.name.npos)
      out.insert(row.name.substr(0, number));  // "Bolt#2", of merge
  }
  out.erase("");
  return out;
}

}  // namespace wrlkit
