#include "base/io/allowed_files.h"

#include <algorithm>
#include <filesystem>

#include "base/io/linked_file.h"
#include "base/io/url.h"
#include "base/text/letter_case.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

bool is_below(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) &&
         (folder.ends_with('/') || path.size() == folder.size() || path[folder.size()] == '/');
}

/// Absolute, without links and dots, whether or not it exists; empty when the system says no.
std::string canonical(const fs::path& path) {
  std::error_code ec;
  auto absolute = fs::absolute(path, ec);
  auto resolved = ec ? fs::path() : fs::weakly_canonical(absolute, ec);
  return ec ? std::string() : resolved.string();
}

std::map<std::string, std::string> list(const std::string& folder) {
  std::map<std::string, std::string> names;
  std::error_code ec;
  for (fs::directory_iterator i(folder, ec), end; !ec && i != end; i.increment(ec)) {
    auto name = i->path().filename().string();
    auto [at, is_new] = names.try_emplace(lower_case(name), name);
    if (!is_new) at->second = std::min(at->second, name);  // not the one that the system lists first
  }
  return names;
}

}  // namespace

AllowedFiles::AllowedFiles(const std::vector<std::string>& folders) { allow(folders); }

void AllowedFiles::allow(const std::vector<std::string>& folders) {
  for (auto& f : folders)
    if (auto c = canonical(f.empty() ? "." : f); !c.empty()) roots_.push_back({f, c});
}

void AllowedFiles::allow_linked(const std::string& folder, const std::string& top) {
  const auto from = canonical(folder.empty() ? "." : folder);
  if (top.empty() || from.empty() || from == top || !is_below(from, top)) return;
  fs::path given = folder;
  for (const auto& level : fs::path(from).lexically_relative(top)) given /= level.empty() ? "" : "..";
  roots_.push_back({given.lexically_normal().string(), top, true});
}

const AllowedFiles::Root* AllowedFiles::root_of(const std::string& path) const {
  auto root = std::ranges::find_if(roots_, [&](const Root& r) { return is_below(path, r.canonical); });
  return root == roots_.end() ? nullptr : &*root;
}

AllowedFiles::Result AllowedFiles::exact(const std::string& path) const {
  std::error_code ec;
  auto file = canonical(path);
  if (file.empty() || !fs::is_regular_file(file, ec)) return {};
  auto* root = root_of(file);
  if (!root || (root->linked && !is_linked_kind(file))) return {outside, {}, {}};
  const auto named = fs::path(root->given) / fs::path(file).lexically_relative(root->canonical);
  return {found, named.string(), file, root->linked};
}

/// The name as the folder has it; empty when it has none like it.
std::string AllowedFiles::name_in(const std::string& folder, const std::string& name) {
  std::error_code ec;
  if (fs::exists(fs::path(folder) / name, ec)) return name;
  auto known = listings_.find(folder);
  if (known == listings_.end()) known = listings_.emplace(folder, list(folder)).first;
  auto at = known->second.find(lower_case(name));
  return at == known->second.end() ? std::string() : at->second;
}

AllowedFiles::Result AllowedFiles::any_case(const std::string& path) {
  auto result = exact(path);
  if (result.state != missing) return result;
  auto wanted = canonical(path);
  auto* root = root_of(wanted);
  if (wanted.empty() || !root) return {};
  fs::path at = root->canonical;
  for (auto& part : fs::path(wanted).lexically_relative(root->canonical)) {
    auto name = name_in(at.string(), part.string());
    if (name.empty()) return {};
    at /= name;
  }
  result = exact(at.string());
  if (result.state == found) result.state = repaired;
  return result;
}

AllowedFiles::Result AllowedFiles::find(const std::string& path, const std::string& referrer) {
  constexpr std::size_t longest = 4096;  // PATH_MAX: no longer one can be opened
  if (path.empty() || path.size() > longest || path.find('\0') != path.npos) return {};
  const auto folder = fs::path(referrer).parent_path();
  const auto name = fs::path(path).filename();
  // A drive is another system's: its path means nothing here.
  auto result = has_drive(path) ? Result{} : any_case((folder / path).string());
  if (result.state == found || result.state == repaired || name.empty() || name == path) return result;
  auto beside = any_case((folder / name).string());
  if ((beside.state != found && beside.state != repaired) || beside.canonical == canonical(referrer)) return result;
  beside.state = repaired;
  return beside;
}

AllowedFiles::Result find_url(AllowedFiles& files, std::string_view url, const std::string& referrer) {
  AllowedFiles::Result best;
  for (const auto& path : url_paths(url))
    if (auto result = files.find(path, referrer); result.state < best.state) best = std::move(result);
  // Blender's "//../textures/brick.png" is relative to the scene that was exported.
  if (best.state == AllowedFiles::missing && url.starts_with("//")) {
    best = files.find(std::string(url.substr(2)), referrer);
    if (best.state == AllowedFiles::found) best.state = AllowedFiles::repaired;
  }
  return best;
}

AllowedFiles::Result find_url_below(AllowedFiles& files, std::string_view url, std::span<const std::string> folders) {
  AllowedFiles::Result best;
  for (const auto& folder : folders) {
    const auto referrer = std::filesystem::path(folder) / "none";  // of which only the folder matters
    if (auto result = find_url(files, url, referrer.string()); result.state < best.state) best = std::move(result);
  }
  return best;
}

}  // namespace wrlkit
