#include "convert/bake.h"

#include "base/stop.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit {

Ending bake(Document& document, const LightmapOptions& options) {
  if (!document) return Ending::failed;
  auto& ctx = document.context();
  std::string why;
  const bool expanded = Pipeline::parse("lower-vrml1,expand,lower-x3d", why)->run(document.scene(), ctx);
  if (!expanded || ctx.stop.stop_requested()) return document.ending(false);
  const StopScope scope(ctx.stop);
  try {
    return document.ending(lightmap(document.scene(), options, ctx) != Outcome::failed);
  } catch (const Stopped&) {
    return document.ending(false);
  }
}

}  // namespace wrlkit
