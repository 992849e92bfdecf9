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

/// Numbers with colons between them: 0.5:0.25:0.1.
struct NumberList {
  static constexpr std::string_view type = "numbers a:b:c";
  std::vector<double> values;

  bool read(std::string_view text);
  std::string print() const;
};

struct LodOptions {
  static constexpr std::string_view doc = R"(
Levels of detail: each Shape that is worth it becomes a LOD node with the Shape as its first level and simplified ones
behind it (Lazanyi, section 2; ISO/IEC 14772-1, 6.26).

    before   DEF Tank Shape { appearance Appearance { ... } geometry IndexedFaceSet { ... } }
    after    LOD { center 0 1 0 range [ 8.2, 31 ]
                   level [ DEF Tank Shape { appearance DEF A Appearance { ... } geometry IndexedFaceSet { ... } }
                           Shape { appearance USE A geometry IndexedFaceSet { ... } }  # half of its triangles
                           Shape { appearance USE A geometry IndexedFaceSet { ... } } ] }  # a tenth of them

Makes levels of detail of the Shapes of a scene, in the bodies of prototypes too.

- Each level is made from the one before it, and how far it is from the first is measured. A level that saves less
  than `min-saving` is not written, nor one that is smaller than the bounding box that could stand for it: twelve
  triangles.
- `center` is the middle of the bounds. A `range` is the distance from which on the error of the next level, seen at
  the near side of the bounding sphere, is below `pixels`: radius + error * screen-height / (2 tan(field-of-view / 2)
  pixels). Ranges ascend.
- Distances of VRML are in the coordinates of the LOD (6.26), so `range` and `center` are in those of the geometry,
  however large the Transforms above show it. `errors` are metres of the world: where a geometry stands several times,
  in the largest of its places.
- What open borders of several parts have in common stays where it is, so that parts meet at any of their levels.
- A Shape that is shared is simplified once, and so is a geometry that several Shapes share. The levels share the
  Appearance.
- Left alone: Shapes below an authored LOD; those whose geometry is text, lines, points, the end of a ROUTE or an IS;
  and everything else in the world. The Shape keeps its name; a parent holds the LOD in its place.

With `scope=group` the innermost groups that hold several Shapes become LODs, and other Shapes by themselves. The
triangles of a level are shared out among all parts of the world by what is nearest to it (docs/plants.md), and small
parts leave. A further level is a copy of the group without names, of what differs in it, and shares the rest with the
first; Viewpoints and other bound nodes are in the first alone. Groups that a ROUTE reaches are not copied: what lies
below them has LODs of its own.

    before   DEF Pump Group { children [ DEF Body Shape { ... } DEF Bolts Group { ... } ] }
    after    LOD { level [ DEF Pump Group { children [ DEF Body Shape { ... } DEF Bolts Group { ... } ] }
                           Group { children [ Shape { ... } ] } ] }   # the body with a tenth of its triangles

With `scope=world` the world is cut in space into cells of at most `cell-triangles`, which are put together to larger
ones up to a single one: a tree of LODs, the last root of the world (HLOD). From nearby a cell is what the file has; its
further levels are one mesh for each look, whose parts keep their names (feature ids in glTF with `--names table`).
`ratios` are those of the smallest cells; a larger cell has one level, of at most `cell-triangles`, and of at most a third
of the triangles of the levels that it stands for.

    before   DEF Unit Transform { children [ DEF A Shape { ... } DEF B Shape { ... } DEF C Shape { ... } ] }
    after    LOD { level [ Group { children [
                             LOD { level [ DEF Unit Transform { children [ DEF A Shape { ... } DEF B Shape { ... } ] }
                                           Shape { ... } ] }          # A and B as one mesh
                             LOD { level [ DEF Unit Transform { children DEF C Shape { ... } } Shape { ... } ] } ] }
                           Shape { ... } ] }                          # all as one mesh

A Group or Transform whose children are in several cells comes in several parts, each with its name. What may move (by a
ROUTE or a Script, or in an instance of a prototype), Anchors, Billboards, a Collision that is off or has a proxy,
lights, Viewpoints and the like stay outside of the cells.

Polygons that only touch have no common edges: run `weld` before. O(n log n) in the triangles, parallel over the
geometries; the same result for any number of threads.)";
  static constexpr StatisticInfo statistics[] = {
      {"lod.shapes", "Shapes that have levels"},
      {"lod.levels", "levels behind the first"},
      {"lod.triangles", "triangles of these"},
      {"lod.groups", "groups or cells that have levels"},
      {"lod.too-small", "Shapes, groups and cells that were left as they are"},
  };

  LodScope scope = LodScope::part;
  int cell_triangles = 50'000;
  NumberList ratios{{0.5, 0.25, 0.1}};
  NumberList errors;
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
    f("errors", errors, "instead of ratios: maximum distance of each further level from the first, in metres");
    f("criterion", criterion, CriterionName::help());
    f("pixels", pixels, "error on the screen, in pixels, at which a level is shown", at_least(0));
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
