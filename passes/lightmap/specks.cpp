#include "passes/lightmap/specks.h"

namespace wrlkit::bake {

std::uint64_t count_specks(const Page& page, const std::vector<Rgb>& light) {
  constexpr int amid = 7;           // of eight neighbours
  constexpr float unseen = 0.004f;  // in a display-referred picture less than 14 of 255, in the dark
  std::uint64_t n = 0;
  for (int y = 1; y + 1 < page.height; ++y)
    for (int x = 1; x + 1 < page.width; ++x) {
      const std::size_t i = page.at(x, y);
      if (!page.covered(i)) continue;
      const float own = luminance(light[i]);
      int n_bright = 0;
      for (int k = 0; k < 9; ++k) {
        const std::size_t j = page.at(x + k % 3 - 1, y + k / 3 - 1);
        n_bright += page.places[j].chart == page.places[i].chart && luminance(light[j]) > 2 * own + unseen;
      }
      n += n_bright >= amid;
    }
  return n;
}

}  // namespace wrlkit::bake
