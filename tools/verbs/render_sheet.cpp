// wrlkit render A B C sheet.png: a contact sheet.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/text/json.h"
#include "tools/corpus/inputs.h"
#include "tools/report/picture_grid.h"
#include "tools/verbs/render_sheets.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

struct Entry {
  std::string path, name;
};

/// More files than itself are meant.
bool is_many(const std::string& word) {
  std::error_code ec;
  return word.starts_with('@') || fs::is_directory(word, ec) ||
         (word.find_first_of("*?") != std::string::npos && !fs::exists(word, ec));
}

/// Files that are named stand as they are; one that is not there has its place, too.
std::optional<std::vector<Entry>> entries(const std::vector<std::string>& words, std::string& why) {
  std::vector<Entry> out;
  for (const auto& word : words) {
    if (!is_many(word)) {
      out.push_back({word, word == "-" ? "standard input" : fs::path(word).filename().string()});
      continue;
    }
    auto found = gather_inputs({word}, {}, why);
    if (!found) return std::nullopt;
    for (auto& file : found->files) out.push_back({file.path, file.inside});
  }
  if (out.empty()) {
    why = "there is no world in " + words[0];
    return std::nullopt;
  }
  return out;
}

bool given(const Flags& f, std::string_view name) {
  return std::ranges::any_of(f.given, [&](const auto& g) { return g.first == name; });
}

std::string contents_json(const std::vector<Entry>& worlds, const std::vector<bool>& drawn) {
  std::string text;
  JsonOut json(text);
  json.begin_array();
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    json.begin_object();
    json.member("file", worlds[i].path);
    json.member("drawn", static_cast<bool>(drawn[i]));
    json.end_object();
  }
  json.end_array();
  return text;
}

}  // namespace

bool is_sheet(const Flags& f) { return f.inputs.size() > 1 || is_many(f.inputs[0]); }

int render_sheet(Session& s) {
  const Flags& f = s.flags();
  std::string why;
  const auto worlds = entries(f.inputs, why);
  if (!worlds) {
    fmt::print(stderr, "wrlkit render: {}\n", why);
    return usage;
  }
  RenderOptions options = render_options(f);
  if (!given(f, "width")) options.width = 320;
  if (!given(f, "height")) options.height = 240;
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(worlds->size()))));
  const GridSize size = grid_size(worlds->size(), columns, options.width, options.height);
  if (!image_size_fault(size.width, size.height, SIZE_MAX).empty()) {
    fmt::print(
        stderr,
        "wrlkit render: a sheet of {} by {} pixels is too large; make its pictures smaller (--width, --height)\n",
        size.width, size.height);
    return usage;
  }
  std::vector<NamedPicture> pictures;
  std::vector<bool> drawn;
  for (const auto& world : *worlds) {
    const auto meshes = open_world(s, world.path);
    drawn.push_back(static_cast<bool>(meshes));
    pictures.push_back({world.name, meshes ? draw(s, meshes, options, world.name)
                                           : plain_picture(options.width, options.height, 225)});
    if (!meshes) {
      const int line = std::min(options.height, 32);
      put(pictures.back().picture, text_picture("cannot be read", options.width, line), 0, (options.height - line) / 2);
    }
  }
  s.progress().clear();
  const bool made = write_picture(s, picture_grid(pictures, columns), f.output);
  const auto contents = contents_json(*worlds, drawn);
  s.fact("worlds", contents);
  if (made && f.json && f.output != "-") fmt::print("{}\n", contents);
  return s.end(made);
}

}  // namespace wrlkit
