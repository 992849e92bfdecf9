#include "tools/verbs/render_options.h"

#include <numbers>
#include <string>

namespace wrlkit {

RenderOptions render_options(const Flags& f) {
  RenderOptions o;
  o.width = f.width;
  o.height = f.height;
  o.samples = f.samples;
  o.mode = f.mode;
  o.lamps = f.lamps;
  o.exposure.read(f.exposure);
  if (f.level == "auto")
    o.level.reset();
  else
    o.level = std::stoul(f.level);
  o.viewpoint = f.viewpoint;
  o.fit = f.fit;
  o.field_of_view = f.field_of_view * std::numbers::pi / 180;
  if (f.background.size() == 3) o.background = Vec3{f.background[0], f.background[1], f.background[2]};
  if (f.headlight != Headlight::automatic) o.headlight = f.headlight == Headlight::on;
  if (const auto& l = f.look_at; l.size() == 9)
    o.look_at = LookAt{{l[0], l[1], l[2]}, {l[3], l[4], l[5]}, {l[6], l[7], l[8]}};
  return o;
}

}  // namespace wrlkit
