#include "parsers/gltf/buffers.h"

#include <filesystem>

#include "base/io/read_file.h"
#include "base/io/url.h"
#include "parsers/gltf/meshopt.h"

namespace wrlkit::gltf_reader {
namespace {

std::vector<std::string> folders(const std::string& path, const std::vector<std::string>& allowed) {
  std::vector<std::string> all = allowed;
  if (!path.empty()) all.push_back(std::filesystem::path(path).parent_path().string());
  return all;
}

}  // namespace

Buffers::Buffers(File& file, std::string path, const std::vector<std::string>& allowed,
                 std::vector<FileLookup>* lookups)
    : file_(file),
      path_(std::move(path)),
      allowed_(allowed),
      files_(folders(path_, allowed)),
      lookups_(lookups),
      buffers_(file.count(Table::buffers)),
      views_(file.count(Table::bufferViews)) {}

bool Buffers::spend(std::uint64_t bytes, Json on) {
  if (bytes <= max_bytes - spent_) {
    spent_ += bytes;
    return true;
  }
  file_.diag().report(Diag::too_large, file_.where(on), "the data of all buffers", readable_size(max_bytes),
                      readable_size(bytes));
  return false;
}

std::optional<std::string> Buffers::find(Json buffer, std::string_view uri) {
  auto report = [&](Diag id, auto... more) {
    file_.diag().report(id, file_.where(buffer["uri"]), uri.substr(0, 100), more...);
    return std::nullopt;
  };
  if (url_kind(uri) != UrlKind::file) return report(Diag::url_network);
  const auto best = path_.empty() ? find_url_below(files_, uri, allowed_) : find_url(files_, uri, path_);
  if (lookups_) lookups_->push_back({path_, std::string(uri), best});
  if (best.state == AllowedFiles::outside) return report(Diag::url_outside);
  if (best.state == AllowedFiles::missing) return report(Diag::url_not_found);
  if (best.state == AllowedFiles::repaired) report(Diag::url_repaired, best.path);
  return best.path;
}

std::optional<std::string> Buffers::load(Json buffer, std::string_view uri) {
  if (url_kind(uri) == UrlKind::data) {
    if (!spend(uri.size(), buffer)) return std::nullopt;
    auto bytes = decode_data_url(uri);
    if (!bytes) file_.diag().report(Diag::url_not_found, file_.where(buffer["uri"]), uri.substr(0, 100));
    return bytes;
  }
  const auto path = find(buffer, uri);
  if (!path) return std::nullopt;
  std::string why;
  auto bytes = read_bytes(*path, max_bytes - spent_, why);
  if (!bytes) {
    file_.diag().report(Diag::cannot_read, file_.where(buffer), *path, why);
    return std::nullopt;
  }
  if (!spend(bytes->size(), buffer)) return std::nullopt;
  return bytes;
}

std::optional<std::string_view> Buffers::buffer(std::uint32_t index) {
  auto& b = buffers_[index];
  if (std::exchange(b.tried, true)) return b.bytes;
  const Json json = file_.at(Table::buffers, index), uri = json["uri"];
  if (!uri && index == 0 && file_.is_binary()) return b.bytes = file_.binary_chunk();
  auto loaded = uri ? load(json, uri.text()) : std::nullopt;
  if (!uri) file_.diag().report(Diag::gltf_no_data, file_.where(json), word(Table::buffers), index, "it has no uri");
  if (!loaded) return std::nullopt;
  b.own = std::move(*loaded);
  return b.bytes = b.own;
}

void Buffers::look_for_unread() {
  for (std::uint32_t i = 0; i < buffers_.size(); ++i) {
    const Json json = file_.at(Table::buffers, i);
    const auto uri = json["uri"].text();
    const bool is_fallback = static_cast<bool>(json["extensions"]["EXT_meshopt_compression"]);
    if (!buffers_[i].tried && !is_fallback && !uri.empty() && url_kind(uri) == UrlKind::file) find(json, uri);
  }
}

std::optional<std::string_view> Buffers::slice(Json of) {
  auto index = file_.index(Table::buffers, of["buffer"]);
  auto all = index == none ? std::nullopt : buffer(index);
  if (!all) return std::nullopt;
  auto offset = of["byteOffset"] ? of["byteOffset"].whole() : 0, length = of["byteLength"].whole();
  if (!offset || !length || *offset > all->size() || *length > all->size() - *offset) {
    file_.diag().report(Diag::gltf_outside, file_.where(of), "bufferView", "the buffer");
    return std::nullopt;
  }
  return all->substr(*offset, *length);
}

std::optional<ViewBytes> Buffers::view(std::uint32_t index) {
  auto& v = views_[index];
  if (std::exchange(v.tried, true)) return v.bytes;
  return v.bytes = make_view(file_.at(Table::bufferViews, index), v);
}

std::optional<ViewBytes> Buffers::make_view(Json json, View& v) {
  Json packed = json["extensions"]["EXT_meshopt_compression"];
  if (!packed) packed = json["extensions"]["KHR_meshopt_compression"];
  auto stride = json["byteStride"].whole().value_or(0);
  if (packed) {
    if (!unpack(packed, v)) return std::nullopt;
    return ViewBytes{v.unpacked, stride};
  }
  auto bytes = slice(json);
  return bytes ? std::optional(ViewBytes{*bytes, stride}) : std::nullopt;
}

bool Buffers::unpack(Json json, View& v) {
  auto packed = slice(json);
  if (!packed) return false;
  const auto count = json["count"].whole().value_or(0), stride = json["byteStride"].whole().value_or(0);
  // No mode packs more than 64 to 1, except for its tail: what claims more is damaged, and must not cost memory.
  const bool likely =
      stride > 0 && stride <= 256 && count <= max_bytes / stride && count * stride <= 256 * (packed->size() + 256);
  if (likely && !spend(count * stride, json)) return false;
  if (likely && meshopt_unpack(*packed, {json["mode"].text(), json["filter"].text("NONE"), count, stride}, v.unpacked))
    return true;
  file_.diag().report(Diag::gltf_packed, file_.where(json), "EXT_meshopt_compression");
  return false;
}

}  // namespace wrlkit::gltf_reader
