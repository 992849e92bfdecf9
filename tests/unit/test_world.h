// A world of VRML97 from a text without its header.
#pragma once
#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "parsers/parsers.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct TestWorld {
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  Scene scene;

  explicit TestWorld(const std::string& text) {
    auto world = parse_world("#VRML V2.0 utf8\n" + text, "test.wrl", {}, diag);
    REQUIRE(world);
    scene = std::move(world->scene);
  }
};

}  // namespace wrlkit
