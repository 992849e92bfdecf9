#include "passes/lightmap/darkness.h"

#include <map>

#include "passes/lightmap/page.h"

namespace wrlkit::bake {

std::vector<DarkUse> dark_uses(const PageLayout& page, std::span<const std::uint32_t> charts,
                               std::span<const Rgb> light) {
  constexpr float black = 1.5e-4f;  // linear; half a step of 8 bits
  struct Count {
    std::size_t texels = 0, lit = 0;
  };
  std::map<std::uint32_t, Count> count_of;
  std::vector<Count*> of_chart;
  for (std::size_t i = 0; i < page.triangles.size(); ++i) {
    const auto chart = page.triangles[i].chart;
    if (chart >= of_chart.size()) of_chart.resize(std::size_t{chart} + 1);
    of_chart[chart] = &count_of[page.refs[i].use];
  }
  for (std::size_t i = 0; i < charts.size(); ++i) {
    if (charts[i] == TexelPlace::nowhere) continue;
    ++of_chart[charts[i]]->texels;
    of_chart[charts[i]]->lit += luminance(light[i]) > black;
  }
  std::vector<DarkUse> out;
  for (const auto& [use, n] : count_of)
    if (n.texels && 100 * n.lit <= n.texels) out.push_back({use, n.texels});
  return out;
}

}  // namespace wrlkit::bake
