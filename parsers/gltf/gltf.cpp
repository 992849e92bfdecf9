#include "parsers/gltf/gltf.h"

#include <algorithm>

#include "base/text/blanks.h"
#include "parsers/gltf/animations.h"
#include "scenegraph/gltf_extensions.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

void check_required(File& file) {
  for (Json e : file.root()["extensionsRequired"].elements())
    if (!knows_gltf_extension(e.text())) file.diag().report(Diag::gltf_extension, file.where(e), e.text());
}

/// What is said of nodes that are rows of the table of parts: {row: 7, Transform: {metadata: ...}}.
void tag_parts(Json list, PartRows& rows, Extras& extras) {
  for (Json part : list.elements()) {
    const auto row = part["row"].whole();
    if (!row || *row >= rows.rows().size()) continue;
    const NodeId made = rows.made(static_cast<std::uint32_t>(*row));
    for (Json said : part)
      if (made && said.is_object()) extras.tags(made, said);
  }
}

/// Title and what is kept as text.
void add_world_info(const Context& c) {
  const File& file = c.file;
  auto shown = file.root()["scene"].whole().value_or(0);
  const auto title = file.at(Table::scenes, shown)["name"].text();
  if (title.empty() && c.lost.kept().empty()) return;
  NodeId n = c.add(nodes::WorldInfo, file.root()["asset"]);
  if (!title.empty()) c.scene.set(n, nodes::world_info::title, title);
  std::vector<std::string_view> lines(c.lost.kept().begin(), c.lost.kept().end());
  if (!lines.empty()) c.scene.set(n, nodes::world_info::info, lines);
  c.scene.main.roots.insert(c.scene.main.roots.begin(), n);
}

/// Of comment lines, each with its '#': anything else would be read as nodes where they are written.
std::string comment_lines(std::string_view kept) {
  std::string out;
  while (!kept.empty()) {
    const auto end = std::min(kept.find_first_of("\r\n"), kept.size());
    const auto line = kept.substr(0, end);
    if (!line.empty() && !line.starts_with('#')) out += "# ";
    (out += line) += '\n';
    kept.remove_prefix(std::min(end + 1, kept.size()));
  }
  return out;
}

}  // namespace

bool looks_like_gltf(std::string_view bytes) {
  if (is_glb(bytes)) return true;
  auto s = trim(bytes.substr(0, 1 << 16));
  return s.starts_with('{') && (s.find("\"asset\"") != s.npos || s.find("\"scenes\"") != s.npos ||
                                s.find("\"nodes\"") != s.npos || s.find("\"accessors\"") != s.npos);
}

void parse(std::string_view bytes, std::uint32_t base, const std::string& path, const std::vector<std::string>& allowed,
           std::vector<FileLookup>* lookups, const ParseLimits& limits, Scene& scene, Diagnostics& diag) {
  File file(bytes, base, diag);
  if (!file.read()) return;
  check_required(file);
  Buffers buffers(file, path, allowed, lookups);
  Accessors accessors(file, buffers);
  Lost lost;
  LegalNames names(file);
  Context context{file, buffers, accessors, scene, lost, names};
  Extras extras(context);
  PartRows rows(context);
  Meshes meshes(context, extras, rows);
  Hierarchy hierarchy(context, extras, meshes, rows, limits,
                      file.is_whole() ? std::set<std::uint32_t>() : moved_nodes(file));
  const Json kept = vrml97(file.at(Table::scenes, file.root()["scene"].whole().value_or(0)));
  scene.comment = comment_lines(vrml97(file.root()["asset"])["comment"].text());
  for (Json meta : vrml97(file.root()["asset"])["meta"].elements())
    if (const auto pair = meta.elements(); pair.size() == 2)
      scene.x3d.meta.emplace_back(pair[0].text(), pair[1].text());
  extras.protos(kept["protos"]);
  hierarchy.build();
  tag_parts(kept["parts"], rows, extras);
  extras.finish(kept);
  if (!file.is_own()) Animations(context, hierarchy, meshes, extras).build();  // wrlkit's own are there as ROUTEs
  if (!file.is_own()) {
    lost.keep(file, file.root());
    lost.keep(file, file.root()["asset"]);
    add_world_info(context);
  }
  buffers.look_for_unread();
  lost.report(diag);
}

}  // namespace wrlkit::gltf_reader
