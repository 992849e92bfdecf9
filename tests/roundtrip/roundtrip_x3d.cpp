// VRML97 through X3D and back, and X3D through its own writer: the text in the end is the text in the beginning.
// Differences that docs/conformance.md explains are recognised by what the world has; any other fails.
//
//   roundtrip_x3d FOLDER...    --found: the corpus of the folder WRLKIT_SHARED, or of ../shared. Ends with 77 where a
//                              folder is not there
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/text/xml_text.h"
#include "parsers/parsers.h"
#include "passes/lower_x3d/lower_x3d.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tests/roundtrip/worlds.h"
#include "writers/vrml/vrml.h"
#include "writers/x3d/x3d.h"

using namespace wrlkit;

namespace {

std::string vrml_text(Scene scene) {
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  lower_x3d(scene, {.vrml97 = true}, ctx);
  std::string text;
  write_vrml(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

std::string x3d_text(const Scene& scene) {
  Diagnostics diag;
  std::string text;
  write_x3d(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

std::string line_at(std::string_view text, std::size_t at) {
  auto begin = at ? text.rfind('\n', at - 1) : text.npos;
  begin = begin == text.npos ? 0 : begin + 1;
  return std::string(text.substr(begin, std::min<std::size_t>(text.find('\n', at) - begin, 120)));
}

/// Where two texts differ; empty: nowhere.
std::string difference_of(std::string_view a, std::string_view b) {
  if (a == b) return {};
  auto at = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
  auto line = std::ranges::count(a.substr(0, at), '\n') + 1;
  return "line " + std::to_string(line) + ": '" + line_at(a, at) + "' and '" + line_at(b, std::min(at, b.size())) + "'";
}

bool odd_text(std::string_view s) {
  return std::ranges::any_of(
      s, [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t' && c != '\r'; });
}

/// What XML cannot hold or tells otherwise: see "VRML97 as X3D" in docs/conformance.md.
bool has_what_xml_has_not(const Scene& scene) {
  if (scene.comment.find("--") != std::string::npos) return true;
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i)
    for (auto& f : scene.type(scene.proto(ProtoId{i}).type).fields)
      if (f.default_value.type == FieldType::verbatim || odd_text(f.name)) return true;
  for (NodeId n : all_nodes(scene)) {
    const auto& t = scene.type(n);
    if (t.kind == NodeKind::unknown || t.is_a(nodes::Vrml1Node)) return true;
    if (!scene.name(n).empty() && !is_legal_name(scene.name(n))) return true;  // becomes one that VRML97 allows
    for (const Value& v : scene.fields(n)) {
      if (scene.is_extra(v) && !v.extra->value.is) return true;
      const auto& c = scene.content(v);
      if (c.is) continue;
      if (t.kind == NodeKind::proto && info(c.type).element == Element::node && c.node_span().empty()) return true;
      if (info(c.type).element == Element::text && !info(c.type).multiple && odd_text(c.text())) return true;
      if (info(c.type).element == Element::text && info(c.type).multiple &&
          std::ranges::any_of(c.text_span(), odd_text))
        return true;
    }
  }
  return false;
}

struct Count {
  int vrml = 0, x3d = 0, explained = 0, faulty = 0;
};

void report(const std::string& path, const std::string& fault, bool explained, Count& count) {
  if (fault.empty()) return;
  if (explained) {
    ++count.explained;
    std::printf("known: %s: %s\n", path.c_str(), fault.c_str());
    return;
  }
  ++count.faulty;
  std::printf("%s: %s\n", path.c_str(), fault.c_str());
}

void check_file(const std::string& path, Count& count) {
  Diagnostics diag, again_diag;
  auto world = read_world(path, {}, diag);
  if (!world || world->scene.main.roots.empty()) return;
  if (world->format == Format::vrml1 || world->format == Format::gltf) return;
  const auto x3d = x3d_text(world->scene);
  auto again = parse_world(x3d, "again", {}, again_diag);
  if (!again) return report(path, "what was written is not read", false, count);
  const bool vrml = world->format == Format::vrml97;
  ++(vrml ? count.vrml : count.x3d);
  const bool explained = has_what_xml_has_not(world->scene);
  if (vrml)
    report(path, difference_of(vrml_text(world->scene), vrml_text(again->scene)), explained, count);
  else
    report(path, difference_of(x3d, x3d_text(again->scene)), explained, count);
}

}  // namespace

int main(int argc, char** argv) {
  const auto folders = folders_of(argc, argv);
  if (folders.empty()) return skipped;
  Count count;
  for (const auto& folder : folders)
    for (const auto& f : files_below(folder)) check_file(f, count);
  std::printf("%d worlds of VRML97 and %d of X3D, %d come back otherwise for a known reason, %d for none\n", count.vrml,
              count.x3d, count.explained, count.faulty);
  return count.vrml + count.x3d == 0 || count.faulty ? 1 : 0;
}
