#include "tools/corpus/written_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/io/allowed_files.h"
#include "base/io/url.h"
#include "convert/formats.h"
#include "scenegraph/legal_name.h"
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

fs::path folder_of(std::string_view file) {
  return (fs::absolute(fs::path(file)).parent_path() / "").lexically_normal();
}

class Namer {
 public:
  Namer(Scene& scene, const CorpusPlan& plan, const CorpusJob& job, const std::string& out,
        const std::vector<std::string>& allowed, NamedUrls named)
      : scene_(scene),
        plan_(plan),
        job_(job),
        out_(fs::absolute(out)),
        files_(allowed),
        main_(scene.sources->file(0)),
        only_(named) {
    const auto from = folder_of(main_), here = folder_of((fs::path(out) / job.output).string());
    if (from != here) prefix_ = from.lexically_relative(here);
  }

  void name_all() {
    const UrlFields fields(scene_);
    for (NodeId n : all_nodes(scene_)) {
      const auto n_fields = static_cast<std::uint16_t>(scene_.type(n).fields.size());
      for (std::uint16_t slot = 0; slot < n_fields; ++slot) {
        const auto use = fields.use(scene_.type_id(n), slot);
        if (use == UrlUse::none) continue;
        const Value* v = scene_.find(n, slot);
        if (!v || v->is || v->type != FieldType::MFString || v->count == 0 ||
            !names(v->text_span(), scene_.where(n), use))
          continue;
        scene_.set(n, scene_.make(FieldType::MFString, slot, named_));
      }
    }
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i)
      if (auto& proto = scene_.proto(ProtoId{i}); proto.external && names(proto.urls, proto.where, UrlUse::world))
        proto.urls = named_;
  }

 private:
  /// Whether some of the urls get another name; then named_ has them all. In text, those in a scene that was put into
  /// this one are led elsewhere.
  bool names(std::span<const std::string_view> urls, Span where, UrlUse use) {
    const auto file = scene_.sources->file(where.begin);
    referrer_ = file.empty() ? main_ : file;
    if (only_ == NamedUrls::links ? use != UrlUse::link : referrer_ != main_) return false;
    named_.assign(urls.begin(), urls.end());
    bool any = false;
    for (auto& url : named_)
      if (const auto other = written(url, use); !other.empty()) {
        url = scene_.keep(other);
        any = true;
      }
    return any;
  }

  /// What a url is to be; empty: it stays.
  std::string written(std::string_view url, UrlUse use) {
    const auto fragment = url.substr(std::min(url.find('#'), url.size()));
    if (fragment.size() == url.size() || url_kind(url) != UrlKind::file) return "";
    const auto found = find_url(files_, url, referrer_);
    const bool is_found = found.state == AllowedFiles::found || found.state == AllowedFiles::repaired;
    const auto at =
        is_found ? plan_.by_path.find(fs::path(found.path).lexically_normal().string()) : plan_.by_path.end();
    if (only_ == NamedUrls::links)
      return at == plan_.by_path.end() ? "" : from_input(plan_.jobs[at->second]) + std::string(fragment);
    if (at == plan_.by_path.end()) return use == UrlUse::link ? led(url) : "";
    const auto& target = plan_.jobs[at->second];
    const bool has_its_name = fs::path(target.output).filename() == fs::path(target.input.inside).filename();
    const bool leads_there = found.state == AllowedFiles::found && is_relative_url(url);
    if (leads_there && (target.input.asset || has_its_name)) return "";
    // Both below one folder, so that one leads to the other without leaving it.
    return url_of(("/" / fs::path(target.output))
                      .lexically_relative(("/" / fs::path(job_.output)).parent_path())
                      .generic_string()) +
           name_written_in(target, fragment);
  }

  /// As seen from the file that has the link, whose urls the writer leads to the folder of the output.
  std::string from_input(const CorpusJob& target) const {
    return url_of((out_ / target.output).lexically_normal().lexically_relative(folder_of(referrer_)).generic_string());
  }

  /// Pages, and scenes that do not come along: to where they are, as a single conversion does.
  std::string led(std::string_view url) const {
    if (!is_relative_url(url) || prefix_.empty()) return "";
    return (url_of(prefix_.generic_string()) / fs::path(url)).lexically_normal().generic_string();
  }

  /// A name of X3D that VRML97 does not have is another one there (passes/lower_x3d/vrml97_names.h).
  static std::string name_written_in(const CorpusJob& target, std::string_view fragment) {
    const auto is_x3d = [](const std::string& path) {
      return ending_of(fs::path(path).filename().string(), scene_endings()).starts_with(".x3d");
    };
    if (fragment.empty() || !is_x3d(target.input.inside) || is_x3d(target.output)) return std::string(fragment);
    return "#" + legal_name(fragment.substr(1));
  }

  Scene& scene_;
  const CorpusPlan& plan_;
  const CorpusJob& job_;
  fs::path out_;
  AllowedFiles files_;
  std::string main_, referrer_;
  NamedUrls only_;
  fs::path prefix_;  // from the folder of the output to that of the input
  std::vector<std::string_view> named_;
};

}  // namespace

void name_written_files(Scene& scene, const CorpusPlan& plan, const CorpusJob& job, const std::string& out,
                        const std::vector<std::string>& allowed, NamedUrls named) {
  Namer(scene, plan, job, out, allowed, named).name_all();
}

}  // namespace wrlkit
