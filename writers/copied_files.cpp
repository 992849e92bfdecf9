#include "writers/copied_files.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "base/io/output.h"
#include "base/io/read_file.h"
#include "base/io/uri.h"
#include "base/text/json_reader.h"
#include "writers/made_files.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;
using Kind = UrlTarget::Kind;

constexpr std::uint64_t most_gltf_bytes = 1 << 30;

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool have_equal_contents(const fs::path& a, const fs::path& b) {
  std::ifstream one(a, std::ios::binary), other(b, std::ios::binary);
  return one && other && std::equal(std::istreambuf_iterator<char>(one), {}, std::istreambuf_iterator<char>(other), {});
}

/// Whose files are named in ways of its own.
bool is_gltf(const fs::path& path) { return path.extension() == ".gltf"; }

fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path out;
  for (auto i = a.begin(), k = b.begin(); i != a.end() && k != b.end() && *i == *k; ++i, ++k) out /= *i;
  return out;
}

std::string url_of(const fs::path& path) {
  std::string out;
  for (const auto& part : path) out += (out.empty() ? "" : "/") + uri_of(part.string());
  return out;
}

}  // namespace

CopiedFiles::CopiedFiles(const Scene& scene, Resources& resources, const std::string& output, std::string folder,
                         CopiedKinds kinds, MirroredFiles is_mirrored, Diagnostics& diag)
    : scene_(scene),
      resources_(resources),
      folder_(std::move(folder)),
      kinds_(kinds),
      diag_(diag),
      is_mirrored_(std::move(is_mirrored)) {
  if (folder_.empty()) folder_ = stem_of(output).filename().string() + "_files";
  std::error_code fault;
  here_ = fs::weakly_canonical(fs::absolute(output, fault).parent_path(), fault);
  if (fault) return;
  for_each_url_list(scene, UrlFields(scene), [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
    find_files(urls, where, use);
  });
  place_all();
}

CopiedFiles::~CopiedFiles() {
  std::error_code fault;
  for (const auto& path : written_) {
    fs::remove(path, fault);
    for (auto folder = path.parent_path(); folder != here_ && fs::is_empty(folder, fault);
         folder = folder.parent_path())
      fs::remove(folder, fault);
  }
}

bool CopiedFiles::is_copied(UrlUse use) const {
  if (use == UrlUse::texture) return kinds_.textures;
  if (use == UrlUse::picture) return kinds_.pictures;
  return use != UrlUse::none && use != UrlUse::link;
}

bool CopiedFiles::is_here(const std::string& path) const {
  return is_below(path, here_) || (is_mirrored_ && is_mirrored_(path));
}

void CopiedFiles::find_files(std::span<const std::string_view> urls, Span where, UrlUse use) {
  if (!is_copied(use)) return;
  bool found = false;
  std::string_view outside;
  for (auto url : urls) {
    const auto target = resources_.target(url, where, *scene_.sources);
    if (target.kind == Kind::outside && outside.empty()) outside = url;
    found |= target.kind == Kind::content || target.kind == Kind::file;
    if (target.kind != Kind::file || is_here(target.path)) continue;
    places_.try_emplace(target.path);
    if (use == UrlUse::world || is_gltf(target.path)) add_of_world(target.path);
  }
  if (!found && !outside.empty() && kinds_.textures) resources_.bytes({&outside, 1}, where, diag_);  // reports it
}

/// With what it refers to, and so on.
void CopiedFiles::add_of_world(const std::string& path) {
  std::vector<std::string> worlds{path};
  while (!worlds.empty()) {
    const std::string world = std::move(worlds.back());
    worlds.pop_back();
    places_.try_emplace(world);
    if (!fixed_.insert(world).second) continue;
    const auto scene = resources_.look_into(world);
    if (!scene) continue;
    if (is_gltf(world)) add_of_gltf(world, *scene);
    for_each_url_list(*scene, UrlFields(*scene), [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
      for (auto url : use == UrlUse::link ? std::span<const std::string_view>() : urls) {
        const auto target = resources_.target(url, where, *scene->sources);
        if (target.kind != Kind::file) continue;
        if (use == UrlUse::world) {
          worlds.push_back(target.path);
          continue;
        }
        places_.try_emplace(target.path);
        fixed_.insert(target.path);
      }
    });
  }
}

/// Buffers and pictures, which the scene need not refer to.
void CopiedFiles::add_of_gltf(const std::string& path, const Scene& scene) {
  std::string why;
  JsonDocument doc;
  const auto text = read_bytes(path, most_gltf_bytes, why);
  const auto nodes = all_nodes(scene);
  if (!text || doc.parse(*text) || nodes.empty()) return;
  for (const auto* table : {"buffers", "images"})
    for (const Json entry : doc.root()[table]) {
      const auto uri = entry["uri"].text();
      if (uri.empty()) continue;
      const auto target = resources_.target(uri, scene.where(nodes.front()), *scene.sources);
      if (target.kind != Kind::file) continue;
      places_.try_emplace(target.path);
      fixed_.insert(target.path);
    }
}

/// The files stand to each other as they did, below their common folder.
void CopiedFiles::place_all() {
  if (places_.empty()) return;
  fs::path common = fs::path(places_.begin()->first).parent_path();
  for (const auto& [path, place] : places_) common = common_folder(common, fs::path(path).parent_path());
  for (const auto& path : fixed_) equal_file(path);
  for (auto& [path, place] : places_) {
    const std::string* equal = fixed_.contains(path) ? nullptr : equal_file(path);
    place = folder_ / fs::path(equal ? *equal : path).lexically_relative(common);
  }
}

/// One before it in the order of their paths, with the same contents.
const std::string* CopiedFiles::equal_file(const std::string& path) {
  std::error_code fault;
  auto& others = by_size_[fs::file_size(path, fault)];
  const auto same = std::ranges::find_if(others, [&](const std::string& o) { return have_equal_contents(o, path); });
  if (same != others.end()) return &*same;
  others.push_back(path);
  return nullptr;
}

std::optional<std::string> CopiedFiles::url(std::string_view url, Span where, UrlUse use) const {
  if (!is_copied(use)) return std::nullopt;
  const auto target = resources_.target(url, where, *scene_.sources);
  const auto at = target.kind == Kind::file ? places_.find(target.path) : places_.end();
  if (at == places_.end() || is_here(at->first)) return std::nullopt;
  const auto behind = url.substr(std::min(url.find('#'), url.size()));  // a part of the file, or of its name
  return url_of(at->second) + std::string(at->first.ends_with(behind) ? std::string_view() : behind);
}

bool CopiedFiles::write() {
  std::set<fs::path> done;
  for (const auto& [from, place] : places_)
    if (done.insert(place).second && !write(from, here_ / place)) return false;
  return true;
}

bool CopiedFiles::write(const std::string& from, const fs::path& to) {
  std::error_code fault;
  const bool was_there = fs::exists(to, fault);
  if (was_there && have_equal_contents(from, to)) {
    resources_.files_written().add(to.string());
    return true;
  }
  auto out = OutputFile::open(
      to.string(),
      {.inputs = &resources_.files_read(), .written = &resources_.files_written(), .report_replaced = true}, diag_);
  if (!out) return false;
  std::ifstream in(from, std::ios::binary);
  std::array<char, 64 * 1024> piece{};
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0)
    out->write(std::string_view(piece.data(), static_cast<std::size_t>(in.gcount())));
  if (!out->commit(diag_)) return false;
  if (!was_there) written_.push_back(to);
  return true;
}

}  // namespace wrlkit
