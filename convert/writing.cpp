#include "convert/writing.h"

#include <algorithm>
#include <functional>

#include "base/io/gzip.h"
#include "base/io/output.h"
#include "base/io/url.h"
#include "base/stop.h"
#include "convert/nothing_drawn.h"
#include "convert/output_urls.h"
#include "convert/repeated_meshes.h"
#include "scenegraph/nodes.h"
#include "scenegraph/urls.h"
#include "scenegraph/walk.h"
#include "writers/made_files.h"
#include "writers/named_files.h"
#include "writers/vrml/vrml.h"
#include "writers/x3d/x3d.h"

namespace wrlkit {
namespace {

using TextWriter = void (*)(const Scene&, const TextOptions&, const Sink&, Diagnostics&);

/// What readers of VRML take for VRML.
bool has_vrml_name(std::string_view url) {
  const auto name = url.substr(0, url.find('#'));
  const auto ending = ending_of(name, scene_endings());
  return ending.empty() || std::ranges::any_of(formats(), [&](const FileFormat& f) {
           return f.parsed == Format::vrml97 && !ending_of(name, endings_of(f)).empty();
         });
}

/// Inlines that browsers of VRML97 do not read.
void report_inlines(const Writing& w) {
  auto& resources = *w.context.resources;
  for_each_url_list(w.scene, UrlFields(w.scene), [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
    if (use != UrlUse::world || std::ranges::any_of(urls, has_vrml_name)) return;
    const bool found = std::ranges::any_of(urls, [&](std::string_view url) {
      return resources.target(url, where, *w.scene.sources).kind == UrlTarget::Kind::file;
    });
    if (found) w.context.diag.report(Diag::no_vrml97_inline, where, urls[0]);
  });
}

/// Calls f with a Sink whose bytes are packed on the way to another one, where that is wanted.
void write_packed(const Sink& to, bool gzip, auto&& f) {
  if (!gzip) return f(to);
  Gzip packer;
  const Gzip::Put put = [&](std::string_view packed) {
    to(packed);
    return 0;
  };
  f([&](std::string_view piece) { packer.pack(piece, false, put); });
  packer.pack({}, true, put);
}

/// The file from whose folder relative urls are to lead; empty: that of the input.
std::string urls_from(const Writing& w) { return w.sink || w.to.path == "-" || w.options.is_mirrored ? "" : w.to.path; }

bool write_text(const Writing& w, TextWriter write) {
  auto& diag = w.context.diag;
  TextOptions options{.precision = w.options.precision, .own_fields = w.options.dump};
  if (w.sink) {
    OutputUrls urls(w, true);
    options.copy = std::ref(urls);
    write_packed(*w.sink, w.to.gzip, [&](const Sink& sink) { write(w.scene, options, sink, diag); });
    return write_named_files(*w.context.resources, diag);
  }
  const auto& path = w.to.path;
  auto file = OutputFile::open(path,
                               {.gzip = w.to.gzip,
                                .inputs = &w.context.resources->files_read(),
                                .written = &w.context.resources->files_written(),
                                .report_replaced = w.options.is_derived},
                               diag);
  if (!file) return false;
  if (w.context.monitor) w.context.monitor->begin(path == "-" ? "" : "writing " + path, 0, "");
  if (path != "-" && !w.options.dump && w.to.format->parsed == Format::vrml97) report_inlines(w);
  MadeFiles made(w.scene, *w.context.resources, path, w.options.own_folder, diag);
  options.file = urls_from(w);
  options.place = [&](std::string_view url) { return made.place(url); };
  OutputUrls urls(w, true);
  options.copy = std::ref(urls);
  write(w.scene, options, file->sink(), diag);
  NamedFiles named(*w.context.resources, diag);
  const bool done = made.write() && named.write() && urls.write() && !w.context.stop.stop_requested() &&
                    made.commit() && named.commit() && file->commit(diag);
  if (done) urls.keep();
  return done;
}

/// In the order in which a writer meets them.
std::vector<NodeId> geometries_of(const Scene& scene) {
  auto out = reachable(scene, scene.main);
  std::erase_if(out, [&](NodeId n) { return !scene.is(n, nodes::X3DGeometryNode); });
  out.shrink_to_fit();
  return out;
}

}  // namespace

bool write_vrml_file(const Writing& w) { return write_text(w, write_vrml); }
bool write_x3d_file(const Writing& w) { return write_text(w, write_x3d); }

bool write_gltf_file(const Writing& w) {
  auto& ctx = w.context;
  const auto geometries = geometries_of(w.scene);
  if (ctx.monitor) ctx.monitor->begin("writing " + w.to.path, geometries.size(), "shapes");
  const auto step = [&] {
    check_stop();
    if (ctx.monitor) ctx.monitor->step();
  };
  auto options = gltf_options(w.options, w.to.format->endings != ".gltf");
  const auto asked_of = [&w, all = gltf::vertex_options(options)](NodeId n, bool textured) {
    auto asked = all;
    asked.texcoords = textured || gltf::gives_texcoords(w.scene, n);
    return asked;
  };
  const VertexMaker vertices = [&](NodeId n, const Mesh& mesh, bool textured, SplitScratch& scratch, Vertices& out) {
    gltf::make_vertices(mesh, asked_of(n, textured), scratch, out);
  };
  RepeatedMeshes repeated(w.scene, w.meshes, w.makers, vertices, geometries, ctx);
  DrawnMeshes drawn(w.scene, std::ref(repeated), ctx.diag);
  const MeshSource counted = [&](NodeId n) -> const Mesh& {
    step();
    return drawn(n);
  };
  options.vertices_ahead = [&](NodeId n, const gltf::VertexOptions& asked) -> Vertices* {
    return asked == asked_of(n, repeated.is_textured(n)) ? repeated.take_vertices(n) : nullptr;
  };
  options.same_mesh = [&](NodeId n) {
    const NodeId other = repeated.same_mesh(n);
    if (other) step();
    return other;
  };
  const StopScope scope(ctx.stop);
  try {
    NamedFiles named(*ctx.resources, ctx.diag);
    if (!named.write()) return false;
    OutputUrls urls(w, false);
    const PlaceMade stays;  // pictures are glTF's own matter
    const CopyOfUrl copy = std::ref(urls);
    const std::string from = urls_from(w);
    options.lead_urls = [&](Span where, std::span<const std::string_view> list, UrlUse use) {
      // The url of a picture that is part of the file only names it.
      return led_urls(w.scene, where, list, use, {use == UrlUse::texture ? "" : from, stays, copy});
    };
    if (w.sink) {
      const bool done = write_glb(w.scene, counted, options, ctx.resources, *w.sink, ctx.diag) && named.commit();
      drawn.report();
      return done;
    }
    MadeFiles beside(w.scene, *ctx.resources, w.to.path, w.options.own_folder, ctx.diag);
    const bool done =
        beside.write() && urls.write() &&
        write_gltf(w.scene, counted, options, ctx.resources, w.to.path, ctx.diag, &w.saved.gltf.emplace()) &&
        beside.commit() && named.commit();
    if (done) urls.keep();
    drawn.report();
    return done;
  } catch (const Stopped&) {
    return false;
  }
}

}  // namespace wrlkit
