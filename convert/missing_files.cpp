#include "convert/missing_files.h"

#include <algorithm>
#include <set>

#include "base/io/url.h"
#include "scenegraph/urls.h"

namespace wrlkit {
namespace {

bool is_local(std::string_view url) { return url_kind(url) == UrlKind::file; }

/// Calls f(Span where, urls, UrlUse) for lists of local urls none of which leads to a file.
void for_each_missing(const Scene& scene, Resources& resources, auto&& f) {
  for_each_url_list(scene, UrlFields(scene), [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
    if (use == UrlUse::link || urls.empty() || !std::ranges::all_of(urls, is_local)) return;
    const bool found = std::ranges::any_of(urls, [&](std::string_view url) {
      return resources.target(url, where, *scene.sources).kind != UrlTarget::Kind::nothing;
    });
    if (!found) f(where, urls, use);
  });
}

}  // namespace

void report_missing_parts(const Scene& scene, Resources& resources, Diagnostics& diag) {
  for_each_missing(scene, resources, [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
    if (use != UrlUse::file) resources.bytes(urls, where, diag);  // reports it
  });
}

void report_missing_media(const Scene& scene, Resources& resources, Diagnostics& diag) {
  for_each_missing(scene, resources, [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
    if (use == UrlUse::file) diag.report(Diag::media_not_found, where, urls[0]);
  });
}

void report_missing_pictures(const Scene& scene, Resources& resources, Diagnostics& diag) {
  std::set<std::string_view> reported;
  for_each_missing(scene, resources, [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
    const bool is_picture = use == UrlUse::texture || use == UrlUse::picture;
    if (is_picture && reported.insert(urls[0]).second) diag.report(Diag::media_not_found, where, urls[0]);
  });
}

std::vector<std::string> files_outside(const Scene& scene, Resources& resources) {
  std::vector<std::string> out;
  for_each_url_list(scene, UrlFields(scene), [&](Span where, std::span<const std::string_view> urls, UrlUse use) {
    const auto leads_to_file = [&](std::string_view url) {
      return is_local(url) && resources.target(url, where, *scene.sources).kind == UrlTarget::Kind::file;
    };
    const auto found = std::ranges::find_if(urls, leads_to_file);
    if (use == UrlUse::link || found == urls.end()) return;
    if (std::ranges::find(out, *found) == out.end()) out.emplace_back(*found);
  });
  return out;
}

}  // namespace wrlkit
