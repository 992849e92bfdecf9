// The table itself: what the generator cannot see.
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <string>

#include "scenegraph/node_table.h"
#include "scenegraph/nodes.h"
#include "tests/unit/folders.h"

using namespace wrlkit;

TEST_CASE("node table: all 54 node types of VRML97, each once", "[node_table]") {
  std::set<std::string_view> names;
  for (auto& n : builtin_nodes())
    if (n.dialects & static_cast<DialectSet>(Dialect::vrml97)) CHECK(names.insert(n.name).second);
  CHECK(names.size() == 54);
}

TEST_CASE("node table: X3D's node types, each once, all of VRML97's among them", "[node_table]") {
  constexpr auto x3d = static_cast<DialectSet>(Dialect::x3d), vrml97 = static_cast<DialectSet>(Dialect::vrml97);
  std::set<std::string_view> names;
  for (auto& n : builtin_nodes()) {
    INFO(n.name);
    if (n.dialects & x3d) CHECK(names.insert(n.name).second);
    if (n.dialects & vrml97) CHECK(n.dialects & x3d);
    if (n.dialects & x3d) CHECK_FALSE(n.component.empty());
  }
  CHECK(names.size() == 262);
}

TEST_CASE("node table: defaults of X3D's own", "[node_table]") {
  auto& type = builtin_nodes()[nodes::NavigationInfo.value].fields[nodes::navigation_info::type.slot];
  CHECK(type.default_value.text_span()[0] == "WALK");
  CHECK(type.x3d_default_in(30).text_span()[0] == "EXAMINE");
  auto& beam = builtin_nodes()[nodes::SpotLight.value].fields[nodes::spot_light::beamWidth.slot];
  CHECK(beam.x3d_default_in(32).number == 1.570796);
  CHECK(beam.x3d_default_in(33).number == 0.589049);
  auto& cut_off = builtin_nodes()[nodes::SpotLight.value].fields[nodes::spot_light::cutOffAngle.slot];
  CHECK(cut_off.x3d_default_in(40).number == 1.570796);
}

TEST_CASE("node table: no field twice in a node, in any dialect", "[node_table]") {
  for (auto& n : builtin_nodes()) {
    std::set<std::string_view> names;
    std::set<std::string_view> x3d_names;
    for (auto& f : n.fields) {
      INFO(n.name << '.' << f.name);
      CHECK(names.insert(f.name_in(Dialect::vrml97)).second);
      CHECK(x3d_names.insert(f.name_in(Dialect::x3d)).second);
      CHECK_FALSE(f.doc.empty());
    }
  }
}

TEST_CASE("node table: defaults lie in their range and have their type", "[node_table]") {
  for (auto& n : builtin_nodes())
    for (std::size_t i = 0; i < n.fields.size(); ++i) {
      auto& f = n.fields[i];
      if (!f.has_value()) continue;
      INFO(n.name << '.' << f.name);
      CHECK(f.default_value.type == f.type);
      CHECK(f.default_value.slot == i);
      for (double v : f.default_value.number_span()) CHECK(f.range.contains(v));
      for (auto v : f.default_value.integer_span())
        if (info(f.type).element == Element::integer) CHECK(f.range.contains(v));
    }
}

TEST_CASE("node table: child kinds are node types or bases", "[node_table]") {
  std::set<std::string_view> known(builtin_bases().begin(), builtin_bases().end());
  for (auto& n : builtin_nodes()) known.insert(n.name);
  for (auto& n : builtin_nodes())
    for (auto& f : n.fields)
      if (info(f.type).element == Element::node)
        for (auto k : f.kinds) {
          INFO(n.name << '.' << f.name << ": " << k);
          CHECK(known.count(k) == 1);
        }
}

TEST_CASE("node table: every node has a world in the corpus", "[node_table]") {
  const auto corpus = source_folder() / "corpus";
  for (auto& n : builtin_nodes()) {
    INFO(n.name);
    if (n.dialects & static_cast<DialectSet>(Dialect::vrml97))
      CHECK(std::filesystem::exists(corpus / "nodes" / (std::string(n.name) + ".wrl")));
    if (n.dialects & static_cast<DialectSet>(Dialect::x3d))
      CHECK(std::filesystem::exists(corpus / "x3d" / (std::string(n.name) + ".x3d")));
    if (n.dialects == static_cast<DialectSet>(Dialect::vrml1))
      CHECK(std::filesystem::exists(corpus / "vrml1" / (std::string(n.name) + ".wrl")));
  }
}

TEST_CASE("node table: names by dialect, events of exposed fields", "[node_table]") {
  auto& lod = builtin_nodes()[nodes::LOD.value];
  CHECK(lod.find("level", Dialect::vrml97) == nodes::lod::children.slot);
  CHECK_FALSE(lod.find("children", Dialect::vrml97));
  auto& transform = builtin_nodes()[nodes::Transform.value];
  CHECK(transform.find("set_translation", Dialect::vrml97, true) == nodes::transform::translation.slot);
  CHECK(transform.find("translation_changed", Dialect::vrml97, true) == nodes::transform::translation.slot);
  CHECK_FALSE(transform.find("set_translation", Dialect::vrml97));
  CHECK_FALSE(transform.find("set_bboxSize", Dialect::vrml97, true));  // a field has no events
}
