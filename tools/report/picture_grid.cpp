#include "tools/report/picture_grid.h"

#include <algorithm>
#include <cmath>

#include "light/render/render.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

constexpr int gap = 8;
constexpr double em = 0.62;    // of the height of a line
constexpr double used = 0.96;  // of its width

int line_height(int width, int height) { return std::clamp(std::min(width, height) / 9, 14, 48); }

/// A Text node in the middle of the plane z = 0, in a plane that is 1 high.
Scene text_scene(std::string_view text, double width) {
  using Strings = std::vector<std::string_view>;
  Scene scene;
  const NodeId shape = scene.add(nodes::Shape), appearance = scene.add(nodes::Appearance),
               material = scene.add(nodes::Material), words = scene.add(nodes::Text),
               style = scene.add(nodes::FontStyle);
  scene.set(material, nodes::material::emissiveColor, Vec3{0.1, 0.1, 0.1});
  scene.set(appearance, nodes::appearance::material, material);
  scene.set(style, nodes::font_style::family, Strings{"SANS"}, nodes::font_style::justify, Strings{"MIDDLE", "MIDDLE"},
            nodes::font_style::size, em);
  scene.set(words, nodes::text::string, Strings{text}, nodes::text::fontStyle, style, nodes::text::maxExtent,
            used * width);
  scene.set(shape, nodes::shape::appearance, appearance, nodes::shape::geometry, words);
  scene.main.roots = {shape};
  return scene;
}

}  // namespace

void put(Image& sheet, const Image& picture, int x, int y) {
  const auto row = static_cast<std::size_t>(picture.width) * 3;
  for (int i = 0; i < picture.height; ++i)
    std::copy_n(picture.pixels.data() + static_cast<std::size_t>(i) * row, row,
                sheet.pixels.data() + (static_cast<std::size_t>(y + i) * static_cast<std::size_t>(sheet.width) +
                                       static_cast<std::size_t>(x)) *
                                          3);
}

Image plain_picture(int width, int height, std::uint8_t grey) {
  return {width, height, 3,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, grey)};
}

Image text_picture(std::string_view text, int width, int height) {
  Diagnostics unheard;
  Statistics uncounted;
  PassContext ctx{unheard, uncounted};
  std::string why;
  auto pipeline = Pipeline::parse("picture", why);
  Scene scene = text_scene(text, static_cast<double>(width) / height);
  const auto meshes = pipeline->run_lazily(scene, ctx);
  if (!meshes) return plain_picture(width, height, 255);
  // The shorter side of the picture is so high at a distance of 10.
  const double shorter = std::min(1.0, static_cast<double>(width) / height);
  RenderOptions options{
      .width = width, .height = height, .look_at = LookAt{}, .background = Vec3{1, 1, 1}, .headlight = false};
  options.field_of_view = 2 * std::atan(shorter / 2 / 10);
  return render(scene, meshes, options, nullptr, unheard);
}

GridSize grid_size(std::size_t n, int columns, int width, int height) {
  const int rows = static_cast<int>((n + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns));
  return {columns, rows, gap + columns * (width + gap), gap + rows * (height + line_height(width, height) + gap)};
}

Image picture_grid(const std::vector<NamedPicture>& pictures, int columns) {
  const int width = pictures[0].picture.width, height = pictures[0].picture.height, line = line_height(width, height);
  const GridSize size = grid_size(pictures.size(), columns, width, height);
  Image grid = plain_picture(size.width, size.height, 255);
  int i = 0;
  for (const auto& p : pictures) {
    const int x = gap + i % columns * (width + gap), y = gap + i / columns * (height + line + gap);
    put(grid, p.picture, x, y);
    put(grid, text_picture(p.name, width, line), x, y + height);
    ++i;
  }
  return grid;
}

}  // namespace wrlkit
