#include "convert/placing.h"

#include "passes/expand/expand.h"
#include "passes/startup/startup.h"
#include "passes/switch/switch.h"

namespace wrlkit {

void place_world(Scene& scene, Unit unit, UpAxis up) {
  if (place_options(unit, up).empty()) return;
  Diagnostics silent;
  Statistics uncounted;
  PassContext ctx(silent, uncounted);
  place(scene, {.unit = unit, .up = up}, ctx);
}

void show_all(Scene& scene) {
  Diagnostics silent;
  Statistics uncounted;
  PassContext ctx(silent, uncounted);
  switch_on(scene, {.all = true, .choices = {}}, ctx);
}

void run_startup(Scene& scene, PassContext& ctx) {
  expand(scene, {}, ctx);
  startup(scene, {}, ctx);
}

std::vector<std::pair<std::string, std::string>> place_options(Unit unit, UpAxis up) {
  std::vector<std::pair<std::string, std::string>> out;
  if (unit != Unit{}) out.emplace_back("unit", name_of(unit));
  if (up != UpAxis{}) out.emplace_back("up", name_of(up));
  return out;
}

}  // namespace wrlkit
