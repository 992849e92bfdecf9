#include "writers/x3d/x3d_profile.h"

#include <charconv>
#include <span>

#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

struct Component {
  std::string_view name;
  int level;
};

// ISO/IEC 19775-1, annexes B and E.
constexpr Component interchange[] = {{"Core", 1},          {"Time", 1},       {"Networking", 1},
                                     {"Grouping", 1},      {"Rendering", 3},  {"Shape", 1},
                                     {"Geometry3D", 2},    {"Lighting", 1},   {"Texturing", 2},
                                     {"Interpolation", 2}, {"Navigation", 1}, {"EnvironmentalEffects", 1}};
constexpr Component immersive[] = {{"Core", 2},
                                   {"Time", 1},
                                   {"Networking", 3},
                                   {"Grouping", 2},
                                   {"Rendering", 3},
                                   {"Shape", 2},
                                   {"Geometry3D", 4},
                                   {"Geometry2D", 1},
                                   {"Text", 1},
                                   {"Sound", 1},
                                   {"Lighting", 2},
                                   {"Texturing", 3},
                                   {"Interpolation", 2},
                                   {"PointingDeviceSensor", 1},
                                   {"KeyDeviceSensor", 2},
                                   {"EnvironmentalSensor", 2},
                                   {"Navigation", 2},
                                   {"EnvironmentalEffects", 2},
                                   {"Scripting", 1},
                                   {"EventUtilities", 1}};

using Levels = std::map<std::string_view, int>;

Levels beyond(const Levels& used, std::span<const Component> profile) {
  Levels out = used;
  for (const auto& c : profile)
    if (auto i = out.find(c.name); i != out.end() && i->second <= c.level) out.erase(i);
  return out;
}

}  // namespace

X3dProfile x3d_profile(const Scene& scene) {
  Levels used;
  if (scene.proto_count() > 0) used["Core"] = 2;
  for (NodeId n : all_nodes(scene)) {
    const auto& t = scene.type(n);
    const auto colon = t.component.find(':');
    if (colon == t.component.npos) continue;
    int level = 1;
    std::from_chars(t.component.data() + colon + 1, t.component.data() + t.component.size(), level);
    int& most = used[t.component.substr(0, colon)];
    most = std::max(most, level);
  }
  if (beyond(used, interchange).empty()) return {"Interchange", {}};
  return {"Immersive", beyond(used, immersive)};
}

}  // namespace wrlkit
