// wrlkit check: what the parser and the node table have to say of scenes; nothing is written.
#include <fmt/format.h>
#include <unistd.h>

#include "base/text/json.h"
#include "convert/missing_files.h"
#include "convert/nothing_drawn.h"
#include "convert/nothing_shown.h"
#include "convert/startup_scripts.h"
#include "convert/world_meshes.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "tools/cli/documents.h"
#include "tools/cli/inputs.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/session.h"

namespace wrlkit {
namespace {

/// Pictures are decoded and geometry is cut into triangles, as for a conversion.
void check_contents(Session& s) {
  const auto n_dropped = DrawnMeshes::n_dropped(s.diag());
  const WorldMeshes meshes(s.document());
  if (!meshes.good()) return;
  const Scene& scene = s.world().scene;
  DrawnMeshes drawn(scene, meshes.triangles, s.diag(), n_dropped);
  std::vector<char> has_place(scene.node_count());
  for_each_place(scene, Shown::all, [&](NodeId shape, const Matrix&) {
    if (const NodeId geometry = scene.get(shape, nodes::shape::geometry)) has_place[geometry.value] = 1;
  });
  for (NodeId n : reachable(scene, scene.main)) {
    if (scene.is(n, nodes::X3DGeometryNode)) has_place[n.value] ? drawn(n) : meshes.triangles(n);
    if (scene.is(n, nodes::ImageTexture))
      s.resources().image(scene.get(n, nodes::image_texture::url), scene.where(n), s.diag());
  }
  drawn.report();
}

/// Inlines and prototypes are followed, so that what is missing there is reported.
void check_world(Session& s) {
  check_values(s.world().scene, s.diag());
  report_undrawn(s.world().scene, &s.resources(), s.diag());
  report_startup_scripts(s.world().scene, s.diag());
  report_missing_media(s.world().scene, s.resources(), s.diag());
  if (!s.flags().quick) return check_contents(s);
  std::string why;
  if (auto p = Pipeline::parse("lower-vrml1,expand", why)) p->run(s.world().scene, s.context());
}

void print_text(const std::string& path, const Diagnostics& d, bool quiet) {
  fmt::print("{}", messages_text(d, isatty(STDOUT_FILENO) != 0, quiet));
  fmt::print("{}: {}, {}\n", path, counted(d.count(Severity::error), "error"),
             counted(d.count(Severity::warning), "warning"));
}

std::string json_of(const std::string& path, const Diagnostics& d, bool readable) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("file", path, "readable", readable, "error", d.count(Severity::error), "warning",
                   d.count(Severity::warning));
      json.member("messages", JsonText{messages_json(d)});
    });
  });
}

}  // namespace

int run_check(const Flags& flags) {
  std::size_t unreadable = 0, faulty = 0;
  std::string why;
  std::vector<std::string> objects;
  const auto inputs = named_worlds(flags.inputs, why);
  if (!inputs) {
    complain("check", why);
    return nothing;
  }
  const int code = print_left_out("check", inputs->left_out, inputs->passed_over);
  for (const auto& [path, name] : inputs->worlds) {
    Flags one = flags;
    one.inputs = {path};
    Session s(one);
    if (!s.good()) return usage;
    bool readable = s.document().read(path);
    if (readable && !flags.parse_only) check_world(s);
    s.progress().clear();
    unreadable += !readable;
    faulty += s.diag().has_errors();
    if (flags.json || !flags.report.empty()) objects.push_back(json_of(path, s.diag(), readable));
    if (!flags.json && (!flags.quiet || s.diag().has_errors())) print_text(path, s.diag(), flags.quiet);
  }
  if (!give_document(flags, json_of_scenes(*inputs, objects))) return nothing;
  return unreadable == inputs->worlds.size() ? nothing : faulty ? partly : code;
}

}  // namespace wrlkit
