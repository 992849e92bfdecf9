#include "convert/output_urls.h"

#include "base/io/url.h"

namespace wrlkit {
namespace {

bool is_picture(UrlUse use) { return use == UrlUse::texture || use == UrlUse::picture; }

}  // namespace

OutputUrls::OutputUrls(const Writing& w, bool textures) : writing_(w), textures_(textures) {
  const bool alone = w.sink || w.to.path == "-" || w.options.link;
  if (!alone)
    copies_.emplace(w.scene, *w.context.resources, w.to.path, w.options.files_folder,
                    CopiedKinds{textures && !w.options.embed, !w.options.embed}, w.options.is_mirrored, w.context.diag);
}

std::optional<std::string> OutputUrls::operator()(std::string_view url, Span where, UrlUse use) {
  if (writing_.options.embed && is_picture(use) && (textures_ || use != UrlUse::texture))
    if (auto data = data_of(url, where)) return data;
  auto copy = copies_ ? copies_->url(url, where, use) : std::nullopt;
  if (writing_.options.embed && copy) report_not_embedded(*copy, where, use);
  return copy;
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
