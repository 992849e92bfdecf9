// Pass `lod`: its documentation is in its options.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"
#include "base/option_range.h"
#include "geometry/simplify/levels.h"
#include "geometry/tessellation.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

enum class LodScope : std::uint8_t { part, group, world };
template <>
inline constexpr auto choices<LodScope> = choice_row({{"part", "each Shape"},
                                                      {"group",
                                                       "the innermost groups of several Shapes, and each other Shape"},
                                                      {"world", "a tree of cells over the whole scene"}});

/// Shares of a whole, up to 1, with colons between them: 0.5:0.25:0.1.
struct NumberList {
  static constexpr std::string_view type = "shares a:b:c", examples = "0.5:0.25:0.1, or 50%:25%:10%";
  std::vector<double> values;

  bool read(std::string_view text);
  std::string print() const;
};

/// Lengths with colons between them: 1mm:5mm:2cm.
struct LengthList {
  static constexpr std::string_view type = "lengths a:b:c", examples = "1mm:5mm:2cm, or 0.001:0.005:0.02 in metres";
  std::vector<double> values;  // in metres

  bool read(std::string_view text);
  std::string print() const;
};

struct LodOptions {
  static constexpr std::string_view doc = R"(
Makes levels of detail. Each Shape that is large enough becomes a LOD node: the Shape is its first level, simplified
copies follow (Lazanyi, section 2; ISO/IEC 14772-1, 6.26).

    before   DEF Tank Shape { appearance Appearance { ... } geometry IndexedFaceSet { ... } }
    after    LOD { center 0 1 0 range [ 8.2, 31 ]
                   level [ DEF Tank Shape { appearance DEF A Appearance { ... } geometry IndexedFaceSet { ... } }
                           Shape { appearance USE A geometry IndexedFaceSet { ... } }  # half of its triangles
                           Shape { appearance USE A geometry IndexedFaceSet { ... } } ] }  # a tenth of them

Shapes in the bodies of prototypes get levels, too.

- Each level is made from the one before it, and its distance from the first is measured. A level is left out if it
  saves less than `min-saving`, or has no more than the twelve triangles of the bounding box.
- `center` is the middle of the bounds. `range` is the distance at which the error of the next level, on the near side
  of the bounding sphere, is `pixels` large: radius + error * screen-height / (2 tan(field-of-view / 2) pixels). Ranges
  ascend.
- VRML measures distances in the coordinates of the LOD (6.26). `range` and `center` are therefore in the coordinates of
  the geometry, whatever scale the Transforms above have. `errors` are metres of the world; if a geometry is used
  several times, they apply to its largest place.
- Open borders that several parts share stay as they are, so parts meet at every level.
- Shared Shapes and shared geometries are simplified once. All levels share the Appearance.
- Left unchanged: Shapes below an authored LOD; Shapes whose geometry is text, lines or points; geometry that a ROUTE or
  IS leads to; what Inlines show, which is reported; all other nodes. The Shape keeps its name; the LOD takes its place
  in the parent.

With `scope=group`, the innermost groups with several Shapes become LODs, and other Shapes get a LOD of their own. The
triangles of a level are shared out among all parts of the scene by measured distance (docs/plants.md), and small parts
disappear. Text counts as a part, whose further levels are faces. A further level is an unnamed copy of the group; it copies only what differs and shares the rest with the
first. Viewpoints and other bindable nodes are in the first level only. A group that a ROUTE reaches is not copied: the
groups and Shapes below it get LODs of their own.

    before   DEF Pump Group { children [ DEF Body Shape { ... } DEF Bolts Group { ... } ] }
    after    LOD { level [ DEF Pump Group { children [ DEF Body Shape { ... } DEF Bolts Group { ... } ] }
                           Group { children [ Shape { ... } ] } ] }   # the body with a tenth of its triangles

With `scope=world`, space is divided into cells of at most `cell-triangles`. Cells are combined into larger ones, up to
a single cell: a tree of LODs (HLOD), which becomes the last root of the scene. Close up, a cell shows the contents of
the file. Its further levels are one mesh for each appearance, whose parts keep their names (feature ids in glTF with
`--names table`). `ratios` apply to the smallest cells. A larger cell has one level, with at most `cell-triangles`, and
at most a third of the triangles of the levels that it replaces.

    before   DEF Unit Transform { children [ DEF A Shape { ... } DEF B Shape { ... } DEF C Shape { ... } ] }
    after    LOD { level [ Group { children [
                             LOD { level [ DEF Unit Transform { children [ DEF A Shape { ... } DEF B Shape { ... } ] }
                                           Shape { ... } ] }          # A and B as one mesh
                             LOD { level [ DEF Unit Transform { children DEF C Shape { ... } } Shape { ... } ] } ] }
                           Shape { ... } ] }                          # all as one mesh

A Group or Transform with children in several cells is split into several nodes with the same name. Outside the cells
stay: nodes that may move (by a ROUTE or Script, or in a prototype instance), Anchors, Billboards, a Collision that is
off or has a proxy, lights, Viewpoints and the like.

Polygons that merely touch have no common edges: run `weld` first. Cost: O(n log n) in the triangles, parallel over the
geometries. The result is the same for any number of threads.)";
  static constexpr StatisticInfo statistics[] = {
      {"lod.shapes", "Shapes that got levels"},
      {"lod.levels", "levels after the first"},
      {"lod.triangles", "triangles in these levels"},
      {"lod.groups", "groups or cells that got levels"},
      {"lod.too-small", "Shapes, groups and cells that did not change"},
  };

  LodScope scope = LodScope::part;
  int cell_triangles = 50'000;
  NumberList ratios{{0.5, 0.25, 0.1}};
  LengthList errors;
  CriterionName criterion;
  double pixels = 1, screen_height = 1080, field_of_view = 0.785398;
  double vanish = 0, min_saving = 0.3;
  int min_faces = 50;
  Tessellation faces{.texcoords = true};

  void fields(auto&& f) {
    f("scope", scope, "what gets a LOD");
    f("ratios", ratios,
      "triangles of each further level, as shares of the first; with scope=group and world, of all triangles drawn");
    f("cell-triangles", cell_triangles, "with scope=world: maximum number of triangles of a cell", at_least(1));
    f("errors", errors, "instead of ratios: maximum distance of each further level from the first");
    f("criterion", criterion, CriterionName::help());
    f("pixels", pixels, "error on the screen, in pixels, at which a level is shown", at_least(0.001));
    f("screen-height", screen_height, "height of the screen, in pixels", at_least(1));
    f("field-of-view", field_of_view, "vertical field of view, in radians", between(0.001, 3.141));
    f("vanish", vanish,
      "size on the screen, in pixels, below which a part is not drawn, by an empty last level; 0: never", at_least(0));
    f("min-saving", min_saving, "share of the triangles of the previous level that a level must save", between(0, 1));
    f("min-faces", min_faces, "Shapes with fewer triangles stay unchanged", at_least(0));
    faces.fineness_fields(f);
  }
};

Outcome lod(Scene& scene, const LodOptions& options, PassContext& ctx);

}  // namespace wrlkit
