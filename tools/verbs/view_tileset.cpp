#include "tools/verbs/view_tileset.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/io/output.h"
#include "base/io/read_file.h"
#include "base/text/json_reader.h"
#include "tools/verbs/serve.h"
#include "tools/verbs/viewer_page.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view file_name = "tileset.json";
constexpr std::uintmax_t most_bytes = 1 << 30;  // of a file that is served

/// The folder, by its own name.
std::string name_of(const fs::path& folder) {
  std::error_code fault;
  return fs::weakly_canonical(folder, fault).filename().string();
}

std::shared_ptr<const std::string> page_of(const fs::path& folder, const std::string& tileset) {
  auto html = std::make_shared<std::string>();
  write_tiles_page(name_of(folder), tileset, [&](std::string_view bytes) { *html += bytes; });
  return html;
}

std::string_view type_of(const fs::path& file) {
  const auto extension = file.extension();
  if (extension == ".json") return "application/json";
  if (extension == ".glb") return "model/gltf-binary";
  if (extension == ".subtree") return "application/octet-stream";
  return {};
}

/// Names of files and folders as tilesets have them: nothing hidden, and no way up.
bool is_plain(std::string_view address) {
  if (address.find("//") != address.npos || address.find("/.") != address.npos) return false;
  return std::ranges::all_of(
      address, [](unsigned char c) { return std::isalnum(c) != 0 || c == '/' || c == '.' || c == '-' || c == '_'; });
}

/// A file of the tileset; `root` has no links.
std::optional<Served> file_at(const fs::path& root, std::string_view address) {
  if (!is_plain(address)) return std::nullopt;
  std::error_code fault;
  const auto path = fs::canonical(root / address.substr(1), fault);
  if (fault || path.lexically_relative(root).native().starts_with("..")) return std::nullopt;
  const auto type = type_of(path);
  if (type.empty() || !fs::is_regular_file(path, fault)) return std::nullopt;
  const auto size = fs::file_size(path, fault);
  if (fault || size > most_bytes) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  auto bytes = std::make_shared<std::string>(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (file.bad()) return std::nullopt;
  return Served{type, std::move(bytes)};
}

/// Whether it says what a tileset must (3D Tiles 1.1, 7.2).
bool is_tileset(const fs::path& path) {
  constexpr std::uint64_t most = 256 << 20;
  std::string why;
  const auto text = read_bytes(path.string(), most, why);
  JsonDocument document;
  if (!text || document.parse(*text)) return false;
  const Json set = document.root();
  return set["asset"]["version"].is_text() && set["root"].is_object();
}

/// A page next to the tileset, or elsewhere in the same site.
bool write_page(Session& s, const fs::path& folder) {
  const auto& output = s.flags().output;
  const auto from = output == "-" ? fs::path(folder) : fs::absolute(output).parent_path();
  std::error_code fault;
  const auto tileset = fs::relative(folder / file_name, from, fault).generic_string();
  auto file = OutputFile::open(output, {}, s.diag());
  if (!file) return false;
  file->write(*page_of(folder, tileset));
  return file->commit(s.diag());
}

}  // namespace

std::string tileset_folder(std::span<const std::string> inputs) {
  if (inputs.size() != 1) return {};
  const fs::path input(inputs[0]);
  std::error_code fault;
  if (fs::is_directory(input, fault)) return is_tileset(input / file_name) ? input.string() : std::string();
  if (input.filename() != file_name || !is_tileset(input)) return {};
  return input.has_parent_path() ? input.parent_path().string() : ".";
}

int view_tileset(Session& s, const std::string& folder) {
  if (!s.flags().output.empty() && !write_page(s, folder)) return s.end(false);
  const int code = s.end(true);
  if (!s.flags().serve) return code;
  std::error_code fault;
  const auto root = fs::canonical(folder, fault);
  const auto page = page_of(root, std::string(file_name));
  const auto site = [&](std::string_view address) {
    return address == "/" ? std::optional(Served{html_type, page}) : file_at(root, address);
  };
  fmt::print(stderr, "wrlkit view: --serve: {}\n", serve_site(site));
  return nothing;
}

}  // namespace wrlkit
