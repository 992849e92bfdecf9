// What LoadOptions do to a scene that was read: the passes `switch` and `place` for callers that run no pipeline.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "convert/options.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Runs `place`; nothing where that changes nothing.
void place_world(Scene& scene, Unit unit, UpAxis up);
/// Runs `switch{all=true}`.
void show_all(Scene& scene);
/// As passes `expand` and `startup` do.
void run_startup(Scene& scene, PassContext& ctx);

/// The options of `place` that differ from its defaults, as pipeline text has them; empty when none does.
std::vector<std::pair<std::string, std::string>> place_options(Unit unit, UpAxis up);

}  // namespace wrlkit
