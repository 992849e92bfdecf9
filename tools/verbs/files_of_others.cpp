#include "tools/verbs/files_of_others.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/io/read_file.h"
#include "base/io/uri.h"
#include "base/io/url.h"
#include "base/text/json_reader.h"
#include "scenegraph/urls.h"
#include "writers/made_files.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_gltf_bytes = 1 << 30;

std::string refusal(const std::string& output) {
  return fmt::format("another file is there that '{}' does not refer to; choose another name, or say --overwrite",
                     output);
}

/// Buffers and pictures of a .gltf, from its folder.
std::set<std::string> files_of_gltf(const std::string& path) {
  std::set<std::string> out;
  std::string why;
  JsonDocument doc;
  const auto text = read_bytes(path, most_gltf_bytes, why);
  if (!text || doc.parse(*text)) return out;
  for (const auto* table : {"buffers", "images"})
    for (const Json entry : doc.root()[table].elements())
      if (const auto uri = entry["uri"].text(); url_kind(uri) == UrlKind::file) out.insert(percent_decode(uri));
  return out;
}

/// What the urls of a scene may mean, from its folder.
std::set<std::string> files_of_scene(const std::string& path, Resources& resources) {
  std::set<std::string> out;
  const auto scene = resources.look_into(path);
  if (!scene) return out;
  for_each_url_list(*scene, UrlFields(*scene), [&](Span, std::span<const std::string_view> urls, UrlUse) {
    for (const auto url : urls)
      if (url_kind(url) == UrlKind::file)
        out.merge([&] {
          auto paths = url_paths(url);
          return std::set<std::string>(paths.begin(), paths.end());
        }());
  });
  return out;
}

/// What the output refers to nowhere: the picture of a sky, and sums of light that people look at in other programs.
std::vector<std::string> left_beside(const std::string& output) {
  const auto stem = stem_of(output);
  const auto named = [&](const std::string& made) { return stem.filename().string() + '.' + made; };
  std::vector<std::string> out{named("sky.png")};
  std::error_code fault;
  for (int page = 0;; ++page) {
    const auto name = named("lightmap_" + std::to_string(page) + ".exr");
    if (!fs::exists(stem.parent_path() / name, fault)) return out;
    out.push_back(name);
  }
}

bool is_gltf(const Output& to) { return to.format->endings == ".gltf"; }

}  // namespace

bool check_buffer(const Flags& flags, const Output& to) {
  if (flags.overwrite || !is_gltf(to) || to.path == "-") return true;
  const auto buffer = stem_of(to.path).concat(".bin");
  std::error_code fault;
  if (!fs::is_regular_file(buffer, fault)) return true;
  if (files_of_gltf(to.path).contains(buffer.filename().string())) return true;
  fmt::print(stderr, "wrlkit: '{}': {}\n", buffer.string(), refusal(to.path));
  return false;
}

void keep_files_of_others(Session& s, const Output& to) {
  if (s.flags().overwrite || to.path == "-") return;
  auto& written = s.resources().files_written();
  std::error_code fault;
  const auto folder = fs::path(to.path).parent_path();
  const auto whole = fs::weakly_canonical(fs::absolute(to.path, fault), fault).parent_path();
  const auto add = [&](const fs::path& file) {
    written.add((folder / file).string());
    written.add((whole / file).string());
  };
  add(fs::path(to.path).filename());
  for (const auto& named : s.pipeline().written_files()) written.add(named.file.path);
  written.refusal = refusal(to.path);
  if (!fs::is_regular_file(to.path, fault)) return;
  // A large .glb has all in it unless there are copies of files.
  const bool has_copies = fs::exists(stem_of(to.path).concat("_files"), fault);
  if (to.format->is_text || has_copies) std::ranges::for_each(files_of_scene(to.path, s.resources()), add);
  if (is_gltf(to)) std::ranges::for_each(files_of_gltf(to.path), add);
  std::ranges::for_each(left_beside(to.path), add);
}

}  // namespace wrlkit
