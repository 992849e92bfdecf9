// Urls are relative to the file that they are in; in what is written they have to lead to the same files.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "scenegraph/resources.h"
#include "scenegraph/urls.h"

namespace wrlkit {

/// The url of the copy of a file that a url leads to which was read at `where`; nothing when there is none.
using CopyOfUrl = std::function<std::optional<std::string>(std::string_view url, Span where, UrlUse use)>;

/// What a list of urls is written as.
using LeadUrls =
    std::function<std::vector<std::string>(Span where, std::span<const std::string_view> urls, UrlUse use)>;

/// Where urls are led to.
struct UrlLeads {
  std::string_view file;   // that is written: relative urls are led from its folder. Empty: from that of the input
  const PlaceMade& place;  // names the files that passes have made; none: their urls stay
  const CopyOfUrl& copy;   // of files that come along; none: urls lead to where files are
};

/// Those of an inlined scene, and those of a scene that is written elsewhere, lead to the file that they mean or to its
/// copy; those of a list that a pass has written lead to what it has made.
std::vector<std::string> led_urls(const Scene&, Span where, std::span<const std::string_view> urls, UrlUse,
                                  const UrlLeads&);

}  // namespace wrlkit
