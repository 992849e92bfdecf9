// Nodes that are written like the one before them are what they are when they are read in full.
#include <catch2/catch.hpp>

#include "parsers/vrml/parser.h"
#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"

using namespace wrlkit;

namespace {

struct Read {
  Scene scene;
  Diagnostics diag;
};

Read read(const std::string& text, bool threads) {
  Read out;
  if (!threads || !vrml::parse_on_threads(text, 0, {}, out.scene, out.diag))
    vrml::parse(text, 0, {}, out.scene, out.diag);
  return out;
}

/// Every second node has a tab for its first blank: none is written like the one before it, and all are where they
/// were.
std::string without_patterns(std::vector<std::string> nodes) {
  std::string out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i % 2) nodes[i][nodes[i].find(' ')] = '\t';
    out += nodes[i] + "\n";
  }
  return out;
}

std::string messages(const Diagnostics& diag) {
  std::string out;
  for (const auto& m : diag.messages()) {
    out += std::to_string(m.where.begin) + ": " + m.text() + '\n';
  }
  return out;
}

void check_same(const Read& a, const Read& b) {
  CHECK(difference(a.scene, b.scene) == "");
  CHECK(messages(a.diag) == messages(b.diag));
  REQUIRE(a.scene.node_count() == b.scene.node_count());
  for (NodeId n{0}; n.value < a.scene.node_count(); ++n.value) {
    INFO("node " << n.value);
    CHECK(a.scene.type(n).name == b.scene.type(n).name);
    CHECK(a.scene.where(n).begin == b.scene.where(n).begin);
    CHECK(a.scene.fields(n).size() == b.scene.fields(n).size());
  }
}

/// As roots, and as children of a group.
void check(const std::vector<std::string>& nodes) {
  std::string plain;
  for (const auto& n : nodes) plain += n + "\n";
  const auto other = without_patterns(nodes);
  for (const bool threads : {false, true}) {
    check_same(read(plain, threads), read(other, threads));
    const std::string before = "DEF Outer Transform { children [\n", behind = "] }\n";
    check_same(read(before + plain + behind, threads), read(before + other + behind, threads));
  }
}

std::string point(int i, int n = 4) {
  std::string out = " ";
  for (int k = 0; k < 3 * n; ++k)
    out += std::to_string((i * 31 + k * 17) % 200 - 100) + ".125" + (k % 3 < 2 ? " " : ", ");
  return out;
}

std::string shape(const std::string& points, const std::string& look = "Appearance { }",
                  const std::string& index = " 0, 1, 2, 3, -1 ") {
  return "Shape { appearance " + look + " geometry IndexedFaceSet { coord Coordinate { point [" + points +
         "] } coordIndex [" + index + "] } }";
}

/// One node, with something else in the middle of many.
std::vector<std::string> among_shapes(const std::string& middle) {
  std::vector<std::string> out;
  for (int i = 0; i < 8; ++i) {
    if (i == 4) out.push_back(middle);
    out.push_back(shape(point(i % 3)));
  }
  return out;
}

}  // namespace

TEST_CASE("Nodes written alike: equal short lists are one array") {
  const auto r = read(shape(point(1)) + shape(point(2)) + shape(point(3)), false);
  REQUIRE(r.scene.main.roots.size() == 3);
  auto index = [&](std::size_t i) {
    const NodeId faces = r.scene.get(r.scene.main.roots[i], nodes::shape::geometry);
    return r.scene.get(faces, nodes::indexed_face_set::coordIndex).data();
  };
  CHECK(index(0) == index(1));
  CHECK(index(1) == index(2));
}

TEST_CASE("Nodes written alike: lists of all lengths") {
  std::vector<std::string> nodes;
  for (int i = 0; i < 12; ++i) nodes.push_back(shape(point(i, 1 + i % 5), "NULL", i % 4 ? " 0, 1, 2, -1 " : ""));
  check(nodes);
}

TEST_CASE("Nodes written alike: nodes in nodes, and lists without any") {
  std::vector<std::string> nodes;
  for (int i = 0; i < 6; ++i)
    nodes.push_back("Transform { translation 1 2 3 children [ " + shape(point(i)) + " Group { } " +
                    shape(point(i + 1)) + " ] }");
  check(nodes);
}

TEST_CASE("Nodes written alike: in one that is written alike itself, with long lists that are equal") {
  std::vector<std::string> nodes;
  const auto inner = shape(point(1, 6));
  for (int i = 0; i < 8; ++i)
    nodes.push_back("Transform { translation 1 2 3 children [ " + shape(point(i, 40)) + " " + inner + " " + inner +
                    " ] }");
  check(nodes);
}

TEST_CASE("Nodes written alike: a PROTO between them gives their words another meaning") {
  const std::string proto =
      "PROTO IndexedFaceSet [ field MFInt32 coordIndex [ ] field SFNode coord NULL ] { Box { } }\n";
  const auto a = shape(point(1)), b = shape(point(2)), c = shape(point(3));
  const auto read_again = read(a + b + proto + c, false), in_full = read(a + "\t" + b + proto + " " + c, false);
  const auto type_of_last = [](const Read& r) {
    return r.scene.type(r.scene.get(r.scene.main.roots.back(), nodes::shape::geometry)).kind;
  };
  CHECK(type_of_last(read_again) == NodeKind::proto);
  CHECK(type_of_last(in_full) == NodeKind::proto);
}

TEST_CASE("Nodes written alike: USE means the last of its name") {
  const std::string look = "DEF Look Appearance { material Material { transparency ";
  std::vector<std::string> nodes;
  for (int i = 0; i < 9; ++i)
    nodes.push_back(shape(point(i), i % 4 ? "USE Look" : look + "0." + std::to_string(i) + " } }"));
  check(nodes);
  check(among_shapes("Transform { children [ USE Outer ] }"));
  check({shape(point(1), "USE None"), shape(point(2), "USE None"), shape(point(3), "USE None")});
}

TEST_CASE("Nodes written alike: what has to be repaired is repaired and reported each time") {
  for (const std::string list : {" 1 2 3 nan ", " 1 2 3 4 ", " 1 2 3 # ] 4 5 6\n ", " 0x10 1 1 ", " 1 2 3 \"a\" 4 5 6 ",
                                 " 1 2 3 } ", " 1 2 [ 3 ] ", "", " 1,2,3", " 1e400 2 3 ", " USE X "}) {
    INFO("[" << list << "]");
    check({shape(point(1)), shape(point(2)), shape(list), shape(list), shape(point(3)), shape(point(4))});
  }
}

TEST_CASE("Nodes written alike: what is more than nodes and fields is read each time") {
  for (const auto& node : std::vector<std::string>{
           "DEF A " + shape(point(1)), "Group { ROUTE A.b TO C.d children [ " + shape(point(2)) + " ] }",
           "Script { field SFFloat x 1 field MFFloat list [ 1 2 3 4 5 ] }", "Other { list [ 1 2 3 ] node Shape { } }",
           "Group { PROTO P [ field MFFloat f [ 1 2 3 ] ] { Shape { } } children P { f [ 4 5 6 ] } }",
           "Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 ] coordIndex [ 0 1 2 ] more [ 1 2 ] } }"}) {
    check({node, node, node});
    auto nodes = among_shapes(node);
    nodes.push_back(node);
    check(nodes);
  }
}

TEST_CASE("Nodes written alike: in the body of a prototype") {
  const auto body = [](const std::string& nodes) {
    return "PROTO P [ field MFVec3f p [ ] ] { Group { children [ " + nodes + " ] } }\nP { p [ 1 2 3 ] }\n";
  };
  const std::vector<std::string> nodes(
      4, "Shape { geometry PointSet { coord Coordinate { point IS p } color Color { color [ 1 0 0 ] } } }");
  check_same(read(body(nodes[0] + "\n" + nodes[1] + "\n" + nodes[2] + "\n" + nodes[3] + "\n"), false),
             read(body(without_patterns(nodes)), false));
}

TEST_CASE("Nodes written alike: the text ends within one") {
  const std::string whole = shape(point(1)) + "\n" + shape(point(2)) + "\n" + shape(point(3));
  for (std::size_t n = whole.size() / 2; n < whole.size(); n += 7) {
    auto other = without_patterns({shape(point(1)), shape(point(2)), shape(point(3))}).substr(0, n);
    check_same(read(whole.substr(0, n), false), read(other, false));
  }
}
