#include "convert/formats.h"

#include <algorithm>

#include "base/text/letter_case.h"
#include "convert/writing.h"

namespace wrlkit {
namespace {

std::string text_of(std::string_view name) {
  return std::string(std::ranges::find(named_pipelines(), name, &NamedPipeline::name)->text);
}

/// A pipeline whose pictures with baked light have the size that is wanted.
std::string sized(std::string text, const LightmapSize& size) {
  constexpr std::string_view pass = "combine-lightmap";
  const auto at = text.find(pass);
  if (at == text.npos || size.pass_option().empty()) return text;
  const bool has_options = text[at + pass.size()] == '{';
  return text.insert(at + pass.size() + has_options,
                     has_options ? size.pass_option() + ',' : '{' + size.pass_option() + '}');
}

std::string gltf_pipeline(const SaveOptions& o) {
  using As = GltfOptions::Lightmaps;
  std::string name = o.lightmap_as == As::base_color ? "gltf"
                     : o.lightmap_as == As::emissive ? "gltf-emissive"
                                                     : "gltf-light";
  if (o.sky == SkyAs::none && o.lightmap_size.pass_option().empty()) return name;
  std::string text = sized(text_of(name), o.lightmap_size);
  if (o.sky != SkyAs::none)
    text.insert(text.find("tessellate"), o.sky == SkyAs::picture ? "sky{picture=true}," : "sky,");
  return text;
}

bool stays(const SaveOptions& o) { return o.dump || o.pipeline == "none"; }
/// With --embed, what Inlines hold is part of the output, too.
std::string text_pipeline(std::string_view name, const SaveOptions& o) {
  auto text = sized(text_of(name), o.lightmap_size);
  constexpr std::string_view first = "lower-vrml1,";
  if (o.embed) text.insert(text.starts_with(first) ? first.size() : 0, "inline,");
  return text;
}
std::string vrml_pipeline(const SaveOptions& o) { return stays(o) ? "none" : text_pipeline("vrml", o); }
std::string x3d_pipeline(const SaveOptions& o) { return o.dump ? "none" : text_pipeline("x3d", o); }

constexpr FileFormat file_formats[] = {
    {.name = "VRML97",
     .endings = ".wrl .wrz .wrl.gz .vrml .vrml.gz",
     .first_bytes = "#VRML V2.0 utf8",
     .reads = "yes, gzip by its first bytes",
     .writes = "yes, --gzip",
     .parsed = Format::vrml97,
     .write = write_vrml_file,
     .pipeline = vrml_pipeline,
     .is_text = true},
    {.name = "VRML 1.0",
     .endings = ".wrl .wrz .wrl.gz .iv",
     .first_bytes = "#VRML V1.0 ascii, #Inventor V2.1 ascii",
     .reads = "yes, Inventor 2 ASCII too",
     .writes = "no",
     .parsed = Format::vrml1},
    {.name = "X3D XML",
     .endings = ".x3d .x3dz .x3d.gz",
     .first_bytes = "<?xml, <X3D",
     .reads = "yes, versions 3.0 to 4.0, gzip",
     .writes = "yes, 3.3 or 4.0, --gzip",
     .parsed = Format::x3d_xml,
     .write = write_x3d_file,
     .pipeline = x3d_pipeline,
     .is_text = true},
    {.name = "X3D VRML",
     .endings = ".x3dv .x3dvz .x3dv.gz",
     .first_bytes = "#X3D V3.3 utf8",
     .reads = "yes, versions 3.0 to 4.0, gzip",
     .writes = "no",
     .parsed = Format::x3d_classic},
    {.name = "glTF 2.0",
     .endings = ".gltf",
     .first_bytes = "{\"asset\": ...",
     .reads = "yes, by its asset",
     .writes = "yes, --compress, optimize",
     .parsed = Format::gltf,
     .write = write_gltf_file,
     .pipeline = gltf_pipeline,
     .meshes = true},
    {.name = "GLB",
     .endings = ".glb",
     .first_bytes = "glTF",
     .reads = "yes, by its first bytes",
     .writes = "yes, --compress, optimize",
     .parsed = Format::gltf,
     .write = write_gltf_file,
     .pipeline = gltf_pipeline,
     .meshes = true},
    {.name = "patches", .endings = ".xml", .first_bytes = "<patches", .reads = "yes", .writes = "illuminate"},
    {.name = "pictures",
     .endings = "PNG JPEG GIF BMP TGA TIFF WebP EXR HDR",
     .first_bytes = "their own",
     .reads = "as textures; SGI DDS PCX XBM",
     .writes = "PNG, JPEG, WebP, EXR"},
};

struct ForeignFormat {
  std::string_view ending, name;
};
constexpr ForeignFormat foreign_formats[] = {
    {".obj", "Wavefront OBJ"}, {".fbx", "FBX"},          {".stl", "STL"},       {".dae", "COLLADA"},
    {".ply", "PLY"},           {".3ds", "3D Studio"},    {".blend", "Blender"}, {".usd", "USD"},
    {".usda", "USD"},          {".usdz", "USD"},         {".step", "STEP"},     {".stp", "STEP"},
    {".iges", "IGES"},         {".igs", "IGES"},         {".ifc", "IFC"},       {".dwg", "AutoCAD"},
    {".dxf", "AutoCAD DXF"},   {".dgn", "MicroStation"}, {".rvm", "AVEVA RVM"}, {".jt", "JT"},
};

const FileFormat& glb() { return *std::ranges::find(file_formats, "GLB", &FileFormat::name); }

std::vector<std::string_view> endings_where(bool (*wanted)(const FileFormat&)) {
  std::vector<std::string_view> out;
  for (const auto& format : file_formats)
    if (wanted(format))
      for (auto e : endings_of(format))
        if (std::ranges::find(out, e) == out.end()) out.push_back(e);
  return out;
}

}  // namespace

std::span<const FileFormat> formats() { return file_formats; }

std::vector<std::string_view> endings_of(const FileFormat& format) {
  std::vector<std::string_view> out;
  for (auto rest = format.endings; !rest.empty();) {
    const auto end = std::min(rest.find(' '), rest.size());
    out.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return out;
}

const std::vector<std::string_view>& scene_endings() {
  static const auto all_endings = [] {
    auto out = endings_where([](const FileFormat& f) { return f.parsed != Format::none; });
    std::ranges::stable_sort(out, std::greater{}, &std::string_view::size);
    return out;
  }();
  return all_endings;
}

std::vector<std::string_view> output_endings() {
  return endings_where([](const FileFormat& f) { return f.write != nullptr; });
}

std::string output_endings_text() {
  std::string out;
  std::vector<std::string_view> usual;
  for (const auto& format : file_formats)
    if (format.write) usual.push_back(endings_of(format)[0]);
  for (std::size_t i = 0; i < usual.size(); ++i)
    out += (i == 0 ? "" : i + 1 == usual.size() ? " or " : ", ") + std::string(usual[i]);
  return out;
}

std::string_view ending_of(std::string_view name, std::span<const std::string_view> endings) {
  for (auto e : endings)
    if (name.size() > e.size() && ends_with_ignoring_case(name, e)) return e;
  return {};
}

bool is_packed_ending(std::string_view ending) { return ending.ends_with('z'); }

std::optional<Output> output_of(const std::string& path, const SaveOptions& options) {
  if (path == "-") return Output{&glb(), path, false};
  const FileFormat* best = nullptr;
  std::string_view ending;
  const std::string name = "x" + path;  // ".wrl" alone is a name, too
  for (const auto& format : file_formats) {
    const auto found = format.write ? ending_of(name, endings_of(format)) : std::string_view();
    if (found.size() > ending.size()) {
      best = &format;
      ending = found;
    }
  }
  if (!best) return std::nullopt;
  return Output{best, path, best->is_text && (options.gzip || is_packed_ending(ending))};
}

std::string_view foreign_format(std::string_view name) {
  const auto found = std::ranges::find_if(
      foreign_formats, [&](const ForeignFormat& f) { return ends_with_ignoring_case(name, f.ending); });
  return found == std::end(foreign_formats) ? std::string_view() : found->name;
}

}  // namespace wrlkit
