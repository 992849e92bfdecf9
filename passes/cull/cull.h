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
Leaves out what is too small to matter, or what nobody can ever see: bolts in an overview of a plant, the inner tubes
of a heat exchanger.

    before   Shape { geometry Box { size 9 9 9 } }   DEF Core Shape { geometry Sphere { } }
    after    Shape { geometry Box { size 9 9 9 } }     # cull{hidden=true}: the sphere was inside

Removes Shapes from the groups that hold them, if that goes for all places where they are shown.

- `smaller`: the extent is the longest diagonal of the box around a part, in the largest of its places. Shapes without
  a name that share points and stand in one frame are one part: a solid may be written as one Shape a face.
- `hidden`: rays go from points all over the part, evenly by area, in all directions. A part is seen when one reaches
  the outside, a Viewpoint or a walkway. What is left out was seen by none of them; a part behind a hole of a thousandth
  of its sky may be among it. Nothing hides behind what has transparency or a picture.
  Of forms that `recognise` found, caps go that face one another, where a pipe goes on or a flange meets another.
- Left alone: what a ROUTE, a Script, an IS or an instance of a prototype may change, with all below it; what stands
  below a LOD or Switch, or is held otherwise than by a group; lines and points, by `hidden`.

Groups stay, also empty ones: run `prune` behind it. What is left out is reported (culled), with the first names; `list`
gets all. The same result for any number of threads.)";
  static constexpr StatisticInfo statistics[] = {
      {"cull.small", "Shapes that were too small"},
      {"cull.hidden", "Shapes that were never seen"},
      {"cull.caps", "ends of pipes, elbows and flanges that stood against another"},
      {"cull.triangles", "triangles of all"},
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
