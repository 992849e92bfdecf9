#include "tools/corpus/written_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/io/allowed_files.h"
#include "base/io/url.h"
#include "scenegraph/urls.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

/// A path as a url: what would be read as something else is encoded.
std::string url_of(const std::string& path) {
  std::string out;
  for (const char c : path) {
    if (c == '%' || c == '#' || c == '?' || c == ' ')
      out += fmt::format("%{:02X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out;
}

class Namer {
 public:
  Namer(Scene& scene, const CorpusPlan& plan, const CorpusJob& job, const std::vector<std::string>& allowed)
      : scene_(scene), plan_(plan), job_(job), files_(allowed), main_(scene.sources->file(0)) {}

  void name_all() {
    const UrlFields fields(scene_);
    for (NodeId n : all_nodes(scene_)) {
      const auto n_fields = static_cast<std::uint16_t>(scene_.type(n).fields.size());
      for (std::uint16_t slot = 0; slot < n_fields; ++slot) {
        if (fields.use(scene_.type_id(n), slot) == UrlUse::none) continue;
        const Value* v = scene_.find(n, slot);
        if (!v || v->is || v->type != FieldType::MFString || v->count == 0 || !names(v->text_span(), scene_.where(n)))
          continue;
        scene_.set(n, scene_.make(FieldType::MFString, slot, named_));
      }
    }
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i)
      if (auto& proto = scene_.proto(ProtoId{i}); proto.external && names(proto.urls, proto.where)) proto.urls = named_;
  }

 private:
  /// Whether some of the urls get another name; then named_ has them all. Those in a scene that was put into this one
  /// are led elsewhere.
  bool names(std::span<const std::string_view> urls, Span where) {
    if (const auto referrer = scene_.sources->file(where.begin); !referrer.empty() && referrer != main_) return false;
    named_.assign(urls.begin(), urls.end());
    bool any = false;
    for (auto& url : named_)
      if (const auto other = written(url); !other.empty()) {
        url = scene_.keep(other);
        any = true;
      }
    return any;
  }

  /// What a url is to be; empty: it stays.
  std::string written(std::string_view url) {
    const auto fragment = url.substr(std::min(url.find('#'), url.size()));
    if (fragment.size() == url.size() || url_kind(url) != UrlKind::file) return "";
    const auto found = find_url(files_, url, main_);
    if (found.state != AllowedFiles::found && found.state != AllowedFiles::repaired) return "";
    const auto at = plan_.by_path.find(fs::path(found.path).lexically_normal().string());
    if (at == plan_.by_path.end()) return "";
    const auto& target = plan_.jobs[at->second];
    if (target.input.asset || fs::path(target.output).filename() == fs::path(target.input.inside).filename()) return "";
    // Both below one folder, so that one leads to the other without leaving it.
    return url_of(("/" / fs::path(target.output))
                      .lexically_relative(("/" / fs::path(job_.output)).parent_path())
                      .generic_string()) +
           std::string(fragment);
  }

  Scene& scene_;
  const CorpusPlan& plan_;
  const CorpusJob& job_;
  AllowedFiles files_;
  std::string main_;
  std::vector<std::string_view> named_;
};

}  // namespace

void name_written_files(Scene& scene, const CorpusPlan& plan, const CorpusJob& job,
                        const std::vector<std::string>& allowed) {
  Namer(scene, plan, job, allowed).name_all();
}

}  // namespace wrlkit
