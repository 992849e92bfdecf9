// verify finds each breach of an invariant, and none in what is sound.
#include "scenegraph/verify.h"

#include <catch2/catch.hpp>

#include "scenegraph/nodes.h"

using namespace wrlkit;

namespace {

struct Checked {
  Scene scene;
  NodeId group = scene.add(nodes::Group), other = scene.add(nodes::Group);

  Checked() {
    scene.main.roots = {group};
    hold(group, other);
  }
  void hold(NodeId parent, NodeId child) { scene.set(parent, nodes::group::children, std::vector<NodeId>{child}); }
  /// What verify says first; empty: nothing.
  std::string breach(Level level = Level::authored) {
    Diagnostics diag;
    const bool good = verify(scene, level, diag);
    REQUIRE(good == diag.messages().empty());
    return good ? "" : diag.messages()[0].text();
  }
};

}  // namespace

TEST_CASE("verify: what is sound", "[verify]") {
  Checked c;
  CHECK(c.breach().empty());
  const NodeId script = c.scene.add(nodes::Script);
  c.hold(c.other, script);
  c.scene.set_fields(script, {{c.scene.make_extra("self", c.scene.make(FieldType::SFNode, 0, c.group))}});
  CHECK(c.breach(Level::mesh).empty());
}

TEST_CASE("verify: NULL in a list of nodes is no breach", "[verify]") {
  Checked c;
  c.hold(c.other, NodeId{});
  CHECK(c.breach(Level::mesh).empty());
}

TEST_CASE("verify: breaches", "[verify]") {
  Checked c;
  const NodeId nowhere{99};
  SECTION("cycle") {
    c.hold(c.other, c.group);
    CHECK(c.breach() == "Group: a node that is below itself");
  }
  SECTION("itself") {
    c.hold(c.other, c.other);
    CHECK(c.breach() == "Group: a node that is below itself");
  }
  SECTION("two values of a field") {
    const auto one = c.scene.make(FieldType::SFVec3f, nodes::group::bboxSize.slot, std::array{1.0, 1.0, 1.0});
    c.scene.set_fields(c.other, {{one, one}});
    CHECK(c.breach() == "Group: two values of one field");
  }
  SECTION("child") {
    c.hold(c.other, nowhere);
    CHECK(c.breach() == "Group: a child that is not a node");
  }
  SECTION("root") {
    c.scene.main.roots.push_back(nowhere);
    CHECK(c.breach() == "a root that is not a node");
  }
  SECTION("route") {
    c.scene.main.routes.push_back({c.group, nowhere, "a", "b"});
    CHECK(c.breach() == "a ROUTE without its nodes or events");
  }
  SECTION("route without an event") {
    c.scene.main.routes.push_back({c.group, c.other, "a", ""});
    CHECK(c.breach() == "a ROUTE without its nodes or events");
  }
  SECTION("import") {
    c.scene.main.imports.push_back({c.group, "x", nowhere});
    CHECK(c.breach() == "an IMPORT without its nodes");
  }
  SECTION("export") {
    c.scene.main.exports.push_back({nowhere, "x"});
    CHECK(c.breach() == "an EXPORT without its node");
  }
  SECTION("prototype") {
    c.scene.main.protos.push_back(ProtoId{7});
    CHECK(c.breach() == "a declaration of a prototype that is not there");
  }
  SECTION("geometry") {
    c.hold(c.other, c.scene.add(nodes::Box));
    CHECK(c.breach().empty());
    CHECK(c.breach(Level::mesh) == "Box: geometry that is no mesh");
  }
}
