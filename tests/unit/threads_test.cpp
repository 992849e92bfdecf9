// What is read on several threads is what one thread reads, messages included.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "base/parallel.h"
#include "convert/meshes_ahead.h"
#include "convert/wrlkit.h"
#include "parsers/vrml/parser.h"
#include "scenegraph/nodes.h"
#include "scenegraph/verify.h"
#include "tests/unit/folders.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;

namespace {

namespace fs = std::filesystem;

struct Read {
  std::string text, messages;
  bool operator==(const Read&) const = default;
};

Read result(const Scene& scene, const Diagnostics& diag) {
  Read out;
  Diagnostics quiet;
  write_vrml(
      scene, {}, [&](std::string_view s) { out.text += s; }, quiet);
  for (const auto& m : diag.messages()) out.messages += std::to_string(m.where.begin) + ": " + m.text() + '\n';
  for (const auto s : {Severity::note, Severity::lost, Severity::warning, Severity::error})
    out.messages += std::to_string(diag.count(s)) + ' ';
  return out;
}

Read read(const std::string& text, int threads) {
  const ThreadLimit limit(threads);
  Scene scene;
  Diagnostics diag;
  vrml::parse(text, 0, {}, scene, diag);
  return result(scene, diag);
}

std::string points(int n, int seed) {
  std::string out;
  for (int i = 0; i < n; ++i)
    out += std::to_string((i * 7919 + seed) % 2000 - 1000) + '.' + std::to_string(i % 1000) + " -0.5 1e-3,\n";
  return out;
}

std::string face_set(const std::string& name, const std::string& point, const std::string& more = "") {
  std::string index;
  for (int i = 0; i < 3000; ++i) index += std::to_string(i) + ", " + std::to_string(i / 2) + " 0 -1\n";
  return "DEF " + name + " Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + point + more +
         " ] } coordIndex [ " + index + " ] } }\n";
}

/// Two MB, with something else in the middle.
std::string world(const std::string& middle) {
  std::string out = "#VRML V2.0 utf8\n";
  for (int i = 0; i < 40; ++i) {
    if (i == 20) out += middle;
    out += face_set("Part" + std::to_string(i), points(1000, i));
  }
  return out;
}

void check_world(const std::string& middle) {
  const auto text = world(middle);
  const auto alone = read(text, 1);
  CHECK(read(text, 2) == alone);
  CHECK(read(text, 8) == alone);
}

/// Whether threads can read it to the end.
bool is_plain(const std::string& middle) {
  Scene scene;
  Diagnostics diag;
  return vrml::parse_on_threads(world(middle), 0, {}, scene, diag);
}

}  // namespace

TEST_CASE("Threads: plain lists of numbers are read", "[threads]") {
  const std::string middles[] = {"",
                                 face_set("Long", points(100'000, 1)),  // in pieces
                                 face_set("Exact", points(40, 1),
                                          "1.5e300 -0 12345678901234567890 .5 5. +7 0.1234567890123456789 00012 -.25 "
                                          "123456789.123456789 1234567.12345678 12345678.1234567 0x10 3 4"),
                                 face_set("Twice", points(50, 1)) + "DEF D Coordinate { point [ " + points(50, 2) +
                                     "] point [ " + points(40, 3) + "] point [ 1 2 3 ] }\n",
                                 "PROTO P [ field MFVec3f p [ " + points(50, 1) +
                                     "] ] { Shape { geometry PointSet { coord Coordinate { point IS "
                                     "p } } } }\nP { p [ " +
                                     points(50, 2) + "] }\n",
                                 "Script { field MFFloat f [ " + points(60, 1) + "] url \"javascript:\" }\n",
                                 "Unknown { point [ " + points(60, 1) + "] }\n",
                                 "Coordinate { point [ " + std::string(100, ' ') + "] }\n"};
  for (const auto& middle : middles) {
    INFO(middle.substr(0, 200));
    CHECK(is_plain(middle));
    check_world(middle);
  }
}

TEST_CASE("Threads: lists that are repeated share an array", "[threads]") {
  const auto list = points(40, 1), blanks = std::string(100, ' ');
  const auto cut = list.substr(0, list.size() - 6);  // one number less
  const std::string text = "#VRML V2.0 utf8\n" + world("").substr(16) + "DEF A Coordinate { point [ " + list +
                           " ] }\n" + "DEF B Normal { vector [ " + list + " ] }\n" +
                           "DEF C OrientationInterpolator { key [ " + list + " ] keyValue [ " + list + " ] }\n" +
                           "DEF D Coordinate { point [ " + cut + " ] }\n" + "DEF E Coordinate { point [ " + blanks +
                           " ] }\nDEF F Coordinate { point [ " + blanks + " ] }\n" +
                           "DEF G IndexedFaceSet { coordIndex [ " + blanks + " ] }\n";
  const auto named = [](const Scene& scene, std::string_view name) {
    for (const NodeId n : scene.main.roots)
      if (scene.name(n) == name) return scene.fields(n)[0];
    FAIL(name);
    return Value();
  };
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Scene scene;
    Diagnostics diag;
    vrml::parse(text, 0, {}, scene, diag);
    INFO(threads);
    const auto a = named(scene, "A"), b = named(scene, "B"), c = named(scene, "C"), d = named(scene, "D");
    CHECK(a.count == 40);
    CHECK(b.type == FieldType::MFVec3f);
    CHECK(b.numbers == a.numbers);
    CHECK(c.type == FieldType::MFFloat);
    CHECK(c.count == 120);
    CHECK(c.numbers == a.numbers);
    CHECK(d.count == 39);
    CHECK(named(scene, "E").count == 0);
    CHECK(named(scene, "F").count == 0);
    CHECK(named(scene, "G").count == 0);
  }
}

TEST_CASE("Lists that need repair are reported each time", "[threads]") {
  const auto twice = [](const std::string& list) {
    const auto node = "Coordinate { point [ " + list + " ] }\n";
    return "#VRML V2.0 utf8\n" + node + node;
  };
  for (const auto& bad : {"1.2.3 0 0", "1 2", "one 2 3", "# ] \n1 2 3", "[ 1 2 3 ]"}) {
    INFO(bad);
    const auto list = points(60, 1) + bad;
    const auto once = read("#VRML V2.0 utf8\nCoordinate { point [ " + list + " ] }\n", 1);
    const auto again = read(twice(list), 1);
    const auto lines = [](const Read& r) { return std::ranges::count(r.messages, '\n'); };
    CHECK(lines(again) == 2 * lines(once));
  }
}

TEST_CASE("Threads: lists that break off or need repair give the messages of one thread", "[threads]") {
  const auto plain = points(60, 1);
  const std::string lists[] = {
      plain + "1.2.3 0 0", plain + "nan 1 2", plain + "1e999 0 0",    plain + "# not ] here\n1 2 3",
      plain + "1 2",       plain + "one 2 3", plain + "1.#QNAN 0 0",  plain + "{ } 1 2 3",
      plain + "\"1\" 2 3", plain + "- 1 2",   plain + "[ 1 2 3 ] 4 5"};
  for (const auto& list : lists) {
    INFO(list.substr(plain.size()));
    CHECK_FALSE(is_plain("Coordinate { point [ " + list + " ] }\n"));
    check_world("Coordinate { point [ " + list + " ] }\n");
  }
  for (const std::string& tail : {"Coordinate { point [ " + plain, "Coordinate { point [ " + plain + "}\n",
                                  "Shape { geometry IndexedFaceSet { coordIndex [ " + plain + "] } }\n"}) {
    INFO(tail.substr(0, 40));
    CHECK_FALSE(is_plain(tail));
    check_world(tail);
  }
}

TEST_CASE("Threads: the text ends within a list", "[threads]") {
  const auto text = world("");
  for (const std::size_t cut : {3u, 100u, 5000u, 60'000u}) {
    INFO(cut);
    const auto part = text.substr(0, text.size() - cut);
    CHECK(read(part, 2) == read(part, 1));
  }
}

TEST_CASE("Threads: files of the corpus", "[threads]") {
  std::size_t n_plain = 0, n = 0;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / "corpus")) {
    if (entry.path().extension() != ".wrl") continue;
    INFO(entry.path());
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    Scene threads;
    Diagnostics diag;
    ++n;
    if (!vrml::parse_on_threads(text, 0, {}, threads, diag)) continue;
    ++n_plain;
    CHECK(result(threads, diag) == read(text, 1));
  }
  CHECK(n_plain * 2 > n);
}

namespace {

std::string glb(const std::string& text, Diagnostics* diag = nullptr) {
  const Document document = load_bytes(text, "test.wrl");
  REQUIRE(document);
  std::string out;
  REQUIRE(save(
      document, [&](std::string_view s) { out += s; }, ".glb"));
  if (diag) *diag = document.diag();
  return out;
}

std::string square(const std::string& name, const std::string& index, const std::string& more = "") {
  return "DEF " + name + " Shape { " + more + " geometry IndexedFaceSet { creaseAngle 1 coord Coordinate { point [ " +
         "0 0 0, 1 0 0, 1 1 0.25, 0 1 0 ] } coordIndex [ " + index + " ] } }\n";
}

}  // namespace

TEST_CASE("Geometry that is written again has the data of the first", "[gltf]") {
  const std::string header = "#VRML V2.0 utf8\n";
  const auto one = glb(header + square("A", "0 1 2 -1 0 2 3 -1"));
  const auto two = glb(header + square("A", "0 1 2 -1 0 2 3 -1") + square("B", "0 1 2 -1 0 2 3 -1"));
  // The second one is a node and a mesh in JSON; vertices are not written twice.
  const auto vertices = [](const std::string& s) { return s.substr(s.find(std::string("BIN\0", 4))); };
  CHECK(vertices(two) == vertices(one));
  CHECK(two.find("\"B\"") != two.npos);
}

TEST_CASE("Geometry that nearly says the same is its own", "[gltf]") {
  const std::string header = "#VRML V2.0 utf8\n", a = square("A", "0 1 2 -1 0 2 3 -1");
  CHECK(glb(header + a + square("B", "0 1 2 -1 0 3 2 -1")) != glb(header + a + square("B", "0 1 2 -1 0 2 3 -1")));
  // Minus zero is another number.
  const auto minus = [&] {
    auto b = square("B", "0 1 2 -1 0 2 3 -1");
    return b.replace(b.find("0 0 0"), 5, "0 -0 0");
  }();
  CHECK(glb(header + a + minus) != glb(header + a + square("B", "0 1 2 -1 0 2 3 -1")));
}

TEST_CASE("Every geometry that is at fault is reported, equal or not", "[gltf]") {
  Diagnostics diag;
  glb("#VRML V2.0 utf8\n" + square("A", "0 1 9 -1 0 2 3 -1") + square("B", "0 1 9 -1 0 2 3 -1"), &diag);
  CHECK(diag.count(Diag::bad_index) == 2);
}

namespace {

struct Converted {
  std::string bytes, messages;
  Statistics counts;
  bool operator==(const Converted&) const = default;
};

Converted convert(const std::string& text, const std::string& pipeline, int threads) {
  const ThreadLimit limit(threads);
  Document document = load_bytes(text, "test.wrl");
  Converted out;
  SaveOptions options;
  options.pipeline = pipeline;
  REQUIRE(save(
      document, [&](std::string_view s) { out.bytes += s; }, ".glb", options));
  out.messages = result({}, document.diag()).messages;
  out.counts = document.context().stats;
  return out;
}

std::string with(const std::string& shape, const std::string& appearance) {
  const std::string_view begin = "geometry ";
  std::string out = shape;
  return out.insert(out.find(begin), appearance + ' ');
}

/// Meshes of many kinds, again and again, a million indices in all.
std::string many_meshes() {
  const std::string texture = "appearance Appearance { texture PixelTexture { image 1 1 1 0xff } }";
  std::string out = "#VRML V2.0 utf8\n";
  for (int i = 0; i < 120; ++i) {
    const auto name = "Part" + std::to_string(i);
    auto part = face_set(name, points(3000 - i % 7, i % 11));  // where points are missing, faces are at fault
    if (i % 5 == 0) part = with(part, texture);
    if (i % 8 == 0) part = "Switch { choice [ " + part + " ] }\n";
    if (i % 9 == 0) part = "PROTO P" + name + " [ field SFBool s TRUE ] { " + part + " } P" + name + " { }\n";
    if (i % 10 == 0) part += "DEF Box" + std::to_string(i) + " Shape { geometry Box { } }\n";
    out += part;
  }
  return out + "DEF Again Transform { children [ USE Part3 USE Part20 ] }\n";
}

}  // namespace

TEST_CASE("Threads: meshes that are made ahead are those of one thread, and so is what is said of them", "[threads]") {
  const auto text = many_meshes();
  for (const std::string pipeline : {"gltf", "weld"}) {
    INFO(pipeline);
    const auto alone = convert(text, pipeline, 1);
    CHECK(alone.messages.find("out of range") != alone.messages.npos);
    CHECK(convert(text, pipeline, 2) == alone);
    CHECK(convert(text, pipeline, 8) == alone);
  }
}

TEST_CASE("Threads: meshes that nobody asks for are given up", "[threads]") {
  const ThreadLimit limit(4);
  Scene scene;
  Diagnostics diag;
  vrml::parse(many_meshes(), 0, {}, scene, diag);
  std::vector<NodeId> geometries;
  for (std::uint32_t n = 0; n < scene.node_count(); ++n)
    if (scene.is(NodeId{n}, nodes::IndexedFaceSet)) geometries.push_back(NodeId{n});
  const std::vector<char> textured(scene.node_count());
  const MeshMakers makers = [&](Task&) { return [&](NodeId n, Mesh& out) { out.corners.assign(100'000, n.value); }; };
  for (const std::size_t asked : {std::size_t{0}, std::size_t{1}, geometries.size() / 2, geometries.size() - 1}) {
    MeshesAhead ahead(scene, makers);
    ahead.begin(geometries, textured);
    for (const std::size_t i : {std::size_t{0}, asked}) {
      const auto* known = ahead.find(geometries[i]);
      REQUIRE(known);
      CHECK((known->same ? known->same : NodeId{known->mesh.corners.at(0)}).value <= geometries[i].value);
    }
  }
}

TEST_CASE("Threads: values of a large world are checked as on one thread", "[threads]") {
  const auto checked = [](const std::string& text, int threads) {
    const ThreadLimit limit(threads);
    Scene scene;
    Diagnostics diag;
    vrml::parse(text, 0, {}, scene, diag);
    check_values(scene, diag);
    return result(scene, diag);
  };
  for (const std::string middle : {"", "Shape { appearance Appearance { material Material { transparency 7 } } }\n"}) {
    std::string text = "#VRML V2.0 utf8\n";
    for (int i = 0; i < 60'000; ++i) {
      if (i == 40'000) text += middle;
      text += "Shape { appearance Appearance { } }\n";
    }
    const auto alone = checked(text, 1);
    CHECK((alone.messages == "0 0 0 0 ") == middle.empty());
    CHECK(checked(text, 4) == alone);
  }
}
