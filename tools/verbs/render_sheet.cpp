// wrlkit render A B C sheet.png: a contact sheet.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text/json.h"
#include "tools/cli/documents.h"
#include "tools/cli/inputs.h"
#include "tools/report/picture_grid.h"
#include "tools/verbs/render_sheets.h"

namespace wrlkit {
namespace {

std::string contents_json(const std::vector<NamedWorld>& worlds, const std::vector<bool>& drawn) {
  std::string text;
  JsonOut json(text);
  json.begin_array();
  for (std::size_t i = 0; i < worlds.size(); ++i)
    json.object("file", worlds[i].path, "drawn", static_cast<bool>(drawn[i]));
  json.end_array();
  return text;
}

}  // namespace

bool is_sheet(const Flags& f) { return f.inputs.size() > 1 || means_many(f.inputs[0]); }

int render_sheet(Session& s) {
  const Flags& f = s.flags();
  std::string why;
  const auto named = named_worlds(f.inputs, why);
  if (!named) {
    complain("render", why);
    return nothing;
  }
  const auto& worlds = named->worlds;
  const int code = print_left_out("render", named->left_out, named->passed_over);
  RenderOptions options = render_options(f);
  if (!f.is_given("width")) options.width = 320;
  if (!f.is_given("height")) options.height = 240;
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(worlds.size()))));
  const GridSize size = grid_size(worlds.size(), columns, options.width, options.height);
  if (!image_size_fault(size.width, size.height, SIZE_MAX).empty()) {
    fmt::print(
        stderr,
        "wrlkit render: a sheet of {} by {} pixels is too large; make its pictures smaller (--width, --height)\n",
        size.width, size.height);
    return usage;
  }
  std::vector<NamedPicture> pictures;
  std::vector<bool> drawn;
  for (const auto& world : worlds) {
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
  const bool any = std::ranges::find(drawn, true) != drawn.end();
  const bool made = any && write_picture(s, picture_grid(pictures, columns), f.output);
  const auto contents = contents_json(worlds, drawn);
  s.fact("worlds", contents);
  if (made && f.json) s.print_json(contents);
  return s.end(made, nothing, code);
}

}  // namespace wrlkit
