// wrlkit render: a picture of a scene; of a scene from all sides; of two scenes and how they differ; of many scenes.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/image/image_animation.h"
#include "base/io/output.h"
#include "base/text/json.h"
#include "base/text/letter_case.h"
#include "convert/nothing_drawn.h"
#include "tools/verbs/render_sheets.h"

namespace wrlkit {

MeshSource open_world(Session& s, const std::string& input) {
  if (!s.read(input)) return {};
  return s.pipeline().run_lazily(s.world().scene, s.context(), s.pipeline_options());
}

Image draw(Session& s, const MeshSource& meshes, RenderOptions options, std::string name, Diagnostics* diag) {
  const bool path = options.mode == RenderOptions::Mode::path;
  const auto pixels = static_cast<double>(options.width) * options.height;
  s.progress().begin(std::move(name), path ? static_cast<std::uint64_t>(pixels) : 0, path ? "pixels" : "");
  if (path) options.done = [&](double share) { s.progress().set(static_cast<std::uint64_t>(share * pixels)); };
  Diagnostics& heard = diag ? *diag : s.diag();
  DrawnMeshes drawn(s.world().scene, meshes, heard, DrawnMeshes::n_dropped(heard));
  Image out = render(s.world().scene, std::ref(drawn), options, &s.resources(), heard);
  drawn.report();
  return out;
}

namespace {

/// `is_derived`: nobody has chosen the name.
bool write_bytes(Session& s, std::string_view bytes, const std::string& name, bool is_derived = false) {
  auto file = OutputFile::open(name, {.inputs = s.files_read(), .report_replaced = is_derived}, s.diag());
  if (!file) return false;
  file->write(bytes);
  return file->commit(s.diag());
}

}  // namespace

bool write_picture(Session& s, const Image& picture, const std::string& name, bool is_derived) {
  std::string why;
  auto bytes = encode_as(name == "-" ? ".png" : name, picture, why);
  if (!bytes) {
    s.diag().report(Diag::cannot_write, {}, name, why);
    return false;
  }
  return write_bytes(s, *bytes, name, is_derived);
}

namespace {

/// --viewpoint names one of the world that is open; otherwise what it may have meant is reported.
bool has_viewpoint(Session& s, const MeshSource& meshes) {
  if (s.flags().viewpoint.empty()) return true;
  const auto options = render_options(s.flags());
  Diagnostics unheard(s.diag().shared_sources());
  with_camera(s.world().scene, meshes, options, unheard);
  if (unheard.count(Diag::viewpoint_not_found) == 0) return true;
  with_camera(s.world().scene, meshes, options, s.diag());
  return s.diag().count(Diag::viewpoint_not_found) == 0;  // -Wno-viewpoint-not-found: the first one will do
}

/// With --json: what was drawn, and the files.
void print_pictures(Session& s, const std::vector<std::string>& pictures) {
  const Flags& f = s.flags();
  if (f.json)
    s.print_json(json_of(json_object("input", f.inputs[0], "pictures", std::span<const std::string>(pictures), "width",
                                     f.width, "height", f.height)));
}

bool render_one(Session& s) {
  const auto meshes = open_world(s, s.flags().inputs[0]);
  if (!meshes || !has_viewpoint(s, meshes)) return false;
  if (!write_picture(s, draw(s, meshes, render_options(s.flags()), "picture"), s.flags().output)) return false;
  print_pictures(s, {s.flags().output});
  return true;
}

/// "pump.png", 7: "pump_007.png".
std::string numbered(const std::string& name, int i) {
  const std::filesystem::path path(name);
  return (path.parent_path() / fmt::format("{}_{:03}{}", path.stem().string(), i, path.extension().string())).string();
}

/// Pictures of a round, in a file each or as one animation.
class Turntable {
 public:
  explicit Turntable(Session& s) : s_(s), name_(s.flags().output) {}

  bool make() {
    const auto meshes = open_world(s_, s_.flags().inputs[0]);
    if (!meshes || !has_viewpoint(s_, meshes)) return false;
    // The messages about the world are printed with the first picture.
    Diagnostics unheard(s_.diag().shared_sources());
    int i = 0;
    for (const auto& options :
         turntable(s_.world().scene, meshes, render_options(s_.flags()), s_.flags().turntable, s_.diag())) {
      if (!take(draw(s_, meshes, options, fmt::format("picture {}", i), i == 0 ? nullptr : &unheard), i)) return false;
      ++i;
    }
    if (animation_ && !end()) return false;
    print_pictures(s_, animation_ ? std::vector{name_} : written_);
    return true;
  }

 private:
  static constexpr int milliseconds = 80;  // of each picture: 36 of them go round in 2.9 s

  bool take(const Image& picture, int i) {
    if (!ends_with_ignoring_case(name_, ".webp")) {
      written_.push_back(numbered(name_, i));
      return write_picture(s_, picture, written_.back(), true);
    }
    std::string why;
    if (!animation_) animation_ = begin_webp_animation(milliseconds, why);
    if (animation_ && animation_->add(picture, why)) return true;
    s_.diag().report(Diag::cannot_write, {}, name_, why);
    return false;
  }

  bool end() {
    std::string why;
    const auto bytes = animation_->finish(why);
    if (!bytes) {
      s_.diag().report(Diag::cannot_write, {}, name_, why);
      return false;
    }
    return write_bytes(s_, *bytes, name_);
  }

  Session& s_;
  const std::string& name_;
  std::vector<std::string> written_;
  std::unique_ptr<PictureAnimation> animation_;
};

bool is_usable(const Flags& f, bool sheet) {
  auto fault = [](std::string_view why) {
    fmt::print(stderr, "wrlkit render: {}\n", why);
    return false;
  };
  if (!can_encode_as(f.output) && f.output != "-") {
    fmt::print(stderr, "wrlkit: '{}': pictures are written as .png, .jpg or .webp\n", f.output);
    return false;
  }
  if (sheet + !f.compare.empty() + (f.turntable > 0) > 1)
    return fault("several worlds, --compare or --turntable, one of them");
  if (const auto& l = f.look_at; l.size() == 9 && std::equal(l.begin(), l.begin() + 3, l.begin() + 3))
    return fault("--look-at: eye and target are the same point");
  if (f.turntable > 0 && f.output == "-") return fault("--turntable: pictures in a series need a name");
  return true;
}

constexpr int usual_samples = 16;  // along a side of a pixel, at most, but for paths

/// Options of the camera that others replace, and of light, where the mode finds none.
void warn_of_idle_picture_options(const Flags& flags) {
  if (flags.quiet) return;
  if (!flags.look_at.empty() && flags.fit) fmt::print(stderr, "wrlkit: --fit has no effect with --look-at\n");
  if (!flags.viewpoint.empty() && (flags.fit || !flags.look_at.empty()))
    fmt::print(stderr, "wrlkit: --viewpoint has no effect with --{}\n", flags.fit ? "fit" : "look-at");
  if (flags.mode == RenderOptions::Mode::path) return;
  if (flags.samples > usual_samples)
    fmt::print(stderr, "wrlkit: more than {} --samples have no effect without --mode path\n", usual_samples);
  for (const char* name : {"lamps", "exposure"})
    if (flags.is_given(name)) fmt::print(stderr, "wrlkit: --{} has no effect without --mode path\n", name);
}

}  // namespace

int run_render(const Flags& given) {
  const bool sheet = is_sheet(given);
  Flags flags = given;
  // Among many scenes, some may not have it.
  if (!sheet) flags.warnings.insert(flags.warnings.begin(), "error=viewpoint-not-found");
  Session s(flags);
  if (!is_usable(flags, sheet) || !s.good() || !s.choose_pipeline("picture")) return usage;
  if (s.printed_pipeline()) return done;
  warn_of_idle_picture_options(flags);
  if (sheet) return render_sheet(s);
  const bool made = !flags.compare.empty() ? render_comparison(s)
                    : flags.turntable > 0  ? Turntable(s).make()
                                           : render_one(s);
  s.progress().clear();
  if (made && flags.verbose && flags.mode == RenderOptions::Mode::density)
    fmt::print(stderr,
               "texels per metre: blue 1, cyan 6, green 32, yellow 181, red {:.0f} and more; grey: no lightmap\n",
               most_texels_per_metre);
  return s.end(made, s.diag().count(Diag::viewpoint_not_found) > 0 ? usage : nothing);
}

}  // namespace wrlkit
