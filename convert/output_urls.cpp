#include "convert/output_urls.h"

#include <algorithm>
#include <filesystem>

#include "base/io/uri.h"
#include "base/io/url.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

bool is_picture(UrlUse use) { return use == UrlUse::texture || use == UrlUse::picture; }

}  // namespace

OutputUrls::OutputUrls(const Writing& w, bool textures) : writing_(w), textures_(textures) {
  const bool alone = w.sink || w.to.path == "-" || w.options.link;
  if (!alone)
    copies_.emplace(w.scene, *w.context.resources, w.to.path, w.options.files_folder,
                    CopiedKinds{textures && !w.options.embed, !w.options.embed}, w.options.is_mirrored, w.context.diag);
}

std::optional<std::string> OutputUrls::operator()(std::string_view url, Span where, UrlUse use) {
  // In memory there is nothing next to what is written.
  const bool embeds = writing_.options.embed || (writing_.sink && writing_.context.resources->find_made(url));
  if (embeds && is_picture(use) && (textures_ || use != UrlUse::texture))
    if (auto data = data_of(url, where)) return data;
  auto copy = copies_ ? copies_->url(url, where, use) : std::nullopt;
  if (writing_.options.embed && copy) report_not_embedded(*copy, where, use);
  return copy ? copy : led_from_nowhere(url, where);
}

/// Relative urls of nodes that lie in no file lead to a file by other ways than those of the file that is written.
std::optional<std::string> OutputUrls::led_from_nowhere(std::string_view url, Span where) {
  const auto& sources = *writing_.scene.sources;
  const auto& path = writing_.to.path;
  if ((where && !sources.is_in_memory(where.begin)) || writing_.sink || path == "-") return std::nullopt;
  const auto target = writing_.context.resources->target(url, where, sources);
  if (target.kind != UrlTarget::Kind::file) return std::nullopt;
  std::error_code fault;
  const auto here = fs::weakly_canonical(fs::absolute(path, fault).parent_path(), fault);
  if (fault) return std::nullopt;
  return uri_of(fs::path(target.path).lexically_relative(here).generic_string()) +
         std::string(url.substr(std::min(url.find('#'), url.size())));
}

void OutputUrls::report_not_embedded(const std::string& copy, Span where, UrlUse use) {
  const auto file = copy.substr(0, copy.find('#'));
  if (!not_embedded_.insert(file).second) return;
  writing_.context.diag.report(Diag::not_embedded, where, file,
                               use == UrlUse::world ? "; use -p inline,expand-protos to include it" : "");
}

std::optional<std::string> OutputUrls::data_of(std::string_view url, Span where) {
  auto& resources = *writing_.context.resources;
  const bool is_file = resources.target(url, where, *writing_.scene.sources).kind == UrlTarget::Kind::file;
  if (!is_file && !resources.find_made(url)) return std::nullopt;
  const auto picture = resources.bytes({&url, 1}, where, writing_.context.diag);
  if (!picture || picture->mime.empty()) return std::nullopt;
  return data_url(picture->mime, picture->bytes);
}

}  // namespace wrlkit
