// wrlkit render --compare: two scenes from one place, and how their pictures differ.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/text/json.h"
#include "tools/report/picture_grid.h"
#include "tools/verbs/render_sheets.h"

namespace wrlkit {
namespace {

/// The difference of two pictures of one size, in levels of 0 to 255.
struct PictureDifference {
  double mean = 0;           // of all components of all pixels
  int largest = 0;           // of any component
  std::size_t n_pixels = 0;  // that are not the same
  Image picture;             // the largest of the components, through a square root: 1 is seen, too
};

PictureDifference difference(const Image& a, const Image& b) {
  PictureDifference d{.picture = plain_picture(a.width, a.height, 0)};
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
    int most = 0;
    for (std::size_t c = i; c < i + 3; ++c) {
      const int apart = std::abs(a.pixels[c] - b.pixels[c]);
      sum += static_cast<std::uint64_t>(apart);
      most = std::max(most, apart);
    }
    std::fill_n(d.picture.pixels.begin() + static_cast<std::ptrdiff_t>(i), 3,
                static_cast<std::uint8_t>(std::lround(std::sqrt(most * 255.0))));
    d.largest = std::max(d.largest, most);
    d.n_pixels += most > 0;
  }
  d.mean = static_cast<double>(sum) / static_cast<double>(a.pixels.size());
  return d;
}

std::string figures_json(const PictureDifference& d) {
  return json_of(json_object("mean", d.mean, "largest", d.largest, "pixels", d.n_pixels, "of_pixels",
                             d.picture.pixels.size() / 3));
}

std::string figures_text(const PictureDifference& d) {
  return fmt::format("difference: mean {:.4g}, largest {} of 255", d.mean, d.largest);
}

std::string name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

bool render_comparison(Session& s) {
  const Flags& f = s.flags();
  RenderOptions options = render_options(f);
  Image first, second;
  {
    const auto meshes = open_world(s, f.inputs[0]);
    if (!meshes) return false;
    options = with_camera(s.world().scene, meshes, options, s.diag());
    first = draw(s, meshes, options, "first picture");
  }
  {
    const auto meshes = open_world(s, f.compare);
    if (!meshes) return false;
    second = draw(s, meshes, options, "second picture");
  }
  auto d = difference(first, second);
  const std::string figures = figures_json(d), text = figures_text(d);
  const std::size_t n_all = d.picture.pixels.size() / 3;
  const Image grid = picture_grid(
      {{name_of(f.inputs[0]), std::move(first)}, {name_of(f.compare), std::move(second)}, {text, std::move(d.picture)}},
      3);
  if (!write_picture(s, grid, f.output)) return false;
  s.fact("difference", figures);
  s.progress().clear();
  if (f.output == "-") return true;
  if (f.json)
    s.print_json(figures);
  else
    fmt::print("{}, {} of {} pixels\n", text, d.n_pixels, n_all);
  return true;
}

}  // namespace wrlkit
