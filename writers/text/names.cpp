#include "writers/text/names.h"

#include <filesystem>

namespace wrlkit {

std::vector<std::string> led_urls(const Scene& scene, Span where, std::span<const std::string_view> urls,
                                  std::string_view file, const PlaceMade& place) {
  namespace fs = std::filesystem;
  auto folder = [](std::string_view f) {
    return (fs::absolute("." / fs::path(f).parent_path()) / "").lexically_normal();
  };
  std::vector<std::string> led(urls.begin(), urls.end());
  const auto is_made = [](std::string_view url) { return url.starts_with(made_scheme); };
  if (place && std::ranges::any_of(urls, is_made)) {
    for (auto& url : led)
      if (is_made(url)) url = place(url);
    return led;
  }
  const auto read = scene.sources->file(where.begin), main = scene.sources->file(0);
  if (read.empty() || read == "-") return led;
  const fs::path from = folder(read), here = folder(file.empty() ? main : file);
  if (from == here) return led;
  const fs::path prefix = from.lexically_relative(here);
  for (auto& url : led) {
    const bool relative = !url.empty() && url[0] != '/' && url[0] != '#' && url.find(':') == url.npos;
    if (relative && !prefix.empty()) url = (prefix / url).lexically_normal().generic_string();
  }
  return led;
}

}  // namespace wrlkit
