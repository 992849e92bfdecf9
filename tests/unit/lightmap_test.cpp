// Baked light on its way: in meshes, in pictures that passes make, in one texture with the surface's colour, in
// renderings.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "geometry/vertices.h"
#include "light/render/baked.h"
#include "light/render/render.h"
#include "passes/combine_lightmap/combine_lightmap.h"
#include "passes/combine_lightmap/page.h"
#include "tests/unit/lightmap_fixture.h"
#include "tests/unit/temp_folder.h"
#include "writers/made_files.h"

using namespace wrlkit;

TEST_CASE("lightmap: meshes carry places in it as they carry texture coordinates", "[lightmap]") {
  Lit w(shape("",
              "IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ]"
              " lightCoord TextureCoordinate { point [ 0 0, 0.5 0, 0.5 0.5 ] } lightCoordIndex [ 0 1 2 2 -1 ] }"));
  NodeId g = w.of(nodes::IndexedFaceSet)[0];
  CHECK(w.mesh(g).lightcoord.index == std::vector<std::uint32_t>{0, 1, 2, 2});
  w.run("weld,triangulate");
  Mesh m = w.mesh(g);
  REQUIRE(m.is_triangles());
  REQUIRE(m.lightcoord.index.size() == 6);
  for (std::size_t c = 0; c < 6; ++c) {
    const double* p = m.positions.data() + std::size_t{3} * m.corners[c];
    const float* at = m.lightcoord.at(m.lightcoord.index[c]);
    CHECK(at[0] == (p[0] > 0 || p[1] > 0 ? 0.5f : 0));
    CHECK(at[1] == (p[1] > 0 ? 0.5f : 0));
  }
  // Two corners of one point in two places of the light are two vertices.
  m.lightcoord.values.insert(m.lightcoord.values.end(), {1, 1});
  m.lightcoord.index[3] = 3;
  Vertices v;
  SplitScratch scratch;
  split_vertices(m, {}, scratch, v);
  CHECK(v.count() == 5);
  CHECK(v.lightcoord.size() == 10);
  split_vertices(m, {.lightcoords = false}, scratch, v);
  CHECK(v.count() == 4);
  CHECK(v.lightcoord.empty());
}

TEST_CASE("lightmap: levels of detail keep the light, and join does not mix what has light with what has none",
          "[lightmap]") {
  std::string points, places, index;
  for (int y = 0; y <= 20; ++y)
    for (int x = 0; x <= 20; ++x) {
      points += std::to_string(x) + " " + std::to_string(y) + " 0, ";
      places += std::to_string(x / 20.0) + " " + std::to_string(y / 20.0) + ", ";
      if (x < 20 && y < 20)
        for (int k : {0, 1, 22, 21, -1}) index += std::to_string(k < 0 ? k : y * 21 + x + k) + " ";
    }
  const std::string set =
      "IndexedFaceSet { coord Coordinate { point [ " + points + " ] } coordIndex [ " + index + " ] ";
  Lit w(shape(with_light, set + "lightCoord TextureCoordinate { point [ " + places + " ] } }"));
  w.run("lod{ratios=0.1,min-faces=10}");
  auto levels = w.of(nodes::IndexedFaceSet);
  REQUIRE(levels.size() > 1);
  Mesh coarse = w.mesh(levels.back());
  CHECK(coarse.n_faces() < 100);
  REQUIRE(coarse.lightcoord.present());
  for (std::size_t c = 0; c < coarse.corners.size(); ++c)
    CHECK(coarse.lightcoord.at(coarse.lightcoord.index[c])[0] ==
          Approx(coarse.positions[3 * std::size_t{coarse.corners[c]}] / 20).margin(0.05));
  Lit two("Group { children [ " + shape("material DEF M Material {}") + shape("material USE M", set + "}") + " ] }");
  two.run("join");
  CHECK(two.of(nodes::Shape).size() == 2);
}

TEST_CASE("made files: they are had by their urls, and names are not given twice", "[lightmap]") {
  Lit w("");
  auto bytes = std::make_shared<const std::string>("one");
  CHECK(w.resources.add_made({"a.txt", bytes}) == "wrlkit:a.txt");
  CHECK(w.resources.add_made({"a.txt", std::make_shared<const std::string>("two")}) == "wrlkit:a_2.txt");
  std::vector<std::string_view> urls{"wrlkit:none", "wrlkit:a_2.txt"};
  auto blob = w.resources.bytes(urls, {}, w.diag);
  REQUIRE(blob);
  CHECK(blob->bytes == "two");
  CHECK(blob->name == "a_2.txt");
  CHECK(w.diag.messages().empty());
  urls.pop_back();
  CHECK_FALSE(w.resources.bytes(urls, {}, w.diag));
  CHECK(w.diag.count(Diag::url_network) == 1);
}

TEST_CASE("made files: they are written beside the world, under names that it has for nothing else", "[lightmap]") {
  TempFolder folder;
  Lit w("Shape { appearance Appearance { texture ImageTexture { url \"room.a.png\" } } }");
  auto bytes = [](const char* s) { return std::make_shared<const std::string>(s); };
  const auto a = w.resources.add_made({"a.png", bytes("A")}), b = w.resources.add_made({"b.png", bytes("B")});
  w.resources.add_made({"unused.png", bytes("U")});
  w.resources.add_made({"kept.exr", bytes("E"), true});
  folder.write("room.b.png", "another");
  MadeFiles files(w.scene(), w.resources, folder / "room.wrl.gz", false, w.diag);
  CHECK(files.place(a) == "room.a_2.png");
  CHECK(files.place(a) == "room.a_2.png");
  CHECK(files.place(b) == "room.b.png");
  CHECK(files.place("c.png") == "c.png");
  REQUIRE(files.write());
  CHECK(folder.read("room.b.png") == "another");
  REQUIRE(files.commit());
  CHECK(folder.read("room.a_2.png") == "A");
  CHECK(folder.read("room.b.png") == "B");
  CHECK(folder.read("room.kept.exr") == "E");
  CHECK_FALSE(std::filesystem::exists(folder / "room.unused.png"));
  CHECK(w.diag.count(Diag::file_replaced) == 1);
}

TEST_CASE("made files: urls name files with characters that mean something in a url", "[lightmap]") {
  TempFolder folder;
  Lit w("Shape { appearance Appearance { texture ImageTexture { url \"at%20100%25.a.png\" } } }");
  const auto a = w.resources.add_made({"a.png", std::make_shared<const std::string>("A")});
  MadeFiles files(w.scene(), w.resources, folder / "at 100%.wrl", false, w.diag);
  CHECK(files.place(a) == "at%20100%25.a_2.png");
  REQUIRE((files.write() && files.commit()));
  CHECK(folder.read("at 100%.a_2.png") == "A");
}

TEST_CASE("pictures: EXR keeps light beyond 1, WebP its colours, and both the same bytes twice", "[lightmap]") {
  std::string error;
  FloatImage hdr{2, 1, 3, {0.25f, 0.5f, 1, 4, 0, 1000}};
  auto exr = encode_exr(hdr, error);
  INFO(error);
  REQUIRE(exr);
  CHECK(sniff_mime(*exr) == "image/x-exr");
  CHECK(*exr == *encode_exr(hdr, error));
  CHECK(exr->find("1970:01:01") != std::string::npos);  // and at another time
  auto seen = decode_image(*exr, "", error);
  REQUIRE(seen);
  CHECK(pixel(*seen, 0, 0) == Rgb{shown(0.25), shown(0.5), 255});
  CHECK(pixel(*seen, 1, 0) == Rgb{255, 0, 255});
  Image image{16, 16, 3, {}};
  for (int i = 0; i < 256; ++i) image.pixels.insert(image.pixels.end(), {200, 100, 40});
  auto webp = encode_webp(image, 100, error);
  INFO(error);
  REQUIRE(webp);
  CHECK(sniff_mime(*webp) == "image/webp");
  auto again = pixel(*decode_image(*webp, "", error), 7, 9);
  for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(again[c] - image.pixels[c]) < 4);
  CHECK(*encode_as("x.webp", image, error) == *encode_as("y.webp", image, error));
  CHECK_FALSE(can_encode_as("x.tiff"));
}

TEST_CASE("page: texels belong to the triangle they lie in, then to the nearest", "[lightmap]") {
  using namespace combine;
  Page page(16, 8, 2);
  const std::vector<PageTriangle> triangles{{{4, 8, 4}, {2, 2, 6}}, {{8, 8, 4}, {2, 6, 6}}};
  auto number = [](std::size_t i, const std::array<double, 3>& w, double x, double) {
    CHECK(w[0] + w[1] + w[2] == Approx(1));
    return Texel4{{static_cast<std::uint8_t>(100 * (i + 1)), static_cast<std::uint8_t>(10 * x), 0, 255}};
  };
  REQUIRE(page.paint(triangles, number));
  Image image = page.image(3);
  CHECK(pixel(image, 4, 2) == Rgb{100, 45, 0});
  CHECK(pixel(image, 7, 5) == Rgb{200, 75, 0});
  CHECK(pixel(image, 3, 3) == Rgb{100, 35, 0});  // next to the first one
  CHECK(pixel(image, 9, 4) == Rgb{200, 95, 0});
  CHECK(pixel(image, 15, 0)[0] > 165);  // nobody's: the colours around
  CHECK(pixel(image, 0, 7)[0] == 100);
  std::vector<PageTriangle> too_many(10'000, {{0, 16, 0}, {0, 0, 8}});
  for (auto& t : too_many) {
    t.x[1] = 1e6;
    t.y[2] = 1e6;
  }
  int painted = 0;
  Page crowded(4, 4, 1);
  crowded.paint(too_many, [&](std::size_t, const std::array<double, 3>&, double, double) {
    ++painted;
    return Texel4{{1, 1, 1, 255}};
  });
  CHECK(painted == 16);
}

TEST_CASE("combine-lightmap: the texture is colour times light, and nothing is lit again", "[lightmap]") {
  Lit w(shape("material DEF Red Material { diffuseColor 1 0.5 0 }" + with_light));
  w.run("combine-lightmap");
  NodeId a = w.of(nodes::Appearance)[0], g = w.of(nodes::IndexedFaceSet)[0];
  CHECK_FALSE(w.scene().get(a, nodes::appearance::material));
  CHECK_FALSE(w.scene().get(a, nodes::appearance::lightmap));
  CHECK_FALSE(w.scene().get(g, nodes::indexed_face_set::lightCoord));
  CHECK(w.mesh(g).texcoord.values[0] == 0.25f);
  auto image = w.picture(w.scene().get(a, nodes::appearance::texture));
  REQUIRE(image);
  CHECK(image->channels == 3);
  CHECK(image->width == 4);
  const double grey = srgb_to_linear(128 / 255.0);
  CHECK(pixel(*image, 1, 1) == Rgb{shown(grey), shown(srgb_to_linear(0.5) * grey), 0});
  CHECK(w.diag.messages().empty());
}

TEST_CASE("combine-lightmap: the pictures are of the format that those of the light have, if no other is asked for",
          "[lightmap]") {
  auto formats = [](const std::string& bake, const std::string& combine) {
    Lit w(
        "DEF A Shape { appearance Appearance { material Material {} } geometry Box {} } Transform { translation 5 0 0 "
        "children Shape { appearance Appearance { material Material { transparency 0.5 } } geometry Box {} } }");
    w.run("lightmap{quality=draft,max-size=64" + bake + "},combine-lightmap" + combine);
    std::set<std::string> out;
    for (NodeId t : w.of(nodes::ImageTexture)) {
      const std::string_view url = w.scene().get(t, nodes::image_texture::url)[0];
      out.emplace(url.substr(url.rfind('.')));
    }
    return out;
  };
  using Names = std::set<std::string>;
  CHECK(formats("", "") == Names{".png"});
  CHECK(formats(",format=jpg", "") == Names{".jpg", ".png"});  // alpha
  CHECK(formats(",format=jpg", "{format=png}") == Names{".png"});
  CHECK(formats("", "{format=jpg}") == Names{".jpg", ".png"});
}

TEST_CASE("combine-lightmap: emission, scale, vertex colours, and a grey texture count as in 4.14", "[lightmap]") {
  const double grey = srgb_to_linear(128 / 255.0);
  auto first = [](const std::string& appearance, const std::string& geometry = square) {
    Lit w(shape(appearance, geometry));
    w.run("combine-lightmap{scale=1}");
    return pixel(*w.picture(w.of(nodes::ImageTexture)[0]), 1, 1);
  };
  CHECK(first("material Material { diffuseColor 0 0 0 emissiveColor 0 0 0.8 }" + with_light) == Rgb{0, 0, 204});
  CHECK(first("material Material { diffuseColor 1 1 1 } lightmapScale 2" + with_light)[0] == shown(2 * grey));
  CHECK(first("material Material { }" + with_light,
              square.substr(0, square.size() - 1) + "color Color { color 0 1 0 } colorPerVertex FALSE }") ==
        Rgb{0, shown(grey), 0});
  CHECK(first("material Material { diffuseColor 1 0 0 } texture PixelTexture { image 1 1 1 0x80 }" + with_light) ==
        Rgb{shown(grey * grey), 0, 0});
}

TEST_CASE("combine-lightmap: transparent Shapes have a picture of their own, with alpha", "[lightmap]") {
  Lit w(shape("material Material { transparency 0.25 }" + with_light) +
        shape("material Material { } lightmap USE Light") +
        shape("material Material { diffuseColor 1 0 0 } lightmap USE Light"));
  w.run("combine-lightmap");
  CHECK(w.stats["combine-lightmap.pages"] == 2);
  CHECK(w.stats["combine-lightmap.shapes"] == 3);
  auto appearances = w.of(nodes::Appearance);
  auto see_through = w.picture(w.scene().get(appearances[0], nodes::appearance::texture));
  REQUIRE(see_through->channels == 4);
  CHECK(see_through->pixels[4 * 5 + 3] == 191);
  CHECK(w.scene().get(appearances[1], nodes::appearance::texture) ==
        w.scene().get(appearances[2], nodes::appearance::texture));
}

TEST_CASE("combine-lightmap: opacity of colours is alpha of the picture", "[lightmap]") {
  const std::string colored =
      square.substr(0, square.size() - 1) + "color ColorRGBA { color [ 1 0 0 0.2 ] } colorPerVertex FALSE }";
  Lit w(shape("material Material { }" + with_light, colored), "#X3D V3.3 utf8\nPROFILE Immersive\n");
  w.run("combine-lightmap");
  const auto picture = w.picture(w.of(nodes::ImageTexture)[0]);
  REQUIRE(picture->channels == 4);
  CHECK(picture->pixels[4 * 5 + 3] == 51);
}

TEST_CASE("combine-lightmap: shared geometry keeps its places for each Shape, and for those without light",
          "[lightmap]") {
  const std::string quarter = " lightmapTransform TextureTransform { scale 0.5 0.5 }";
  Lit w(shape("material DEF M Material { }" + with_light + quarter, "DEF Square " + square) +
        shape("material USE M lightmap USE Light", "USE Square") + shape("material USE M", "USE Square"));
  w.run("combine-lightmap");
  auto shapes = w.of(nodes::Shape);
  auto geometry = [&](std::size_t i) { return w.scene().get(shapes[i], nodes::shape::geometry); };
  CHECK(geometry(0) == geometry(1));
  CHECK(geometry(2) != geometry(0));
  CHECK(w.scene().name(geometry(2)) == "Square");
  CHECK(w.scene().get(geometry(2), nodes::indexed_face_set::lightCoord));
  auto appearance = [&](std::size_t i) { return w.scene().get(shapes[i], nodes::shape::appearance); };
  CHECK(w.scene().get(appearance(0), nodes::appearance::textureTransform));
  CHECK_FALSE(w.scene().get(appearance(1), nodes::appearance::textureTransform));
  CHECK(w.scene().get(appearance(2), nodes::appearance::material));
}

TEST_CASE("combine-lightmap: a detailed texture makes a larger picture, within the limit", "[lightmap]") {
  const std::string fine =
      "texture PixelTexture { image 2 2 3 0xff0000 0x00ff00 0x0000ff 0xffffff } textureTransform TextureTransform { "
      "scale 8 8 }";
  Lit w(shape("material Material { } " + fine + with_light));
  w.run("combine-lightmap");
  CHECK(w.picture(w.of(nodes::ImageTexture)[0])->width == 32);  // 16 pixels over two texels: eight times
  CHECK(w.diag.messages().empty());
  Lit small(shape("material Material { } " + fine + with_light));
  small.run("combine-lightmap{max-size=8}");
  CHECK(small.picture(small.of(nodes::ImageTexture)[0])->width == 4);  // twice; what nothing lies on is left out
  CHECK(small.diag.count(Diag::texture_coarser) == 1);
}

TEST_CASE("combine-lightmap: into the lightmap, all else stays", "[lightmap]") {
  Lit w(shape("material Material { diffuseColor 0 1 0 } lightmapScale 2" + with_light));
  w.run("combine-lightmap{into=lightmap}");
  NodeId a = w.of(nodes::Appearance)[0];
  CHECK(w.scene().get(a, nodes::appearance::material));
  CHECK(w.scene().get(a, nodes::appearance::lightmapScale) == 1);
  CHECK(pixel(*w.picture(w.scene().get(a, nodes::appearance::lightmap)), 1, 1) ==
        Rgb{0, shown(2 * srgb_to_linear(128 / 255.0)), 0});
}

TEST_CASE("combine-lightmap: on the way to VRML97 the picture has what X3D and VRML 1.0 multiply", "[lightmap]") {
  const std::string look = "Texture2 { filename \"wrlkit:two.png\" } ",
                    points = "point [ -1 -1 0, 1 -1 0, 1 1 0, -1 1 0 ]",
                    lamp = "DirectionalLight { direction 0 0 -1 } ";
  const std::string faces = "geometry IndexedFaceSet { coordIndex [ 0 1 2 3 -1 ] coord Coordinate { " + points + " } ",
                    x3d = "#X3D V4.0 utf8\nPROFILE Full\n";
  auto in_x3d = [&](const std::string& material) {
    return lamp + "Shape { appearance Appearance { material " + material + " } " + faces + "} }";
  };
  const std::string picture = "ImageTexture { url \"wrlkit:two.png\" } ", orange = "1 0.5 0.25 ";
  struct {
    const char* name;
    std::string header, body;
  } const cases[] = {
      {"VRML 1.0", "#VRML V1.0 ascii\n",
       "Separator { " + lamp + "Material { diffuseColor " + orange + "} " + look + "Coordinate3 { " + points +
           " } IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } }"},
      {"Material", x3d, in_x3d("Material { diffuseColor " + orange + "diffuseTexture " + picture + "}")},
      {"PhysicalMaterial", x3d,
       in_x3d("PhysicalMaterial { metallic 0 baseColor 1 0.21404114 0.05087609 baseTexture " + picture + "}")},
      {"colours of vertices", x3d,
       lamp + "Shape { appearance Appearance { material Material { } texture " + picture + "} " + faces +
           "color Color { color [ " + orange + orange + orange + orange + "] } } }"},
  };
  for (const auto& c : cases) {
    INFO(c.name);
    Lit w(c.body, c.header);
    std::string error;
    const Image half{8, 8, 3, std::vector<std::uint8_t>(192, 200)};
    REQUIRE(w.resources.add_made({"two.png", std::make_shared<const std::string>(
                                                 *encode_as("two.png", half, error))}) == "wrlkit:two.png");
    std::string why;
    auto pipeline = Pipeline::parse("lightmap{quality=draft,max-size=64,denoise=false}", why);
    pipeline->complete("vrml");
    REQUIRE(pipeline->run(w.scene(), w.ctx));
    CHECK(w.diag.count(Diag::no_vrml97_product) == 0);
    CHECK(w.of(nodes::Material).size() + w.of(nodes::PhysicalMaterial).size() == 0);
    const auto page = w.picture(w.scene().get(w.of(nodes::Appearance)[0], nodes::appearance::texture));
    REQUIRE(page);
    Rgb brightest{};
    for (int y = 0; y < page->height; ++y)
      for (int x = 0; x < page->width; ++x) brightest = std::max(brightest, pixel(*page, x, y));
    CHECK(brightest == Rgb{200, 100, 50});
  }
}

TEST_CASE("combine-lightmap: a pipeline has it behind the last pass over the scene", "[lightmap]") {
  auto completed = [](const char* text, const char* standard) {
    std::string why;
    auto p = Pipeline::parse(text, why);
    p->complete(standard);
    std::string names, all = p->text();
    for (std::size_t at = 0, depth = 0; at < all.size(); ++at) {
      if (all[at] == '{') ++depth;
      if (!depth) names += all[at];
      if (all[at] == '}') --depth;
    }
    return names;
  };
  const std::string front = "lower-vrml1,expand,lower-x3d,prune,", end = ",tessellate,normals,triangulate";
  CHECK(completed("weld", "gltf") == front + "combine-lightmap,weld" + end);
  CHECK(completed("weld,lod", "gltf") == front + "weld,lod,combine-lightmap" + end);
  CHECK(completed("lod,weld", "gltf") == front + "lod,combine-lightmap,weld" + end);
  CHECK(completed("lod", "gltf-light") == front + "lod" + end);
  CHECK(completed("prune", "vrml") == "lower-vrml1,lower-x3d,prune,combine-lightmap,lower-x3d");
  CHECK(completed("combine-lightmap,prune", "vrml") == "lower-vrml1,lower-x3d,combine-lightmap,prune,lower-x3d");
  CHECK(completed("inline", "vrml") == "lower-vrml1,inline,lower-x3d,combine-lightmap,lower-x3d");
}

TEST_CASE("render: baked light is shown, and not lit again", "[lightmap]") {
  auto middle = [](const std::string& body, RenderOptions::Mode mode) {
    Lit w("Viewpoint { position 0 0 5 } " + body);
    std::string why;
    auto pipeline = Pipeline::parse("picture", why);
    auto meshes = pipeline->run_lazily(w.scene(), w.ctx);
    RenderOptions o;
    o.width = o.height = 21;
    o.mode = mode;
    return pixel(render(w.scene(), meshes, o, &w.resources, w.diag), 10, 10);
  };
  using Mode = RenderOptions::Mode;
  const double grey = srgb_to_linear(128 / 255.0);
  const std::string orange = shape("material Material { diffuseColor 1 0.5 0 specularColor 1 1 1 }" + with_light);
  CHECK(middle(orange, Mode::preview) == Rgb{shown(grey), shown(srgb_to_linear(0.5) * grey), 0});
  CHECK(middle(orange, Mode::lightmap) == Rgb{128, 128, 128});
  CHECK(middle(orange, Mode::albedo) == Rgb{255, 128, 0});
  const auto checker = middle(shape(with_light, square), Mode::checker);
  CHECK(checker[0] == checker[2]);
  CHECK(middle(orange, Mode::density)[2] > middle(orange, Mode::density)[0]);  // one texel a metre: blue
  CHECK(middle(shape("material Material { }"), Mode::lightmap) == Rgb{140, 140, 140});
}

TEST_CASE("baked light with a direction: what faces it gets more, and it shines where it is mirrored", "[lightmap]") {
  using namespace drawing;
  Surface s;
  s.lit = true;
  s.material.specular = V3(1);
  s.material.shininess = 0.5;
  const V3 face{0, 0, 1}, slant = unit(V3{1, 0, 1});
  auto from = [](const V3& v) { return LightSample{V3(0.2), std::array<V3, 3>{V3(v.x), V3(v.y), V3(v.z)}}; };
  auto red = [&](const LightSample& light, const V3& normal, const V3& to_viewer) {
    return srgb_to_linear(baked_color(s, V3(1), light, {{}, normal, to_viewer}, face).x);
  };
  const V3 aside = unit(V3{0, 1, 0.01});
  // From all sides alike: normals make no difference.
  CHECK(red(from({0, 0, 0}), slant, aside) == Approx(0.2));
  CHECK(red({V3(0.2), {}}, slant, aside) == Approx(0.2));
  // Half of it from the front: (1 + 2 v.n) relative to the face's.
  CHECK(red(from({0, 0, 0.5}), face, aside) == Approx(0.2).margin(1e-3));
  s.material.specular = V3(0);
  CHECK(red(from({0, 0, 0.5}), slant, aside) == Approx(0.2 * (1 + std::sqrt(0.5)) / 2));
  s.material.specular = V3(1);
  CHECK(red(from({0, 0, 0.5}), face, face) == Approx(0.2 + 0.5 * 0.2).margin(1e-3));
}

TEST_CASE("sRGB by table: the bytes of the formula, and its linear numbers", "[lightmap]") {
  const SrgbTable& table = SrgbTable::get();
  for (int i = -10; i <= 20'010; ++i) {
    const double v = i / 20'000.0;
    REQUIRE(table.byte(v) == static_cast<int>(linear_to_srgb(v) * 255 + 0.5));
    REQUIRE(table.linear(v) == Approx(srgb_to_linear(v)).margin(1e-7));
  }
}
