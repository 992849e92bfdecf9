#include "parsers/gltf/file.h"

#include "base/text/blanks.h"

namespace wrlkit::gltf_reader {
namespace {

constexpr std::string_view names[n_tables] = {"accessors", "animations", "buffers",   "bufferViews", "cameras",
                                              "images",    "lights",     "materials", "meshes",      "nodes",
                                              "samplers",  "scenes",     "skins",     "textures"};
constexpr std::string_view words[n_tables] = {"accessor", "animation", "buffer",   "bufferView", "camera",
                                              "image",    "light",     "material", "mesh",       "node",
                                              "sampler",  "scene",     "skin",     "texture"};

std::uint32_t little(std::string_view s, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i) v |= std::uint32_t{static_cast<unsigned char>(s[at + i])} << 8 * i;
  return v;
}

}  // namespace

std::string_view word(Table t) { return words[static_cast<std::size_t>(t)]; }

bool File::damaged(std::string_view what) {
  diag_.report(Diag::glb_damaged, {base_, 0}, what);
  return false;
}

// GLB: a header of 12 bytes, then chunks of length, type and data (glTF 2.0, 4.4). The first is the JSON, the second,
// if any, the first buffer. Lengths are believed as far as there are bytes.
bool File::take_chunks() {
  if (bytes_.size() < 20) return damaged("it ends within its header");
  if (auto version = little(bytes_, 4); version != 2)
    return damaged("its version is " + std::to_string(version) + ", not 2");
  if (little(bytes_, 8) > bytes_.size()) damaged("it is shorter than its header says");
  auto rest = bytes_.substr(12);
  for (int i = 0; i < 2 && rest.size() >= 8; ++i) {
    const std::size_t length = little(rest, 0), type = little(rest, 4);
    auto data = rest.substr(8, length);
    if (data.size() < length) damaged("a chunk is longer than the file");
    constexpr std::uint32_t json = 0x4e4f534a, bin = 0x004e4942;
    if (i == 0 && type != json) return damaged("its first chunk is no JSON");
    if (i == 0)
      text_ = data;
    else if (type == bin)
      binary_ = data;
    rest.remove_prefix(8 + data.size());
  }
  return true;
}

bool File::read() {
  text_ = bytes_;
  if (is_glb(bytes_) && !take_chunks()) return false;
  if (auto fault = document_.parse(text_)) {
    const auto at = static_cast<std::uint32_t>(base_ + (text_.data() - bytes_.data()) + fault->at);
    std::string found =
        fault->at < text_.size() ? "'" + std::string(text_.substr(fault->at, 1)) + "'" : "the end of the file";
    diag_.report(Diag::syntax, {at, 1}, fault->expected, found);
  }
  root_ = document_.root();
  if (!root_.is_object()) {
    diag_.report(Diag::gltf_no_asset, where(root_));
    return false;
  }
  const Json asset = root_["asset"];
  if (root_["geometricError"] && root_["root"]) {
    diag_.report(Diag::unknown_format, where(root_), "it is a 3D Tiles set; 'wrlkit view' shows it");
    return false;
  }
  if (auto version = asset["version"].text(); !version.starts_with("2.")) {
    diag_.report(version.empty() ? Diag::gltf_no_asset : Diag::gltf_version, where(asset ? asset : root_), version);
    return false;
  }
  for (std::size_t t = 0; t < n_tables; ++t) {
    Json holder = static_cast<Table>(t) == Table::lights ? root_["extensions"]["KHR_lights_punctual"] : root_;
    tables_[t] = holder[names[t]].elements();
  }
  made_here_ = asset["generator"].text() == "wrlkit";
  own_ = made_here_ && asset["extras"]["vrml97"].is_object();
  whole_ = own_ && !asset["extras"]["vrml97"]["facts"].boolean();
  return true;
}

std::uint32_t File::index(Table t, Json reference) {
  if (!reference) return none;
  auto i = reference.whole();
  if (i && *i < count(t)) return static_cast<std::uint32_t>(*i);
  diag_.report(Diag::gltf_bad_index, where(reference), word(t), reference.source().substr(0, 20));
  return none;
}

}  // namespace wrlkit::gltf_reader
