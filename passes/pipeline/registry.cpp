// The whole list of passes. Adding one is a header, a source, a line here and a test. Programs may add some of their
// own.
#include <algorithm>
#include <map>
#include <mutex>
#include <shared_mutex>

#include "passes/combine_lightmap/combine_lightmap.h"
#include "passes/cull/cull.h"
#include "passes/dedup/dedup.h"
#include "passes/expand/expand.h"
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
#include "passes/place/place.h"
#include "passes/prune/prune.h"
#include "passes/recognise/recognise.h"
#include "passes/sky/sky.h"
#include "passes/smooth/smooth.h"
#include "passes/startup/startup.h"
#include "passes/subdivide/subdivide.h"
#include "passes/switch/switch.h"
#include "passes/tessellate/tessellate.h"
#include "passes/triangulate/triangulate.h"
#include "passes/weld/weld.h"

namespace wrlkit {
namespace {

constexpr auto authored = Level::authored, expanded = Level::expanded;

constexpr PassInfo all_passes[] = {
    pass<place, PlaceOptions>("place", "scale the scene to metres and turn it Y up", authored, authored,
                              {.phase = Phase::start}),
    pass<switch_on, SwitchOptions>("switch", "set what Switch nodes show, by name", authored, authored,
                                   {.phase = Phase::gathered, .idempotent = true}),
    pass<lower_vrml1, LowerVrml1Options>("lower-vrml1", "convert VRML 1.0 and Inventor to VRML97", authored, authored,
                                         {.phase = Phase::start, .idempotent = true}),
    pass<expand, ExpandOptions>(
        "expand", "replace all Inlines and prototype instances by their contents, however nested", authored, expanded,
        {.phase = Phase::gather, .brings_in = true, .idempotent = true, .parts = "inline,expand-protos"}),
    pass<inline_worlds, InlineOptions>("inline", "replace Inline nodes by the files they name", authored, authored,
                                       {.phase = Phase::gather, .brings_in = true}),
    pass<expand_protos, ExpandProtosOptions>("expand-protos",
                                             "replace prototype instances by the nodes of the prototype", authored,
                                             expanded, {.phase = Phase::gather, .brings_in = true}),
    pass<startup, StartupOptions>("startup", "run what Scripts do when a browser loads the scene", expanded, expanded,
                                  {.phase = Phase::gathered}),
    pass<keep_colors, KeepColorsOptions>(
        "keep-colors", "keep X3D 4.0 from multiplying pictures by colours that they replaced in VRML97", authored,
        authored, {.phase = Phase::lower, .idempotent = true}),
    pass<lower_x3d, LowerX3dOptions>("lower-x3d", "convert nodes that only X3D has to those of VRML97", authored,
                                     authored, {.phase = Phase::lower, .idempotent = true}),
    pass<sky, SkyOptions>("sky", "turn the Background into Shapes, for glTF", authored, authored,
                          {.phase = Phase::light, .idempotent = true}),
    pass<prune, PruneOptions>("prune", "remove nodes without effect", authored, authored, {.idempotent = true}),
    pass<join, JoinOptions>("join", "join Shapes that look the same", authored, authored),
    pass<recognise, RecogniseFormsOptions>("recognise", "find cylinders, elbows, boxes and profiles in faces", authored,
                                           authored),
    pass<dedup, DedupOptions>("dedup", "share equal nodes", authored, authored, {.idempotent = true}),
    pass<instance, InstanceOptions>("instance", "share geometry that is equal except for position, rotation and scale",
                                    authored, authored),
    pass<cull, CullOptions>("cull", "remove parts that are small or never seen", expanded, expanded),
    pass<merge, MergeOptions>("merge", "merge Shapes to reduce draw calls; parts keep their names", expanded, expanded,
                              {.brings_in = true}),
    pass<flatten, FlattenOptions>("flatten", "apply constant transformations to the points", expanded, expanded),
    pass<tessellate, TessellateOptions>("tessellate", "convert geometry nodes to faces, and faces to triangles",
                                        authored, Level::mesh, {.phase = Phase::mesh, .idempotent = true},
                                        tessellate_doc, tessellate_statistics),
    pass<weld, WeldOptions>("weld", "join equal points and repair how faces meet", authored, authored),
    pass<smooth, SmoothOptions>("smooth", "move points towards the mean of their neighbours", authored, authored),
    pass<subdivide, SubdivideOptions>("subdivide", "subdivide coarse polygons to smooth surfaces", authored, authored),
    pass<lod, LodOptions>("lod", "make levels of detail", authored, authored),
    pass<lightmap, LightmapOptions>("lightmap", "compute light and bake it into textures", expanded, expanded),
    pass<combine_lightmap, CombineLightmapOptions>("combine-lightmap", "combine colour and baked light in one texture",
                                                   authored, authored, {.phase = Phase::light, .idempotent = true}),
    pass<normals, NormalsOptions>("normals", "compute missing normals from creaseAngle", authored, authored,
                                  {.phase = Phase::mesh, .idempotent = true}),
    pass<triangulate, TriangulateOptions>("triangulate", "triangulate polygons", authored, authored,
                                          {.phase = Phase::mesh, .idempotent = true}),
};

#define WRLKIT_GLTF_FRONT "lower-vrml1,expand{keep-declarations=true},lower-x3d,prune,"
#define WRLKIT_GLTF_END "tessellate{triangles=false,texcoords=true},normals,triangulate"
constexpr NamedPipeline named[] = {
    {"gltf", WRLKIT_GLTF_FRONT "combine-lightmap," WRLKIT_GLTF_END, "used by convert for glTF"},
    {"gltf-emissive", WRLKIT_GLTF_FRONT "combine-lightmap{into=lightmap}," WRLKIT_GLTF_END,
     "the same for --lightmap-as emissive"},
    {"gltf-light", WRLKIT_GLTF_FRONT WRLKIT_GLTF_END, "the same for --lightmap-as occlusion, moz and extras"},
    {"vrml", "lower-vrml1,lower-x3d{vrml97=true,defer-colors=true},combine-lightmap,lower-x3d{vrml97=true}",
     "used by convert and cat for VRML97"},
    {"x3d", "lower-vrml1,combine-lightmap,keep-colors", "used by convert for X3D"},
    {"picture",
     "lower-vrml1,expand,lower-x3d{materials=true},tessellate{triangles=false,"
     "texcoords=true},normals,triangulate",
     "used by render"},
    {"none", "", "no passes: the file as it is"},
};

/// Passes that a program brings itself, as the Python package does.
class AddedPasses {
 public:
  const PassInfo* find(std::string_view name) {
    const std::shared_lock lock(mutex_);
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
  }
  void add(std::shared_ptr<const PassInfo> info) {
    const std::unique_lock lock(mutex_);
    by_name_.insert_or_assign(std::string(info->name), info.get());
    all_.push_back(std::move(info));
  }
  std::vector<const PassInfo*> by_name() {
    const std::shared_lock lock(mutex_);
    std::vector<const PassInfo*> out;
    for (const auto& [name, info] : by_name_) out.push_back(info);
    return out;
  }

 private:
  std::shared_mutex mutex_;
  std::map<std::string, const PassInfo*, std::less<>> by_name_;
  std::vector<std::shared_ptr<const PassInfo>> all_;  // those that were replaced, too: pipelines may hold them
};

AddedPasses& added() {
  static auto& passes = *new AddedPasses;  // never destroyed: it may hold objects of an interpreter that has ended
  return passes;
}

}  // namespace

std::span<const PassInfo> passes() { return all_passes; }
std::span<const NamedPipeline> named_pipelines() { return named; }

const PassInfo* find_pass(std::string_view name) {
  if (auto i = std::ranges::find(all_passes, name, &PassInfo::name); i != std::end(all_passes)) return i;
  return added().find(name);
}

bool add_pass(std::shared_ptr<const PassInfo> info) {
  if (std::ranges::find(all_passes, info->name, &PassInfo::name) != std::end(all_passes) ||
      std::ranges::find(named, info->name, &NamedPipeline::name) != std::end(named))
    return false;
  added().add(std::move(info));
  return true;
}

bool add_pass(const PassInfo& info) { return add_pass(std::make_shared<const PassInfo>(info)); }

std::vector<const PassInfo*> added_passes() { return added().by_name(); }

std::string pass_question(std::string_view name) {
  NearestName nearest(name);
  for (const auto& p : all_passes) nearest.consider(p.name);
  for (const auto* p : added_passes()) nearest.consider(p->name);
  return nearest.question();
}

}  // namespace wrlkit
