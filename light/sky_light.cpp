#include "light/sky_light.h"

#include <cstdio>

#include "light/world.h"

namespace wrlkit {
namespace {

bool is_black(const SkyLight& s) { return !(s.color[0] + s.color[1] + s.color[2] > 0); }

}  // namespace

bool SkyLight::read(std::string_view text) {
  background = text == "background";
  for (double& c : color) c = 0;
  if (background || text == "none") return true;
  char rest;
  const std::string all(text);
  return std::sscanf(all.c_str(), "%lf:%lf:%lf%c", &color[0], &color[1], &color[2], &rest) == 3 && color[0] >= 0 &&
         color[1] >= 0 && color[2] >= 0;
}

std::string SkyLight::print() const {
  if (background) return "background";
  if (is_black(*this)) return "none";
  char text[100];
  std::snprintf(text, sizeof text, "%.9g:%.9g:%.9g", color[0], color[1], color[2]);
  return text;
}

void set_sky(light::LightOptions& options, const SkyLight& sky) {
  using Sky = light::LightOptions::Sky;
  options.sky = sky.background ? Sky::background : is_black(sky) ? Sky::none : Sky::constant;
  options.sky_color = {sky.color[0], sky.color[1], sky.color[2]};
}

}  // namespace wrlkit
