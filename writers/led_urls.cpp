#include "writers/led_urls.h"

#include <algorithm>
#include <filesystem>

#include "base/io/url.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

bool is_made(std::string_view url) { return url.starts_with(made_scheme); }

fs::path folder_of(std::string_view file) {
  return (fs::absolute("." / fs::path(file).parent_path()) / "").lexically_normal();
}

struct Folders {
  fs::path from;  // that of the file in which urls stand
  fs::path here;  // that of the output
};

/// Nothing where urls stay: the folders are the same, or there is none.
std::optional<Folders> folders_of(const Scene& scene, Span where, std::string_view file) {
  const auto read = scene.sources->file(where.begin), main = scene.sources->file(0);
  if (read.empty() || read == "-" || scene.sources->is_in_memory(where.begin)) return {};
  Folders folders{folder_of(read), folder_of(file.empty() ? main : file)};
  return folders.from == folders.here ? std::nullopt : std::optional(std::move(folders));
}

}  // namespace

std::vector<std::string> led_urls(const Scene& scene, Span where, std::span<const std::string_view> urls, UrlUse use,
                                  const UrlLeads& leads) {
  std::vector<std::string> led(urls.begin(), urls.end());
  if (leads.place && std::ranges::any_of(urls, is_made)) {
    for (auto& url : led) {
      if (!is_made(url)) continue;
      auto data = leads.copy ? leads.copy(url, where, use) : std::nullopt;  // of --embed
      url = data ? std::move(*data) : leads.place(url);
    }
    return led;
  }
  const auto folders = folders_of(scene, where, leads.file);
  for (auto& url : led) {
    if (auto copy = leads.copy ? leads.copy(url, where, use) : std::nullopt)
      url = std::move(*copy);
    else if (is_relative_url(url) && folders)
      url = (folders->from / url).lexically_normal().lexically_relative(folders->here).generic_string();
  }
  return led;
}

}  // namespace wrlkit
