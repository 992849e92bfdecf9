// How the triangles of a world are shared out among its parts.
#include <catch2/catch.hpp>

#include <sstream>

#include "geometry/simplify/world_levels.h"
#include "test_world.h"

using namespace wrlkit;

TEST_CASE("allocation: what a step of many places leaves over goes to other parts", "[levels]") {
  std::ostringstream text;
  text << "Transform { translation 0 0 40 children Shape { geometry Sphere { } } }\n"
          "DEF Ball Transform { children Shape { geometry Sphere { } } }\n";
  for (int i = 1; i < 100; ++i) text << "Transform { translation " << 3 * i << " 0 0 children USE Ball }\n";
  TestWorld w(text.str());
  WorldSimplifyOptions options;
  options.counts = {9000, 5000, 3000, 1900};
  const WorldLevels levels(w.scene, options, w.ctx);
  REQUIRE(levels.points().size() == options.counts.size());
  double rms = 0;
  for (std::size_t i = 0; i < options.counts.size(); ++i) {
    const auto& p = levels.points()[i];
    CHECK(p.n_drawn <= options.counts[i]);
    CHECK(p.n_drawn > options.counts[i] - options.counts[i] / 50);
    CHECK(p.rms >= rms);
    rms = p.rms;
  }
}
