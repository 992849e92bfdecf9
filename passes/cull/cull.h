// Pass `cull`: its documentation is in its options.
#pragma once
#include <string>

#include "base/option_range.h"
#include "geometry/tessellation.h"
#include "passes/pipeline/length_option.h"
#include "passes/pipeline/pass.h"
#include "passes/pipeline/written_file.h"

namespace wrlkit {

struct CullOptions {
  static constexpr std::string_view doc = R"(
Removes parts that are too small to matter, or that nobody can see: bolts in an overview of a plant, the inner tubes of
a heat exchanger.

    before   Shape { geometry Box { size 9 9 9 } }   DEF Core Shape { geometry Sphere { } }
    after    Shape { geometry Box { size 9 9 9 } }     # cull{hidden=true}: the sphere was inside

A Shape is removed from its groups only if the condition holds at every place where it is shown.

- `smaller` compares the diagonal of the part's bounding box, at its largest place. Unnamed Shapes that share points and
  a coordinate frame count as one part, because a solid may be written as one Shape per face.
- `hidden` sends rays in all directions from points spread evenly over the part. The part is visible if one ray reaches
  the outside, a Viewpoint or a walkway. A part that is visible only through a hole that covers a thousandth of its sky
  may be removed by mistake. Transparent parts and parts with pictures hide nothing. For forms that `recognise` found,
  caps that face one another are removed, as between two pipes or a pipe and a flange.
- Left unchanged: everything that a ROUTE, Script, IS or prototype instance may change, with all nodes below it;
  children of a LOD or Switch; Shapes that are not children of a group; and, for `hidden`, lines and points.

Groups stay even if they become empty: run `prune` afterwards. The first removed names are reported (culled); `list`
writes all of them to a file. The result is the same for any number of threads.)";
  static constexpr StatisticInfo statistics[] = {
      {"cull.small", "Shapes removed because they were too small"},
      {"cull.hidden", "Shapes removed because they were never visible"},
      {"cull.caps", "caps removed where pipes, elbows and flanges meet"},
      {"cull.triangles", "triangles removed"},
      {"cull.draws-before", "Shapes drawn before the pass"},
      {"cull.draws-after", "Shapes drawn after the pass"},
      {"cull.nodes-before", "nodes before the pass"},
      {"cull.nodes-after", "nodes after the pass"},
      {"cull.meshes-before", "geometry nodes drawn before the pass"},
      {"cull.meshes-after", "geometry nodes drawn after the pass"},
  };

  LengthOption smaller;
  bool hidden = false, walkways = true;
  int rays = 256;
  int seed = 1;
  Tessellation faces;
  WrittenFile list{.endings = WrittenFile::table};

  void fields(auto&& f) {
    f("smaller", smaller, "remove parts smaller than this: 20mm; plain numbers are metres");
    f("hidden", hidden, "remove parts that are visible neither from outside nor from a Viewpoint");
    f("walkways", walkways, "hidden: nor from any place where a visitor can stand");
    f("rays", rays, "hidden: rays per part; all must be blocked", at_least(1));
    f("seed", seed, "hidden: seed of the random numbers");
    faces.fineness_fields(f);
    f("list", list, "file for the names of removed parts, one per line");
  }
};

Outcome cull(Scene&, const CullOptions&, PassContext&);

}  // namespace wrlkit
