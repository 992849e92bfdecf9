// What shines from beyond the world, as options say it.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

namespace light {
struct LightOptions;
}

/// Its Background, nothing, or one radiance.
struct SkyLight {
  static constexpr std::string_view type = "background, none or r:g:b";
  bool background = true;
  double color[3] = {0, 0, 0};  // radiance, linear
  bool read(std::string_view text);
  std::string print() const;
};

void set_sky(light::LightOptions& options, const SkyLight& sky);

}  // namespace wrlkit
