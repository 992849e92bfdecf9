#include "tools/verbs/view_gallery.h"
#include "tools/cli/documents.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/image/image.h"
#include "base/io/files_read.h"
#include "base/io/output.h"
#include "base/io/uri.h"
#include "base/text/base64.h"
#include "base/text/json.h"
#include "convert/info.h"
#include "tools/cli/inputs.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/session.h"
#include "tools/report/gallery_page.h"
#include "tools/verbs/render_sheets.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr int width = 320, height = 240, quality = 80;

/// A reference from the page to a file.
std::string link_to(const std::string& path, const std::string& page) {
  std::error_code fault;
  const auto folder = page == "-" ? fs::current_path(fault) : fs::absolute(page, fault).parent_path();
  const auto relative = fs::relative(path, folder, fault);
  std::string out;
  for (const auto& part : relative) out += (out.empty() ? "" : "/") + uri_of(part.string());
  return out;
}

/// Flags to look at one of the scenes with.
Flags flags_for(const Flags& flags, const std::string& path) {
  Flags f = flags;
  f.quiet = true;
  f.inputs = {path};
  f.output.clear();
  f.report.clear();
  return f;
}

std::string first_error(const Diagnostics& diag) {
  for (const auto& m : diag.messages())
    if (m.severity == Severity::error) return m.text();
  return "nothing could be made of it";
}

/// Of two readings of one scene the one that says more counts.
void add_messages(const Diagnostics& diag, GalleryWorld& out) {
  out.errors = std::max<std::uint64_t>(out.errors, diag.count(Severity::error));
  out.warnings = std::max<std::uint64_t>(out.warnings, diag.count(Severity::warning));
  out.lost = std::max<std::uint64_t>(out.lost, diag.count(Severity::lost));
  for (const auto& m : diag.messages())
    if (m.severity != Severity::note) out.messages.emplace(info(m.id).name);
}

void add_figures(const Flags& flags, GalleryWorld& out) {
  Session s(flags);
  if (!s.document().read(flags.inputs[0])) return;
  const auto facts = info(std::move(s.document()));
  add_messages(s.diag(), out);
  if (!facts) return;
  out.triangles = facts->geometry.triangles;
  out.parts = facts->geometry.shapes;
}

void add_picture(const Flags& flags, GalleryWorld& out) {
  Session s(flags);
  const auto meshes = s.choose_pipeline("picture") ? open_world(s, flags.inputs[0]) : MeshSource();
  std::string why;
  if (meshes) {
    const RenderOptions options{.width = width, .height = height, .samples = 2};
    const auto picture = render(s.world().scene, meshes, options, &s.resources(), s.diag());
    if (const auto bytes = encode_jpeg(picture, quality, why))
      out.picture = base64(*bytes);
    else
      out.no_picture = why;
  } else {
    out.fault = first_error(s.diag());
  }
  add_messages(s.diag(), out);
}

GalleryWorld look_at(const Flags& flags, const NamedWorld& world) {
  const Flags f = flags_for(flags, world.path);
  std::error_code fault;
  const auto bytes = fs::file_size(world.path, fault);
  GalleryWorld out{.name = world.name, .link = link_to(world.path, flags.output), .bytes = fault ? 0 : bytes};
  add_picture(f, out);
  if (out.fault.empty()) add_figures(f, out);
  return out;
}

/// The keys are stable.
std::string contents_json(const Gallery& g, const std::string& file, std::size_t bytes) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("file", file, "bytes", bytes);
      json.list("worlds", g.worlds, [&](const auto& w) {
        json.object("name", w.name, "drawn", !w.picture.empty(), "triangles", w.triangles, "errors", w.errors,
                    "warnings", w.warnings, "lost", w.lost, "messages",
                    std::vector<std::string>(w.messages.begin(), w.messages.end()));
      });
      json.member("left_out", g.n_left_out);
    });
  });
}

bool has_place(const Flags& f) {
  if (f.output.empty() || f.serve) {
    fmt::print(stderr, "wrlkit view: a gallery is a file: name it with -o FILE, without --serve\n");
    return false;
  }
  return true;
}

Gallery gallery_of(Session& s, const std::vector<NamedWorld>& worlds) {
  const Flags& flags = s.flags();
  const auto n = std::min(worlds.size(), static_cast<std::size_t>(flags.limit));
  Gallery out{.title = flags.inputs.size() == 1 ? flags.inputs[0] : fmt::format("{} worlds", worlds.size()),
              .width = width,
              .height = height,
              .n_left_out = worlds.size() - n};
  s.progress().begin("worlds", n, "");
  for (std::size_t i = 0; i < n; ++i) {
    out.worlds.push_back(look_at(flags, worlds[i]));
    s.progress().set(i + 1);
  }
  s.progress().clear();
  return out;
}

/// The first whose picture could not be stored, as where the codecs are not installed.
std::vector<GalleryWorld>::const_iterator without_picture(const Gallery& g) {
  return std::ranges::find_if(g.worlds, [](const GalleryWorld& w) { return !w.no_picture.empty(); });
}

/// What the page says, too.
void print_faults(const Gallery& g) {
  for (const auto& w : g.worlds)
    if (!w.fault.empty()) fmt::print(stderr, "wrlkit view: {}: {}\n", w.name, w.fault);
  const auto with_errors =
      std::ranges::count_if(g.worlds, [](const GalleryWorld& w) { return w.fault.empty() && w.errors > 0; });
  if (with_errors > 0)
    fmt::print(stderr, "wrlkit view: {} with errors, marked in the page; wrlkit check lists them\n",
               counted(static_cast<std::size_t>(with_errors), "scene"));
  if (const auto blank = without_picture(g); blank != g.worlds.end())
    fmt::print(stderr, "wrlkit view: there are no pictures: {}\n", blank->no_picture);
  if (g.n_left_out > 0)
    fmt::print(stderr, "wrlkit view: {} more worlds are left out; --limit {} takes them all\n", g.n_left_out,
               g.n_left_out + g.worlds.size());
}

int exit_code_of(const Gallery& g) {
  const auto faults = std::ranges::count_if(g.worlds, [](const GalleryWorld& w) { return !w.fault.empty(); });
  if (faults == std::ssize(g.worlds)) return nothing;
  const bool wrong = std::ranges::any_of(g.worlds, [](const GalleryWorld& w) { return w.errors > 0; });
  return wrong || g.n_left_out > 0 || without_picture(g) != g.worlds.end() ? partly : done;
}

}  // namespace

bool is_gallery(const Flags& f) { return f.inputs.size() > 2 || std::ranges::any_of(f.inputs, means_many); }

int view_gallery(const Flags& flags) {
  Session s(flags);
  if (!has_place(flags) || !s.good() || !s.choose_pipeline("picture")) return usage;
  std::string why;
  const auto named = named_worlds(flags.inputs, why);
  if (!named) {
    complain("view", why);
    return nothing;
  }
  const int left_out = print_left_out("view", named->left_out, named->passed_over);
  FilesRead inputs;
  for (const auto& world : named->worlds) inputs.add(world.path);
  const Gallery gallery = gallery_of(s, named->worlds);
  const std::string page = gallery_page(gallery);
  auto file = OutputFile::open(flags.output, {.inputs = &inputs}, s.diag());
  if (file) file->write(page);
  const bool made = file && file->commit(s.diag());
  const auto contents = contents_json(gallery, flags.output, page.size());
  if (made && flags.json) s.print_json(contents);
  s.fact("page", contents);
  print_faults(gallery);
  return s.end(made, nothing, std::max(exit_code_of(gallery), left_out));
}

}  // namespace wrlkit
