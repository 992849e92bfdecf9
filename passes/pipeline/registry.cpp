// The whole list of passes. Adding one is a header, a source, a line here and a test. Programs may add some of their
// own.
#include <algorithm>
#include <map>

#include "passes/combine_lightmap/combine_lightmap.h"
#include "passes/cull/cull.h"
#include "passes/dedup/dedup.h"
#include "passes/expand_protos/expand_protos.h"
#include "passes/flatten/flatten.h"
#include "passes/inline/inline.h"
#include "passes/instance/instance.h"
#include "passes/join/join.h"
#include "passes/keep_colors/keep_colors.h"
#include "passes/lightmap/lightmap.h"
#include "passes/lod/lod.h"
#include "passes/lower_vrml1/lower_vrml1.h"
#include "passes/lower_x3d/lower_x3d.h"
#include "passes/merge/merge.h"
#include "passes/normals/normals.h"
#include "passes/pipeline/pass_info.h"
#include "passes/prune/prune.h"
#include "passes/smooth/smooth.h"
#include "passes/subdivide/subdivide.h"
#include "passes/tessellate/tessellate.h"
#include "passes/triangulate/triangulate.h"
#include "passes/weld/weld.h"

namespace wrlkit {
namespace {

constexpr PassInfo all_passes[] = {
    pass<lower_vrml1, LowerVrml1Options>("lower-vrml1", "turn a world of VRML 1.0 or Inventor into one of VRML97",
                                         Level::authored, Level::authored),
    pass<inline_worlds, InlineOptions>("inline", "put the worlds that Inline nodes name into this one", Level::authored,
                                       Level::authored),
    pass<expand_protos, ExpandProtosOptions>("expand-protos", "turn prototype instances into the nodes they stand for",
                                             Level::authored, Level::expanded),
    pass<keep_colors, KeepColorsOptions>(
        "keep-colors", "keep X3D 4.0 from multiplying pictures by colours that they take the place of", Level::authored,
        Level::authored),
    pass<lower_x3d, LowerX3dOptions>("lower-x3d", "turn nodes that only X3D has into those of VRML97", Level::authored,
                                     Level::authored),
    pass<prune, PruneOptions>("prune", "remove what has no effect", Level::authored, Level::authored),
    pass<join, JoinOptions>("join", "make one Shape of many that look the same", Level::authored, Level::authored),
    pass<dedup, DedupOptions>("dedup", "share what is written several times and says the same", Level::authored,
                              Level::authored),
    pass<instance, InstanceOptions>("instance", "share geometry that is the same but for a motion and a scale",
                                    Level::authored, Level::authored),
    pass<cull, CullOptions>("cull", "leave out what is small, or never seen", Level::expanded, Level::expanded),
    pass<merge, MergeOptions>("merge", "few Shapes of many, each part still known by its name", Level::expanded,
                              Level::expanded),
    pass<flatten, FlattenOptions>("flatten", "multiply transformations that never change into the points",
                                  Level::expanded, Level::expanded),
    pass<tessellate, TessellateOptions>("tessellate", "turn every geometry node into faces, and faces into triangles",
                                        Level::expanded, Level::mesh),
    pass<weld, WeldOptions>("weld", "join equal points, so that faces share them, and repair how faces meet",
                            Level::authored, Level::authored),
    pass<smooth, SmoothOptions>("smooth", "move points to the mean of their neighbours", Level::authored,
                                Level::authored),
    pass<subdivide, SubdivideOptions>("subdivide", "make smooth surfaces of coarse polygons", Level::authored,
                                      Level::authored),
    pass<lod, LodOptions>("lod", "make levels of detail of each Shape", Level::authored, Level::authored),
    pass<lightmap, LightmapOptions>("lightmap", "compute light and put it onto the surfaces as textures",
                                    Level::expanded, Level::expanded),
    pass<combine_lightmap, CombineLightmapOptions>("combine-lightmap",
                                                   "make one texture of a surface's own colour and its baked light",
                                                   Level::authored, Level::authored),
    pass<normals, NormalsOptions>("normals", "compute normals by creaseAngle where the file gives none", Level::mesh,
                                  Level::mesh),
    pass<triangulate, TriangulateOptions>("triangulate", "cut polygons into triangles", Level::mesh, Level::mesh),
};

// A prototype may hold Inlines, and an inlined world instances of prototypes: both are looked for twice.
#define WRLKIT_GLTF_FRONT                                                                                            \
  "lower-vrml1,inline,expand-protos{keep-declarations=true},inline,expand-protos{keep-declarations=true},lower-x3d," \
  "prune,"
#define WRLKIT_GLTF_END "tessellate{triangles=false,texcoords=true},normals,triangulate"
constexpr NamedPipeline named[] = {
    {"gltf", WRLKIT_GLTF_FRONT "combine-lightmap," WRLKIT_GLTF_END, "what convert does for glTF"},
    {"gltf-emissive", WRLKIT_GLTF_FRONT "combine-lightmap{into=lightmap}," WRLKIT_GLTF_END,
     "the same for --lightmap-as emissive"},
    {"gltf-light", WRLKIT_GLTF_FRONT WRLKIT_GLTF_END, "the same for --lightmap-as occlusion, moz and extras"},
    {"vrml", "lower-vrml1,lower-x3d{vrml97=true,defer-colors=true},combine-lightmap,lower-x3d{vrml97=true}",
     "what convert and cat do for VRML97"},
    {"x3d", "lower-vrml1,combine-lightmap,keep-colors", "what convert does for X3D"},
    {"picture",
     "lower-vrml1,inline,expand-protos,inline,expand-protos,lower-x3d{materials=true},tessellate{triangles=false,"
     "texcoords=true},normals,triangulate",
     "what render does"},
    {"expand", "lower-vrml1,inline,expand-protos,inline,expand-protos", "everything in one world, without prototypes"},
    {"none", "", "nothing: the file as it is"},
};

/// Passes that a program brings itself, as the Python package does.
std::map<std::string, const PassInfo*, std::less<>>& added_by_name() {
  static std::map<std::string, const PassInfo*, std::less<>> added;
  return added;
}

}  // namespace

std::span<const PassInfo> passes() { return all_passes; }
std::span<const NamedPipeline> named_pipelines() { return named; }

const PassInfo* find_pass(std::string_view name) {
  if (auto i = std::ranges::find(all_passes, name, &PassInfo::name); i != std::end(all_passes)) return i;
  const auto added = added_by_name().find(name);
  return added == added_by_name().end() ? nullptr : added->second;
}

bool add_pass(const PassInfo& info) {
  if (std::ranges::find(all_passes, info.name, &PassInfo::name) != std::end(all_passes) ||
      std::ranges::find(named, info.name, &NamedPipeline::name) != std::end(named))
    return false;
  added_by_name().insert_or_assign(std::string(info.name), &info);
  return true;
}

std::vector<const PassInfo*> added_passes() {
  std::vector<const PassInfo*> out;
  for (const auto& [name, info] : added_by_name()) out.push_back(info);
  return out;
}

std::string pass_question(std::string_view name) {
  NearestName nearest(name);
  for (const auto& p : all_passes) nearest.consider(p.name);
  for (const auto* p : added_passes()) nearest.consider(p->name);
  return nearest.question();
}

}  // namespace wrlkit
