#include "convert/missing_files.h"

#include <algorithm>

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

}  // namespace wrlkit
