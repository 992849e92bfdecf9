#include "parsers/resources.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/image/image.h"
#include "base/io/project_folder.h"
#include "base/io/url.h"
#include "parsers/parsers.h"
#include "parsers/patches/patches.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

std::size_t size_of(const Blob& b) { return b.bytes.size(); }
std::size_t size_of(const Image& i) { return i.pixels.size(); }

bool is_blank(std::string_view s) {
  return std::ranges::all_of(s, [](unsigned char c) { return c <= ' '; });
}

std::vector<std::string> folders_of(const ResourceOptions& options) {
  std::vector<std::string> all;
  if (!options.input.empty()) all.push_back(fs::path(options.input).parent_path().string());
  all.insert(all.end(), options.allowed.begin(), options.allowed.end());
  return all;
}

}  // namespace

/// What a url leads to: a file, or the data in it.
struct FileResources::Target {
  AllowedFiles::State state = AllowedFiles::missing;
  std::string path;  // to read; empty: the key is a data url, or that of a file that was made
  std::string key;
};

struct FileResources::Failure {
  Diag id;
  std::string_view url;
  std::string why;  // of image_unreadable; empty: has been reported
};

template <class T>
struct FileResources::Slot {
  std::mutex loading;
  std::weak_ptr<const T> object;
  std::string why_not;
};

FileResources::FileResources(ResourceOptions options, ParseWorld parse)
    : options_(std::move(options)), parse_(std::move(parse)), files_(folders_of(options_)) {
  if (options_.input.empty()) return;
  if (!options_.in_place) files_read().add(options_.input);
  if (!options_.project) return;
  const auto folder = fs::path(options_.input).parent_path().string();
  project_ = project_folder(folder);
  files_.allow_linked(folder, project_);
}

std::shared_ptr<const Blob> FileResources::bytes(std::span<const std::string_view> urls, Span where,
                                                 Diagnostics& diag) {
  return first_of<Blob>(urls, where, diag, [&](const Target& t, Failure& f) { return blob(t, f.why); });
}

std::shared_ptr<const Image> FileResources::image(std::span<const std::string_view> urls, Span where,
                                                  Diagnostics& diag) {
  return first_of<Image>(urls, where, diag, [&](const Target& t, Failure& f) { return picture(t, f.why); });
}

LinkedWorld FileResources::world(std::span<const std::string_view> urls, Span where, Diagnostics& diag) {
  LinkedWorld found;
  found.scene = first_of<Scene>(urls, where, diag, [&](const Target& t, Failure& f) {
    found.url = f.url;
    return parsed(t, f.url, where, diag);
  });
  return found;
}

// A failure is reported when no url works, and only one: the first that is about a file, for the user can do something
// about that one.
template <class T, class Load>
std::shared_ptr<const T> FileResources::first_of(std::span<const std::string_view> urls, Span where, Diagnostics& diag,
                                                 Load load) {
  std::optional<Failure> failure;
  for (auto url : urls) {
    auto kind = url_kind(url);
    if (kind == UrlKind::script || is_blank(url)) continue;
    Failure now{Diag::url_not_found, url, {}};
    if (kind == UrlKind::remote && !find_made(url))
      now.id = Diag::url_network;
    else if (auto target = locate(url, where, diag.sources()); target.state == AllowedFiles::outside)
      now.id = Diag::url_outside;
    else if (target.state != AllowedFiles::missing) {
      if (auto got = load(target, now)) {
        if (target.state == AllowedFiles::repaired) report_once(diag, Diag::url_repaired, where, url, target.path);
        return got;
      }
      now.id = Diag::image_unreadable;
    }
    if (!failure || (failure->id == Diag::url_network && now.id != Diag::url_network)) failure = std::move(now);
  }
  if (failure && failure->id == Diag::image_unreadable && !failure->why.empty())
    report_once(diag, failure->id, where, failure->url, failure->why);
  else if (failure && failure->id != Diag::image_unreadable)
    report_once(diag, failure->id, where, failure->url);
  return nullptr;
}

template <class... A>
void FileResources::report_once(Diagnostics& diag, Diag id, Span where, std::string_view url, const A&... more) {
  std::lock_guard lock(mutex_);
  if (reported_.emplace(where.begin, url).second) diag.report(id, where, url, more...);
}

FileResources::Target FileResources::locate(std::string_view url, Span where, const Sources& sources) {
  if (url_kind(url) == UrlKind::data || find_made(url)) return {AllowedFiles::found, {}, std::string(url)};
  std::lock_guard lock(mutex_);
  std::string referrer;
  if (!sources.is_in_memory(where.begin)) {
    referrer = sources.file(where.begin);
    if (referrer.empty() || referrer == standard_input_name) referrer = options_.input;
  }
  auto [at, is_new] = looked_up_.try_emplace({referrer, std::string(url)});
  auto& best = at->second;
  if (is_new) {
    best = referrer.empty() ? find_url_below(files_, url, options_.allowed) : find_url(files_, url, referrer);
    if (best.state == AllowedFiles::found || best.state == AllowedFiles::repaired) files_read().add(best.canonical);
  }
  return {best.state, best.path, best.canonical};
}

UrlTarget FileResources::target(std::string_view url, Span where, const Sources& sources) {
  using Kind = UrlTarget::Kind;
  const auto kind = url_kind(url);
  if (kind == UrlKind::data || find_made(url)) return {Kind::content};
  if (kind != UrlKind::file || is_blank(url)) return {};
  const auto at = locate(url, where, sources);
  if (at.state == AllowedFiles::outside) return {Kind::outside};
  return at.state == AllowedFiles::missing ? UrlTarget{} : UrlTarget{Kind::file, at.key};
}

std::shared_ptr<const Scene> FileResources::look_into(const std::string& path) {
  Diagnostics unseen;
  return parse_(path, unseen);
}

/// The object of a target: that which is still in use somewhere, or a new one.
template <class T, class Load>
std::shared_ptr<const T> FileResources::once(Slots<T>& slots, const Target& target, std::string& why, Load load) {
  std::shared_ptr<Slot<T>> slot;
  {
    std::lock_guard lock(cache_mutex_);
    auto& known = slots[target.key];
    if (!known) known = std::make_shared<Slot<T>>();
    slot = known;
  }
  std::lock_guard lock(slot->loading);
  if (auto object = slot->object.lock()) return object;
  std::shared_ptr<const T> made = slot->why_not.empty() ? load(slot->why_not) : nullptr;
  why = slot->why_not;
  slot->object = made;
  if (made) keep(made);
  return made;
}

template <class T>
void FileResources::keep(const std::shared_ptr<const T>& object) {
  std::lock_guard lock(cache_mutex_);
  kept_.emplace_back(object, size_of(*object));
  kept_bytes_ += kept_.back().second;
  for (; kept_bytes_ > options_.cached_bytes; kept_.pop_front()) kept_bytes_ -= kept_.front().second;
}

std::shared_ptr<const Blob> FileResources::blob(const Target& target, std::string& why) {
  return once(blobs_, target, why, [&](std::string& fault) -> std::shared_ptr<const Blob> {
    const MadeFile* made_here = find_made(target.key);
    bool is_data = target.path.empty() && !made_here;
    auto bytes = made_here ? *made_here->bytes
                 : is_data ? decode_data_url(target.key)
                           : read_bytes(target.path, options_.max_bytes, fault);
    if (!bytes && is_data) fault = "the data in the url are damaged";
    if (!bytes) return nullptr;
    auto name = made_here ? made_here->name : is_data ? std::string("data") : fs::path(target.path).filename().string();
    auto made = std::make_shared<Blob>(Blob{std::move(name), std::move(*bytes), {}});
    made->mime = sniff_mime(made->bytes, made->name);
    return made;
  });
}

std::shared_ptr<const Image> FileResources::picture(const Target& target, std::string& why) {
  return once(images_, target, why, [&](std::string& fault) -> std::shared_ptr<const Image> {
    auto file = blob(target, fault);
    auto image = file ? decode_image(file->bytes, file->name, fault) : std::nullopt;
    return image ? std::make_shared<const Image>(std::move(*image)) : nullptr;
  });
}

std::vector<std::string> FileResources::folders() const { return folders_of(options_); }

void FileResources::allow(const std::vector<std::string>& more) {
  std::lock_guard lock(mutex_);
  options_.allowed.insert(options_.allowed.end(), more.begin(), more.end());
  files_.allow(more);
  looked_up_.clear();
}

void FileResources::forget(const std::string& url) {
  std::lock_guard lock(cache_mutex_);
  blobs_.erase(url);
  images_.erase(url);
}

void FileResources::set_root(std::shared_ptr<const Scene> scene) {
  std::error_code none;
  auto key = fs::canonical(options_.input, none).string();
  if (!none) worlds_[key] = {false, std::move(scene)};
}

std::shared_ptr<const Scene> FileResources::parsed(const Target& target, std::string_view url, Span where,
                                                   Diagnostics& diag) {
  if (target.path.empty()) {
    report_once(diag, Diag::url_not_found, where, url);
    return nullptr;
  }  // no scenes in data urls
  std::lock_guard lock(mutex_);
  auto [at, is_new] = worlds_.try_emplace(target.key);
  auto& world = at->second;
  if (world.parsing) {
    report_once(diag, Diag::url_cycle, where, url);
    return nullptr;
  }
  if (!is_new) return world.scene;
  world.parsing = true;
  world.scene = parse_(target.path, diag);
  world.parsing = false;
  return world.scene;
}

std::size_t FileResources::files_above() const {
  std::set<std::string_view> files;
  for (const auto& [asked, result] : looked_up_)
    if (result.above) files.insert(result.canonical);
  return files.size();
}

std::vector<FileLookup> FileResources::lookups() const {
  std::vector<FileLookup> out;
  for (const auto& [asked, result] : looked_up_) out.push_back({asked.first, asked.second, result});
  for (const auto& path : patch_files_) out.push_back({"", path, {AllowedFiles::found, path, path}});
  return out;
}

std::unique_ptr<Scene> FileResources::parse(std::string_view text, const std::string& name, const ParseLimits& limits,
                                            Diagnostics& diag) {
  const auto world = parse_world(text, name, {.parse = limits}, diag);
  return world ? std::make_unique<Scene>(std::move(world->scene)) : nullptr;
}

std::shared_ptr<const PatchSet> FileResources::patches(const std::string& path, Diagnostics& diag) {
  patch_files_.insert(path);
  files_read().add(path);
  auto read = read_patches(path, {}, diag);
  return read ? std::make_shared<const PatchSet>(std::move(*read)) : nullptr;
}

}  // namespace wrlkit
