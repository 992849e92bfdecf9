// wrlkit illuminate: global illumination of a scene, as a patch file. What RenderX was to Lazanyi (3.1).
#include "light/patches/illuminate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

#include "base/image/image.h"
#include "base/image/srgb.h"
#include "base/io/output.h"
#include "base/text/json.h"
#include "light/patches/patch_lightmap.h"
#include "light/sky_light.h"
#include "tools/cli/lengths.h"
#include "tools/cli/session.h"
#include "writers/patches/patches.h"

namespace wrlkit {
namespace {

bool read_options(const Flags& f, light::IlluminateOptions& o) {
  o.method = f.method;
  o.sizes.max_area = f.max_area;
  o.sizes.most_patches = static_cast<std::size_t>(f.max_patches);
  o.gradient = f.gradient;
  o.how.samples = f.light_samples;
  o.how.seed = static_cast<std::uint64_t>(f.seed);
  if (f.max_edge.empty()) return true;
  o.sizes.max_edge = length_of(f.max_edge);
  if (o.sizes.max_edge > 0) return true;
  fmt::print(stderr, "wrlkit illuminate: --max-edge: '{}' is not a valid length\n", f.max_edge);
  return false;
}

std::optional<light::LightOptions> light_options(const Flags& f) {
  light::LightOptions out{.emission = f.emission};
  SkyLight sky;
  if (!sky.read(f.sky)) {
    fmt::print(stderr, "wrlkit illuminate: --sky: '{}' is neither background nor none nor a radiance R:G:B\n", f.sky);
    return std::nullopt;
  }
  set_sky(out, sky);
  return out;
}

/// A scene that is its own patch file would be gone.
bool is_safe(const Flags& f) {
  std::error_code none_there;
  if (!std::filesystem::equivalent(f.inputs[0], f.output, none_there)) return true;
  fmt::print(stderr, "wrlkit illuminate: '{}' is the world itself\n", f.output);
  return false;
}

/// The folder for the pictures; found out before the work is done.
bool make_folder(Session& s) {
  const auto& folder = s.flags().pictures;
  if (folder.empty()) return true;
  std::error_code trouble;
  std::filesystem::create_directories(folder, trouble);
  if (trouble) s.diag().report(Diag::cannot_write, {}, folder, trouble.message());
  return !trouble;
}

Image as_seen(const light::FloatPicture& picture) {
  Image image{picture.width, picture.height, 3, {}};
  for (const auto& p : picture.pixels)
    for (double v : {p.x, p.y, p.z}) image.pixels.push_back(static_cast<std::uint8_t>(linear_to_srgb(v) * 255 + 0.5));
  return image;
}

/// "Room_Wall.png" of Room/Wall; a number behind it where there are several of that name, or none.
std::string picture_name(const Scene& scene, const light::LightWorld& world, std::uint32_t use,
                         std::set<std::string>& taken) {
  auto name = drawing::full_name(scene, world.stage(), world.stage().uses[use]);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && static_cast<unsigned char>(c) < 0x80) c = '_';
  if (name.empty() || !taken.insert(name).second) name += (name.empty() ? "" : "_") + std::to_string(use);
  return name + ".png";
}

/// A picture for each Shape, until one cannot be written, which is reported.
void write_pictures(Session& s, const PatchSet& set, const light::LightWorld& world) {
  const std::filesystem::path folder = s.flags().pictures;
  std::set<std::string> taken;
  for (const auto& shape : light::patch_lightmap(set, world, {.smooth = s.flags().smooth}).shapes) {
    const auto path = (folder / picture_name(s.world().scene, world, shape.use, taken)).string();
    std::string why;
    const auto png = encode_png(as_seen(shape.picture), why);
    if (!png) return s.diag().report(Diag::cannot_write, {}, path, why);
    auto file = OutputFile::open(path, {.inputs = s.files_read(), .report_replaced = true}, s.diag());
    if (!file) return;
    file->write(*png);
    if (!file->commit(s.diag())) return;
  }
}

void print(Session& s, const PatchSet& set, double seconds) {
  s.progress().clear();
  if (s.flags().json) {
    s.print_json(json_of(json_object("file", s.flags().output, "method", set.method, "samples", set.samples, "shapes",
                                     set.shapes.size(), "triangles", set.triangles.size(), "patches",
                                     set.patches.size(), "cpu_seconds", seconds)));
  } else if (s.flags().verbose) {
    fmt::print(stderr, "{}: {} patches of {} triangles in {} shapes, {:.1f} s of processor time\n", s.flags().output,
               set.patches.size(), set.triangles.size(), set.shapes.size(), seconds);
  }
}

}  // namespace

int run_illuminate(const Flags& flags) {
  Session s(flags);
  light::IlluminateOptions options;
  const auto light = light_options(flags);
  if (!s.good() || !light || !read_options(flags, options) || !is_safe(flags) ||
      !s.choose_pipeline("lower-vrml1,expand,lower-x3d{materials=true},tessellate{texcoords=true}"))
    return usage;
  if (!s.read(flags.inputs[0])) return s.end(false);
  auto file =
      OutputFile::open(flags.output, {.gzip = flags.output.ends_with(".gz"), .inputs = s.files_read()}, s.diag());
  if (!file || !make_folder(s)) return s.end(false);
  const auto meshes = s.pipeline().run_lazily(s.world().scene, s.context(), s.pipeline_options());
  if (!meshes) return s.end(false);
  const auto begin = std::clock();
  const light::LightWorld world(s.world().scene, meshes, &s.resources(), *light, s.diag());
  constexpr int parts = 1000;
  s.progress().begin(std::string(name_of(flags.method)), parts, "parts");
  options.how.done = [&](double share) { s.progress().set(static_cast<std::uint64_t>(share * parts)); };
  auto set = light::illuminate(s.world().scene, world, options, s.diag());
  if (set.patches.empty()) {
    s.diag().report(Diag::no_surface, {});
    return s.end(false);
  }
  set.source = flags.inputs[0] == standard_input ? "" : std::filesystem::path(flags.inputs[0]).filename().string();
  set.method = name_of(flags.method);
  write_patches(set, file->sink());
  if (!file->commit(s.diag())) return s.end(false);
  if (!flags.pictures.empty()) write_pictures(s, set, world);
  if (!world.has_sky_of_its_own()) s.diag().report(Diag::no_light, {});
  print(s, set, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return s.end(true);
}

}  // namespace wrlkit
