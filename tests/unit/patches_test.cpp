// Patch files and patches: reading, writing, cutting.
#include "parsers/patches/patches.h"

#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "light/patches/patch_mesh.h"
#include "writers/patches/patches.h"

using namespace wrlkit;
using namespace wrlkit::light;

namespace {

std::string text_of(const PatchSet& set) {
  std::string text;
  write_patches(set, [&](std::string_view s) { text += s; });
  return text;
}

std::optional<PatchSet> read(std::string_view text, Diagnostics& diag) { return parse_patches(text, "test.xml", diag); }

const std::string_view example = R"(<?xml version="1.0" encoding="UTF-8"?>
<patches version="1" source="room.wrl" unit="m" method="path" samples="256">
  <shape name="Room/Wall" index="3">
    <triangle index="0" v="0 0 0 1 0 0 0 1 0">
      <patch v="0 0 0 0.5 0 0 0 0.5 0" rgb="0.12 0.11 0.1"/>
      <patch side="back" v="0 0 0 0.5 0 0 0 0.5 0" rgb="0 0 0"/>
    </triangle>
  </shape>
</patches>
)";

using Triangle = std::array<V3, 3>;

double area(const Triangle& t) { return 0.5 * length(cross(t[1] - t[0], t[2] - t[0])); }

/// The smallest angle, in degrees.
double sharpest(const Triangle& t) {
  double least = 180;
  for (int i = 0; i < 3; ++i) {
    const V3 a = unit(t[(i + 1) % 3] - t[i]), b = unit(t[(i + 2) % 3] - t[i]);
    least = std::min(least, std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * 180 / std::numbers::pi);
  }
  return least;
}

/// Neighbours have the edge between them in common, from corner to corner.
void require_conforming(const PatchMesh& mesh) {
  for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
    const auto& face = mesh.faces()[f];
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(face.corners[i], face.corners[(i + 1) % 3]);
      const auto n = face.neighbours[i];
      if (n == PatchMesh::none) continue;
      bool mutual = false;
      for (int k = 0; k < 3; ++k) {
        const auto other = std::minmax(mesh.faces()[n].corners[k], mesh.faces()[n].corners[(k + 1) % 3]);
        mutual |= mesh.faces()[n].neighbours[k] == f && other.first == low && other.second == high;
      }
      REQUIRE(mutual);
    }
  }
}

}  // namespace

TEST_CASE("a patch file is read and written again as it was") {
  Diagnostics diag;
  const auto set = read(example, diag);
  REQUIRE(set);
  CHECK(diag.messages().empty());
  CHECK(set->source == "room.wrl");
  CHECK(set->method == "path");
  CHECK(set->samples == 256);
  REQUIRE(set->shapes.size() == 1);
  CHECK(set->shapes[0].name == "Room/Wall");
  CHECK(set->shapes[0].index == 3);
  REQUIRE(set->triangles.size() == 1);
  CHECK(set->triangles[0].corners == Corners{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}});
  REQUIRE(set->patches_of(0).size() == 2);
  CHECK(set->patches[0].rgb == std::array<float, 3>{0.12f, 0.11f, 0.1f});
  CHECK(!set->patches[0].back);
  CHECK(set->patches[1].back);
  CHECK(text_of(*set) == example);
}

TEST_CASE("patches below the root or a shape, in other units, names with references") {
  Diagnostics diag;
  const auto set = read(
      "<patches unit='cm'><patch v='0 0 0, 100 0 0, 0 50 0' rgb='1 1 1'/><shape name='A&amp;&lt;&quot;&#65;'>"
      "<patch v='0 0 0 1 0 0 0 1 0' rgb='1 2 3'/></shape><patch v='0 0 0 1 0 0 0 1 0' rgb='1 2 3'/></patches>",
      diag);
  REQUIRE(set);
  CHECK(diag.messages().empty());
  REQUIRE(set->shapes.size() == 3);
  CHECK(set->shapes[1].name == "A&<\"A");
  CHECK(set->shapes[2].name.empty());
  REQUIRE(set->triangles.size() == 3);
  CHECK(!set->triangles[0].given);
  CHECK(set->patches[0].corners == Corners{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 0.5, 0}});
  Diagnostics again;
  const auto text = text_of(*set);
  CHECK(text_of(*read(text, again)) == text);
  CHECK(again.messages().empty());
}

TEST_CASE("what is wrong costs the patch it is in, and is told with its place") {
  Diagnostics diag;
  const auto set = read(
      "<patches>\n<shape name=\"a\">\n"
      "<patch v=\"0 0 0 1 0 0 0 1\" rgb=\"1 1 1\"/>\n"    // eight numbers
      "<patch v=\"0 0 0 1 0 0 0 1 0\" rgb=\"1 x 1\"/>\n"  // no number: one is there, the others are 0
      "<patch v=\"0 0 0 1 0 0 0 1 0\" rgb=\"1 1 1\" a='1'/>\n"
      "<patch v=\"0 0 0 1 0 0 0 1 0 rgb=\"1 1 1\"/>\n"     // a quote is missing
      "<patch v=\"0 0 0 1 0 0 0 1 0\" rgb=\"-1 nan 2\"\n"  // '>' is missing
      "<thing><patch/></thing>\n"
      "<patch v=\"0 0 0 1 0 0 0 1 0\" rgb=\"4 -5 6\"/>",
      diag);
  REQUIRE(set);
  REQUIRE(set->patches.size() == 4);
  CHECK(set->patches[0].rgb == std::array<float, 3>{1, 0, 0});
  CHECK(set->patches[2].rgb == std::array<float, 3>{0, 0, 2});
  CHECK(set->patches[3].rgb == std::array<float, 3>{4, 0, 6});
  std::map<std::string, std::size_t> lines;
  for (auto& m : diag.messages()) lines[info(m.id).name] = diag.sources().locate(m.where).line;
  CHECK(lines["bad-value"] == 4);
  CHECK(lines["unknown-attribute"] == 5);
  CHECK(lines["out-of-range"] == 9);
  CHECK(lines["unknown-element"] == 8);
  CHECK(lines["unclosed"] == 1);
  CHECK(diag.count(Diag::bad_patch) == 1);  // those of damaged tags were reported
  const auto column = diag.sources().locate(diag.messages()[0].where);
  CHECK(column.line == 3);
  CHECK(column.column == 11);
}

TEST_CASE("the digits of a file say how far its coordinates were rounded") {
  auto step = [](const std::string& v, double at, const std::string& unit = "m") {
    Diagnostics diag;
    return read("<patches unit='" + unit + "'><patch v='" + v + "' rgb='0.123456 1 1'/></patches>", diag)
        ->printed.step(at);
  };
  CHECK(step("12.345 0.300 0 1 0 0 0 1 0", 12) == Approx(1e-3));
  CHECK(step("12.345 0.300 0 1 0 0 0 1 0", 0.3) == Approx(1e-3));
  CHECK(step("12.3 0.0012 0 1 0 0 0 1 0", 12) == Approx(0.1));
  CHECK(step("12.3 0.0012 0 1 0 0 0 1 0", 0.3) == Approx(1e-3));
  CHECK(step("1.25e1 -2.5E-03 0 1 0 0 0 1 0", 12.5) == Approx(0.1));
  CHECK(step("1250 30 0 1 0 0 0 1 0", 1.25, "mm") == Approx(1e-3));
  CHECK(PatchSet().printed.step(100) < 1e-13);
}

TEST_CASE("entities are not expanded, document types are passed over") {
  Diagnostics diag;
  const auto set = read(
      "<!DOCTYPE patches [<!ENTITY a \"&b;&b;\"> <!ENTITY b \"]>\">]><!-- <patches> --><patches>"
      "<shape name='&a;'/><patch v='&a;' rgb='1 1 1'/></patches>",
      diag);
  REQUIRE(set);
  CHECK(diag.count(Diag::xml_doctype) == 1);
  CHECK(set->shapes[0].name == "&a;");
  CHECK(set->patches.empty());
}

TEST_CASE("other files are no patch files") {
  for (std::string_view text : {"", "   ", "#VRML V2.0 utf8", "<X3D/>", "<", "<>", "<!--", "<!DOCTYPE"}) {
    Diagnostics diag;
    CHECK(!read(text, diag));
    CHECK(diag.count(Diag::no_patches) == 1);
    CHECK(!is_patch_file(text));
  }
  CHECK(is_patch_file(example));
  CHECK(is_patch_file("\xef\xbb\xbf <?xml version='1.0'?><!-- > --><!DOCTYPE a [ > ]><patches>"));
}

TEST_CASE("files in other encodings") {
  Diagnostics diag;
  const auto latin =
      read("<?xml version='1.0' encoding='ISO-8859-1'?><patches source='K\xfchlung.wrl'><shape name='\xe4'/></patches>",
           diag);
  REQUIRE(latin);
  CHECK(latin->source == "K\xc3\xbchlung.wrl");
  CHECK(latin->shapes[0].name == "\xc3\xa4");
  CHECK(diag.count(Diag::encoding_repaired) == 2);
  std::string wide = "\xff\xfe";
  for (char c : example) {
    wide += c;
    wide += '\0';
  }
  CHECK(is_patch_file(wide));
  Diagnostics again;
  REQUIRE(read(wide, again));
  CHECK(again.count(Diag::encoding_repaired) == 1);
}

TEST_CASE("a tag of very many attributes takes no longer than many tags") {
  std::string text = "<patches><patch";
  for (int i = 0; i < 100'000; ++i) text += " a" + std::to_string(i) + "='1'";
  for (int i = 0; i < 100'000; ++i) text += " v='0 0 0 1 0 0 0 1 0'";
  Diagnostics diag;
  const auto set = read(text + " rgb='1 1 1'/></patches>", diag);
  REQUIRE(set);
  CHECK(set->patches.size() == 1);
  CHECK(diag.count(Diag::duplicate_field) == 99'999);
}

TEST_CASE("depth takes no memory and no stack") {
  std::string text = "<patches>";
  for (int i = 0; i < 200000; ++i) text += "<a>";
  Diagnostics diag;
  CHECK(read(text, diag));
}

TEST_CASE("a square is cut into patches that meet corner to corner") {
  const V3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
  PatchMesh mesh(std::vector<Triangle>{{a, b, c}, {a, c, d}});
  REQUIRE(mesh.split_to(0.1, 0, 1'000'000));
  require_conforming(mesh);
  double total = 0;
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    CHECK(mesh.longest(f) <= 0.1);
    CHECK(sharpest(mesh.corners(f)) == Approx(45));
    const auto t = mesh.corners(f);
    CHECK(cross(t[1] - t[0], t[2] - t[0]).z > 0);
    total += mesh.area(f);
  }
  CHECK(total == Approx(1));
  CHECK(mesh.faces().size() == 512);
}

TEST_CASE("needles become rounder, and no angle falls below half of the smallest") {
  const Triangle needle{V3{0, 0, 0}, V3{10, 0, 0}, V3{3, 0.1, 0}};
  PatchMesh mesh(std::vector<Triangle>{needle});
  REQUIRE(mesh.split_to(0, 0.01, 1'000'000));
  double widest = 0;
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    CHECK(mesh.area(f) <= 0.01);
    CHECK(sharpest(mesh.corners(f)) >= 0.5 * sharpest(needle));
    widest = std::max(widest, sharpest(mesh.corners(f)));
  }
  CHECK(widest > 10);
  CHECK(mesh.faces().size() < 200);
}

TEST_CASE("what is split here and there stays conforming, also where sheets lie back to back") {
  const V3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0}, e{0.2, 0.3, 1};
  for (const auto& triangles :
       {std::vector<Triangle>{{a, b, c}, {a, c, d}, {a, b, e}}, std::vector<Triangle>{{a, b, e}, {b, a, e}},
        std::vector<Triangle>{{a, b, e}, {a, b, e}},
        std::vector<Triangle>{{a, b, c}, {c, d, a}, {b, e, c}, {e, c, d}}}) {
    PatchMesh mesh(triangles);
    for (std::uint32_t i = 0; i < 500; ++i) mesh.split((i * 2654435761u) % mesh.faces().size());
    require_conforming(mesh);
    std::map<std::uint32_t, double> areas;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) areas[mesh.faces()[f].triangle] += mesh.area(f);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) CHECK(areas[t] == Approx(area(triangles[t])));
  }
}

TEST_CASE("triangles with two corners in one place stay whole") {
  const V3 a{0, 0, 0}, b{1, 0, 0}, c{0.5, 0, 0};
  for (const auto& triangles : {std::vector<Triangle>{{a, a, b}, {a, b, b}},
                                std::vector<Triangle>{{a, b, c}, {a, b, a}}, std::vector<Triangle>{{a, a, a}}}) {
    PatchMesh mesh(triangles);
    CHECK(mesh.split_to(0.1, 0, 10'000));
    CHECK(mesh.faces().size() < 100);
    require_conforming(mesh);
  }
}

TEST_CASE("splitting ends at the limit") {
  PatchMesh mesh(std::vector<Triangle>{{V3{0, 0, 0}, V3{1, 0, 0}, V3{0, 1, 0}}});
  CHECK(!mesh.split_to(1e-300, 0, 1000));
  CHECK(mesh.faces().size() < 1100);
}
