// wrlkit view: a page that shows a scene, or two side by side. The scenes go into it as glTF, with everything that
// glTF cannot say in extras; what a simplification does goes into it as progressive meshes.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>

#include "base/io/output.h"
#include "base/io/url.h"
#include "base/text/json.h"
#include "convert/missing_files.h"
#include "convert/nothing_drawn.h"
#include "convert/placing.h"
#include "convert/shown_surface.h"
#include "geometry/progressive/progressive_world.h"
#include "passes/startup/script_text.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tools/cli/session.h"
#include "tools/report/deviation_map.h"
#include "tools/verbs/serve.h"
#include "tools/verbs/view_gallery.h"
#include "tools/verbs/view_tileset.h"
#include "tools/verbs/viewer_page.h"
#include "writers/gltf/gltf.h"

namespace wrlkit {
namespace {

/// Surfaces without loose faces, as `simplify --progressive` makes them.
constexpr std::string_view surfaces_pipeline = "lower-vrml1,expand,lower-x3d{vrml97=true},weld";
/// Baked light stays apart from the colours, so that each can be looked at alone.
constexpr std::string_view world_pipeline = "gltf-light";

std::vector<std::string> usual_criteria() { return {"length-normal", "melax", "lindstrom-turk"}; }
constexpr std::size_t usual_most_triangles = 300'000;  // of the usual criteria: seconds, and a few megabytes each

/// The media type of a sound that browsers play, by its first bytes; empty: none.
std::string_view sound_type(std::string_view bytes) {
  constexpr std::pair<std::string_view, std::string_view> types[] = {
      {"RIFF", "audio/wav"},      {"OggS", "audio/ogg"},      {"ID3", "audio/mpeg"},
      {"\xff\xfb", "audio/mpeg"}, {"\xff\xf3", "audio/mpeg"}, {"fLaC", "audio/flac"}};
  for (const auto& [first, type] : types)
    if (bytes.starts_with(first)) return type;
  return {};
}

/// A Sound whose file is part of the page.
bool is_played(const Scene& scene, NodeId sound) {
  if (!scene.is(sound, nodes::Sound)) return false;
  const NodeId clip = scene.get(sound, nodes::sound::source);
  if (!scene.is(clip, nodes::AudioClip)) return false;
  const auto urls = scene.get(clip, nodes::audio_clip::url);
  return !urls.empty() && urls[0].starts_with("data:audio/");
}

class Viewer {
 public:
  explicit Viewer(Session& s) : s_(s) {}

  /// False when a scene cannot be read.
  bool fill() {
    for (const auto& input : s_.flags().inputs)
      if (!s_.read(input) || !add_world(input)) return false;
    if (surfaces_.size() == 2) compare();
    return true;
  }
  ViewerPage& page() { return page_; }

 private:
  bool add_world(const std::string& input) {
    const Scene authored = s_.world().scene;
    auto& world = page_.worlds.emplace_back();
    world.name = std::filesystem::path(input).filename().string();
    Scene& scene = s_.world().scene;
    const auto n_dropped = DrawnMeshes::n_dropped(s_.diag());
    const auto meshes = s_.pipeline().run_lazily(scene, s_.context(), s_.pipeline_options());
    if (!meshes) return false;
    std::size_t n_triangles = 0;
    const bool compared = s_.flags().inputs.size() == 2;
    if (compared) surfaces_.push_back(std::make_unique<ShownSurface>(scene, s_.diag()));
    DrawnMeshes drawn(scene, meshes, s_.diag(), n_dropped);
    auto counted = [&](NodeId n) -> const Mesh& {
      const Mesh& mesh = drawn(n);
      n_triangles += mesh.is_triangles() ? mesh.n_faces() : 0;
      if (compared) surfaces_.back()->add(n, mesh);
      return mesh;
    };
    take_scripts(scene);
    take_sounds(scene);
    const GltfOptions options{.lightmaps = GltfOptions::Lightmaps::extras,
                              .says_origin = false,
                              .animation_pointer = true,
                              .behaviour = GltfOptions::Behaviour::interactivity,
                              .is_understood = [&scene](NodeId n) { return is_played(scene, n); }};
    auto take = [&](std::string_view bytes) { world.glb += bytes; };
    if (!write_glb(scene, counted, options, &s_.resources(), take, s_.diag())) return false;
    drawn.report();
    const bool usual = s_.flags().criteria.empty();
    if (!usual || (!compared && n_triangles <= usual_most_triangles))
      for (const auto& criterion : usual ? usual_criteria() : s_.flags().criteria) add_collapse(authored, criterion);
    return true;
  }

  /// Programs in files become parts of the page, which reads no files.
  void take_scripts(Scene& scene) {
    constexpr std::size_t longest = 1'000'000;
    for (const NodeId n : all_nodes(scene)) {
      if (!is_script_in_file(scene, n)) continue;
      const auto text = script_text(scene, n, &s_.resources(), s_.diag());
      if (!text) continue;
      if (text->size() > longest) {
        s_.diag().report(Diag::too_large, scene.where(n), "the program of a Script", "1 MB", text->size());
        continue;
      }
      const std::string url = "javascript:" + *text;
      scene.set(n, nodes::script::url, std::vector<std::string_view>{url});
    }
  }

  /// So do sounds, where browsers can play them.
  void take_sounds(Scene& scene) {
    constexpr std::size_t largest = 4 << 20;
    report_missing_media(scene, s_.resources(), s_.diag());
    for (const NodeId n : all_nodes(scene)) {
      if (!scene.is(n, nodes::AudioClip) || scene.value(n, nodes::audio_clip::url.slot).is) continue;
      const auto file = file_of(scene, n, scene.get(n, nodes::audio_clip::url));
      if (!file) continue;
      const auto type = sound_type(file->bytes);
      if (type.empty()) {
        s_.diag().report(Diag::sound_not_played, scene.where(n), file->name);
        continue;
      }
      if (file->bytes.size() > largest) {
        s_.diag().report(Diag::too_large, scene.where(n), "the sound of an AudioClip", "4 MB", file->bytes.size());
        continue;
      }
      const std::string url = data_url(type, file->bytes);
      scene.set(n, nodes::audio_clip::url, std::vector<std::string_view>{url});
    }
  }

  /// The first of the urls that is there; null, unreported, when none is.
  std::shared_ptr<const Blob> file_of(const Scene& scene, NodeId n, std::span<const std::string_view> urls) {
    for (const std::string_view url : urls) {
      const auto kind = s_.resources().target(url, scene.where(n), *scene.sources).kind;
      const std::array one{url};
      if (kind == UrlTarget::Kind::file) return s_.resources().bytes(one, scene.where(n), s_.diag());
    }
    return nullptr;
  }

  void add_collapse(Scene scene, const std::string& name) {
    CriterionName criterion;
    criterion.read(name);
    if (!info(criterion.value).keeps_record || page_.worlds.size() > 1) return;
    s_.progress().begin("collapsing by " + name, 0, "");
    Diagnostics unheard(s_.diag().shared_sources());
    PassContext silent{unheard, s_.context().stats, &s_.resources()};
    std::string why;
    place_world(scene, s_.flags().load.unit, s_.flags().load.up);
    if (!Pipeline::parse(surfaces_pipeline, why)->run(scene, silent)) return;
    const auto surfaces = progressive_surfaces(scene, criterion.value, silent);
    if (!surfaces.empty()) page_.collapses.push_back({name, write_progressive_world(surfaces)});
  }

  /// Nothing is measured when there is no surface in one of them, or too much.
  void compare() {
    const auto &a = *surfaces_[0], &b = *surfaces_[1];
    if (!a.complete() || !b.complete() || a.triangles().size() == 0 || b.triangles().size() == 0) return;
    s_.progress().begin("comparing", 0, "");
    page_.apart =
        ViewerPage::Apart{measure_deviation(a.triangles(), b.triangles()),
                          {deviation_map(a.triangles(), b.triangles()), deviation_map(b.triangles(), a.triangles())}};
  }

  Session& s_;
  ViewerPage page_;
  std::vector<std::unique_ptr<ShownSurface>> surfaces_;  // when two are compared
};

bool can_be_shown(const Flags& f) {
  if (f.output.empty() && !f.serve) {
    fmt::print(stderr, "wrlkit view: -o FILE or --serve is needed\n");
    return false;
  }
  for (const auto& name : f.criteria)
    if (CriterionName criterion; criterion.read(name) && !info(criterion.value).keeps_record) {
      fmt::print(stderr, "wrlkit view: --criteria: {} keeps no record of its steps\n", name);
      return false;
    }
  return true;
}

void warn_of_idle_options(const Flags& flags, bool is_tileset) {
  const bool has_many = !is_tileset && is_gallery(flags);
  const auto warn = [&](const char* option, const char* where) {
    if (flags.is_given(option) && !flags.quiet)
      fmt::print(stderr, "wrlkit view: --{} has no effect on {}\n", option, where);
  };
  if (!has_many) warn("limit", is_tileset ? "a tileset" : "the page of a scene");
  if (has_many || is_tileset) warn("criteria", is_tileset ? "a tileset" : "a gallery");
}

/// What went into a page; the keys are stable.
std::string contents_json(const ViewerPage& page, const std::string& file, std::size_t bytes) {
  std::string text;
  JsonOut json(text);
  json.begin_object();
  json.members("file", file, "bytes", bytes);
  json.list("worlds", page.worlds, [&](const auto& world) { json.value(world.name); });
  json.list("criteria", page.collapses, [&](const auto& collapse) { json.value(collapse.criterion); });
  json.member("deviation", page.apart ? page.apart->deviation.max : HUGE_VAL);
  json.end_object();
  return text;
}

bool write_page(Session& s, const ViewerPage& page) {
  auto file = OutputFile::open(s.flags().output, {.inputs = s.files_read()}, s.diag());
  if (!file) return false;
  std::size_t n_bytes = 0;
  write_viewer_page(page, [&](std::string_view bytes) {
    n_bytes += bytes.size();
    file->write(bytes);
  });
  if (!file->commit(s.diag())) return false;
  const auto contents = contents_json(page, s.flags().output, n_bytes);
  s.progress().clear();
  if (s.flags().json) s.print_json(contents);
  s.fact("page", contents);
  return true;
}

/// The page that --serve shows. When a file of the scenes has changed it is made again; as long as that fails the last
/// one is shown.
class LivePage {
 public:
  LivePage(const Flags& flags, const ViewerPage& first) : flags_(flags), times_(times()), html_(text_of(first)) {}

  std::shared_ptr<const std::string> get() {
    const std::lock_guard lock(one_);
    if (auto now = times(); now != times_) {
      times_ = std::move(now);
      Session s(flags_);
      Viewer viewer(s);
      const bool made = s.good() && s.choose_pipeline(world_pipeline) && viewer.fill();
      s.end(made);
      if (made) html_ = text_of(viewer.page());
    }
    return html_;
  }

 private:
  std::vector<std::filesystem::file_time_type> times() const {
    std::vector<std::filesystem::file_time_type> out;
    std::error_code ec;
    for (const auto& input : flags_.inputs)
      if (input != "-") out.push_back(std::filesystem::last_write_time(input, ec));
    return out;
  }

  static std::shared_ptr<const std::string> text_of(const ViewerPage& page) {
    auto html = std::make_shared<std::string>();
    write_viewer_page(page, [&](std::string_view bytes) { *html += bytes; });
    return html;
  }

  const Flags& flags_;
  std::mutex one_;
  std::vector<std::filesystem::file_time_type> times_;
  std::shared_ptr<const std::string> html_;
};

}  // namespace

int run_view(const Flags& flags) {
  const auto tileset = tileset_folder(flags.inputs);
  warn_of_idle_options(flags, !tileset.empty());
  if (tileset.empty() && is_gallery(flags)) return view_gallery(flags);
  Session s(flags);
  if (!can_be_shown(flags) || !s.good() || !s.choose_pipeline(world_pipeline)) return usage;
  if (s.printed_pipeline()) return done;
  if (!has_viewer()) {
    fmt::print(stderr,
               "wrlkit view: the page was not built into this program: that needs Node.js and npm packages "
               "(script/bootstrap)\n");
    return nothing;
  }
  if (!tileset.empty()) return view_tileset(s, tileset);
  Viewer viewer(s);
  if (!viewer.fill()) return s.end(false);
  if (!flags.output.empty() && !write_page(s, viewer.page())) return s.end(false);
  const int code = s.end(true);
  if (!flags.serve) return code;
  LivePage live(flags, viewer.page());
  const auto site = [&](std::string_view address) {
    return address == "/" ? std::optional(Served{html_type, live.get()}) : std::nullopt;
  };
  fmt::print(stderr, "wrlkit view: --serve: {}\n", serve_site(site));
  return nothing;
}

}  // namespace wrlkit
